#include "render/path/offset_vertices.h"

namespace tessera {

namespace {

/// The diffuse BSDF, if it is that and nothing has bent the frame; null: another one.
const Diffuse* plain_diffuse(const Bsdf& bsdf) {
    return bsdf.is_bent() ? nullptr : std::get_if<Diffuse>(&bsdf.kind);
}

} // namespace

void OffsetVertices::reset(int count) {
    count_ = count;
    vertices_.assign(static_cast<std::size_t>(count), nullptr);
    for (int m = 0; m < padded(count); ++m)
        exists[m] = 0;
    others_.clear();
}

void OffsetVertices::set(int lane, const Vertex& v) {
    vertices_[static_cast<std::size_t>(lane)] = &v;
    exists[lane] = -1;
    position.set(lane, v.position);
    geometric_normal.set(lane, v.geometric_normal);
    roughness[lane] = v.bsdf.roughness();
    normal_.set(lane, v.frame.normal);
    to_previous_z_[lane] = v.to_previous.z;
    if (const Diffuse* diffuse = plain_diffuse(v.bsdf))
        reflectance_.set(lane, diffuse->reflectance);
    else
        others_.push_back(lane);
}

void OffsetVertices::evaluate(const Vec3Lanes& to_next, const LaneMask& asked, BsdfLanes& values) const {
    for (int m = 0; m < padded(count_); ++m) { // Diffuse::evaluate
        const float z = to_next.x[m] * normal_.x[m] + to_next.y[m] * normal_.y[m] + to_next.z[m] * normal_.z[m];
        const float pdf_w = to_previous_z_[m] > 0 && z > 0 ? z * inv_pi : 0.0f;
        values.pdf_w[m] = pdf_w;
        values.f_cos.x[m] = reflectance_.x[m] * pdf_w;
        values.f_cos.y[m] = reflectance_.y[m] * pdf_w;
        values.f_cos.z[m] = reflectance_.z[m] * pdf_w;
    }
    for (int m : others_) {
        if (!asked[m])
            continue;
        const Vertex& y = *vertices_[static_cast<std::size_t>(m)];
        const BsdfValue v = y.bsdf.evaluate(y.to_previous, y.to_local(to_next[m]));
        values.pdf_w[m] = v.pdf_w;
        values.f_cos.set(m, v.f_cos);
    }
}

void evaluate(const Bsdf& bsdf, const Vec3Lanes& to_previous, glm::vec3 to_next, const LaneMask& asked, int count,
              BsdfLanes& values) {
    if (const Diffuse* diffuse = plain_diffuse(bsdf)) {
        const BsdfValue lit = diffuse->evaluate({0, 0, 1}, to_next); // the same from everywhere above
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
        if (!asked[m])
            continue;
        const BsdfValue v = bsdf.evaluate(to_previous[m], to_next);
        values.pdf_w[m] = v.pdf_w;
        values.f_cos.set(m, v.f_cos);
    }
}

} // namespace tessera
