#include "render/paths/offsets.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace tessera {

namespace {

/// Returns the BSDF if it is diffuse and no bump or normal map bends its frame, else null.
const Diffuse* plain_diffuse(const Bsdf& bsdf) {
    return bsdf.has_relief() ? nullptr : std::get_if<Diffuse>(&bsdf.kind);
}

} // namespace

void OffsetVertices::reset(int count) {
    count_ = count;
    vertices_.assign(static_cast<std::size_t>(count), nullptr);
    for (int m = 0; m < padded(count); ++m)
        exists[m] = 0;
    not_diffuse_.clear();
    guided_.clear();
}

void OffsetVertices::set(int lane, const Vertex& v) {
    vertices_[lane] = &v;
    exists[lane] = -1;
    position.set(lane, v.position);
    geometric_normal.set(lane, v.geometric_normal);
    roughness[lane] = v.bsdf.roughness();
    normal_.set(lane, v.frame.normal);
    to_previous_z_[lane] = v.to_previous.z;
    if (const Diffuse* diffuse = plain_diffuse(v.bsdf))
        reflectance_.set(lane, diffuse->reflectance);
    else
        not_diffuse_.push_back(lane);
    if (v.guide)
        guided_.push_back(lane);
}

void OffsetVertices::evaluate(const Vec3Lanes& to_next, const LaneMask& lanes, BsdfLanes& values) const {
    for (int m = 0; m < padded(count_); ++m) { // Diffuse::evaluate
        const float z = to_next.x[m] * normal_.x[m] + to_next.y[m] * normal_.y[m] + to_next.z[m] * normal_.z[m];
        const float pdf_w = to_previous_z_[m] > 0 && z > 0 ? z * inv_pi : 0.0f;
        values.pdf_w[m] = pdf_w;
        values.f_cos.x[m] = reflectance_.x[m] * pdf_w;
        values.f_cos.y[m] = reflectance_.y[m] * pdf_w;
        values.f_cos.z[m] = reflectance_.z[m] * pdf_w;
    }
    for (int m : not_diffuse_) {
        if (!lanes[m])
            continue;
        const Vertex& y = *vertices_[m];
        const BsdfValue v = y.bsdf.evaluate(y.to_previous, y.to_local(to_next[m]));
        values.pdf_w[m] = v.pdf_w;
        values.f_cos.set(m, v.f_cos);
    }
    for (int m : guided_)
        if (lanes[m])
            values.pdf_w[m] = vertices_[m]->guided_pdf_w(values.pdf_w[m], to_next[m]);
}

namespace {

void evaluate(const Bsdf& bsdf, const Vec3Lanes& to_previous, glm::vec3 to_next, const LaneMask& lanes, int count,
              BsdfLanes& values) {
    if (const Diffuse* diffuse = plain_diffuse(bsdf)) {
        const BsdfValue lit = diffuse->evaluate({0, 0, 1}, to_next); // the same for all to_previous.z > 0
        for (int m = 0; m < padded(count); ++m) {
            const bool above = to_previous.z[m] > 0;
            values.pdf_w[m] = above ? lit.pdf_w : 0.0f;
            values.f_cos.x[m] = above ? lit.f_cos.x : 0.0f;
            values.f_cos.y[m] = above ? lit.f_cos.y : 0.0f;
            values.f_cos.z[m] = above ? lit.f_cos.z : 0.0f;
        }
        return;
    }
    for (int m = 0; m < count; ++m) {
        if (!lanes[m])
            continue;
        const BsdfValue v = bsdf.evaluate(to_previous[m], to_next);
        values.pdf_w[m] = v.pdf_w;
        values.f_cos.set(m, v.f_cos);
    }
}

} // namespace

void evaluate(const Vertex& x, const Vec3Lanes& to_previous, glm::vec3 to_next, const LaneMask& lanes, int count,
              BsdfLanes& values) {
    evaluate(x.bsdf, to_previous, to_next, lanes, count, values);
    if (!x.guide)
        return;
    const float guided = x.guided_pdf_w(0, x.to_world(to_next)); // does not depend on to_previous
    for (int m = 0; m < padded(count); ++m)
        values.pdf_w[m] = (1 - x.guide->share) * values.pdf_w[m] + guided;
}

FirstScatter& OffsetPaths::add_first_scatter(int first_slot, int end_slot) {
    if (scatters_.size() == static_cast<std::size_t>(used_scatters_))
        scatters_.push_back(std::make_unique<FirstScatter>());
    const auto first = scatter_of_slot_.begin() + first_slot, end = scatter_of_slot_.begin() + end_slot;
    std::replace(first, end, -1, used_scatters_);
    return *scatters_[used_scatters_++];
}

void connect_to_point(const OffsetVertices& y, const LaneMask& lanes, glm::vec3 point, glm::vec3 normal,
                      bool one_sided, ConnectionLanes& sight) {
    for (int m = 0; m < padded(y.count()); ++m) {
        const float dx = point.x - y.position.x[m], dy = point.y - y.position.y[m], dz = point.z - y.position.z[m];
        const float distance2 = dx * dx + dy * dy + dz * dz;
        const float scale = 1 / std::sqrt(distance2);
        const float cosine = -(dx * normal.x + dy * normal.y + dz * normal.z) * scale;
        const float geometry = (one_sided ? cosine : std::abs(cosine)) / distance2;
        sight.direction.x[m] = dx * scale;
        sight.direction.y[m] = dy * scale;
        sight.direction.z[m] = dz * scale;
        sight.geometry[m] = geometry;
        sight.distance2[m] = distance2;
        sight.valid[m] = (geometry > 0) & (distance2 > 0) ? lanes[m] : 0;
    }
}

void ball_pdfs(const OffsetVertices& y, const LightPoint& light, FloatLanes& pdf_w) {
    for (int m = 0; m < padded(y.count()); ++m)
        pdf_w[m] = light.pdf * light.ball->cone_pdf_w(y.position[m]);
}

void connect_to_light(const OffsetVertices& y, const LaneMask& lanes, const LightPoint& light,
                      ConnectionLanes& sight, LightLanes& arriving) {
    if (light.has_area()) {
        connect_to_point(y, lanes, light.position, light.normal, true, sight);
        for (int m = 0; m < padded(y.count()); ++m) {
            arriving.pdf_w[m] = light.pdf / sight.geometry[m];
            arriving.radiance.x[m] = light.radiance.x;
            arriving.radiance.y[m] = light.radiance.y;
            arriving.radiance.z[m] = light.radiance.z;
        }
        if (light.kind == LightPoint::Kind::ball) {
            arriving.ball_fixed_pdf_w = arriving.pdf_w;
            ball_pdfs(y, light, arriving.pdf_w);
        }
        return;
    }
    for (int m = 0; m < padded(y.count()); ++m)
        sight.valid[m] = 0;
    for (int m = 0; m < y.count(); ++m) {
        if (!lanes[m])
            continue;
        const float distance = light.distance_from(y.position[m]);
        sight.distance2[m] = distance * distance;
        const std::optional<LightRay> ray = light.seen_from(y.position[m]);
        if (!ray)
            continue;
        sight.valid[m] = -1;
        sight.direction.set(m, ray->direction);
        arriving.pdf_w[m] = ray->pdf_w;
        arriving.radiance.set(m, ray->radiance);
    }
}

void edges_to_point(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction, glm::vec3 point,
                    glm::vec3 normal, SegmentLanes& segments) {
    const Intersector& intersector = tracer.scene.intersector();
    for (int m = 0; m < padded(y.count()); ++m) {
        const glm::vec3 d = direction[m];
        segments.from.set(m, intersector.off_surface(y.position[m], y.geometric_normal[m], d));
        segments.to.set(m, intersector.off_surface(point, normal, -d));
    }
}

void edges_to_light(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction,
                    const LightPoint& light, SegmentLanes& segments) {
    if (!light.is_at_infinity())
        return edges_to_point(tracer, y, direction, light.position, light.normal, segments);
    for (int m = 0; m < y.count(); ++m) {
        if (!y.exists[m])
            continue;
        const Segment s = tracer.toward_light(y[m], light, direction[m]);
        segments.from.set(m, s.from);
        segments.to.set(m, s.to);
    }
}

void PendingEdges::reset(int offsets) {
    offsets_ = offsets;
    used_ = 0;
}

EdgeGroup& PendingEdges::add(int first_slot, int end_slot) {
    if (used_ == groups_.size())
        groups_.push_back(std::make_unique<EdgeGroup>());
    EdgeGroup& group = *groups_[used_++];
    group.first_slot = first_slot;
    group.end_slot = end_slot;
    for (int m = 0; m < padded(offsets_); ++m)
        group.exists[m] = 0;
    return group;
}

void PendingEdges::resolve(const Tracer& tracer, OffsetPaths& paths, LaneMask& lost) {
    for (int m = 0; m < padded(offsets_); ++m)
        lost[m] = 0;
    for (std::size_t i = 0; i < used_; ++i) {
        const EdgeGroup& g = *groups_[i];
        tracer.occluded(g.segments, g.exists, offsets_, blocked_);
        for (int m = 0; m < offsets_; ++m) {
            if (!blocked_[m])
                continue;
            lost[m] = -1;
            for (int slot = g.first_slot; slot < g.end_slot; ++slot)
                paths.row(slot).fail(m);
        }
    }
}

} // namespace tessera
