#include "render/inspect/observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

DisplayVertex seen(const Vertex& v) {
    return {v.position, v.frame.normal, kind_name(v.bsdf), v.bsdf.roughness()};
}

InspectedVertex inspect_vertex(const BasePath& path, int i, Rgb throughput) {
    const BaseVertex& x = path[i];
    InspectedVertex v{seen(x.vertex),
                      i + 1 < path.size() || x.escapes,
                      x.escapes,
                      glm::vec3(0),
                      x.is_delta,
                      x.pdf_w,
                      throughput,
                      x.survival,
                      Rgb(0),
                      Rgb(0),
                      {}};
    const LightSample& light = path.light(i);
    v.sampled = light.brings;
    if (!is_black(light.brings) && !light.light.is_at_infinity())
        v.light = InspectedLight{light.light.position};
    if (v.goes_on) {
        v.to_next = x.vertex.to_world(x.to_next);
        v.hit = x.hit_contribution;
    }
    return v;
}

/// Returns the base path's own steps along one of its light paths.
std::vector<InspectedStep> steps_of(const BasePath& path, int last, const Rgb& carried) {
    std::vector<InspectedStep> steps;
    Rgb throughput(1);
    for (int i = 0; i <= last && i < path.size(); ++i) {
        const BaseVertex& x = path[i];
        if (i < last)
            throughput *= x.throughput();
        steps.push_back({seen(x.vertex), false, {i, x.pdf_w, x.is_delta, 1, 1, i < last ? throughput : carried}});
    }
    return steps;
}

} // namespace

std::vector<InspectedVertex> inspect_path(const BasePath& path) {
    std::vector<InspectedVertex> result;
    Rgb throughput(1);
    for (int i = 0; i < path.size(); ++i) {
        if (i + 1 < path.size() || path[i].escapes)
            throughput *= path[i].throughput();
        result.push_back(inspect_vertex(path, i, throughput));
    }
    return result;
}

void OffsetTrace::begins(int offsets, int slots) {
    paths_.resize(static_cast<std::size_t>(offsets));
    for (Path& path : paths_) {
        path.vertices.clear();
        path.bounces.clear();
        path.ends.assign(static_cast<std::size_t>(slots), {});
    }
}

void OffsetTrace::arrives(int m, const Vertex& y) {
    at(m).vertices.push_back(seen(y));
}

Observer::Observer(Worker& worker, float samples, int pixel, InspectedSet& result)
    : worker_(worker), result_(result), samples_(samples), pixel_(pixel) {
    worker_.reuse.set_observer(&trace_);
    const std::size_t pixels = result.pixels.size();
    result_.bases.resize(pixels);
    result_.shifts.resize(pixels * pixels);
}

Observer::~Observer() {
    worker_.reuse.set_observer(nullptr);
}

void Observer::operator()(int base, const ReuseDecision& decision) {
    const int pixels = worker_.set.size();
    result_.bases[base] = {inspect_path(path(base)), path(base).radiance(), decision};
    for (int m = 0; m < pixels; ++m)
        result_.shifts[base * pixels + m] = shift(base, m, decision.scale);
}

InspectedShift Observer::shift(int base, int m, float scale) const {
    const auto pixel = [&](int i) { return worker_.set.pixels[i]; };
    const auto outcomes = worker_.reuse.outcomes();
    InspectedShift s{pixel(base), pixel(m), !outcomes.empty(), ShiftOutcome::ok, 0, 0, 0, Rgb(0), {}, {}, {}, {}};
    if (base == m && !path(base).empty())
        s.value = worker_.reuse.kept_light(path(base));
    if (!s.is_tried)
        return s;
    if (base != m)
        s.outcome = outcomes[m];
    int slot = add_light_paths(base, m, scale, s);
    if (base != m) {
        add_places(base, m, s);
        slot = slot < 0 ? first_attempt(m) : slot;
    }
    if (slot >= 0)
        add_steps(base, m, slot, s);
    return s;
}

/// Adds the contributions of all light paths. Returns the slot with the largest one; -1: all are black.
int Observer::add_light_paths(int base, int m, float scale, InspectedShift& s) const {
    const LightPaths& light = worker_.reuse.light_paths();
    const OffsetPaths& offsets = worker_.reuse.offset_paths();
    float largest = 0;
    int best = -1;
    for (int slot = light.first_shared(); slot <= light.last_alive(); ++slot) {
        if (!light.is_alive(slot))
            continue;
        const float weight = worker_.reuse.weight(slot, scale);
        const Rgb value = weight * (base == m ? light.carried(slot) : offsets.value(slot, m));
        s.value += value;
        if (luminance(value) <= largest)
            continue;
        largest = luminance(value);
        best = slot;
        s.weight = weight;
        s.ratio = base == m ? 1 : offsets.ratio(slot, m);
    }
    return best;
}

/// Returns the first slot whose shift reached its light, but was occluded; -1: none.
int Observer::first_attempt(int m) const {
    const std::vector<OffsetTrace::End>& ends = trace_[m].ends;
    for (std::size_t slot = 0; slot < ends.size(); ++slot)
        if (ends[slot].is_there && ends[slot].last.ratio > 0)
            return static_cast<int>(slot);
    return -1;
}

void Observer::add_places(int base, int m, InspectedShift& s) const {
    for (const DisplayVertex& y : trace_[m].vertices)
        s.offset.push_back(y.position);
    if (s.offset.empty() && !path(m).empty())
        s.offset.push_back(path(m)[0].vertex.position);
    const int join = worker_.reuse.light_paths().join();
    if (join == 0 || static_cast<int>(s.offset.size()) < join)
        return;
    for (int i = join; i < path(base).size(); ++i)
        s.beyond.push_back(path(base)[i].vertex.position);
}

/// Stores |J|, the way in which the light path ends, and, at the inspected pixel, the steps of the shift.
void Observer::add_steps(int base, int m, int slot, InspectedShift& s) const {
    const LightPaths& light = worker_.reuse.light_paths();
    std::vector<InspectedStep> steps;
    if (base == m) {
        const int last = light.has_join() && slot == light.tail_slot() ? light.join() : light.vertex_of(slot);
        steps = steps_of(path(base), last, light.carried(slot));
    } else {
        const OffsetTrace::Path& y = trace_[m];
        const OffsetTrace::End& end = y.ends[slot];
        const auto add = [&](const OffsetStep& step) { steps.push_back({y.vertices[step.vertex], false, step}); };
        const int bounces = end.joins ? end.join.vertex : end.last.vertex;
        for (int i = 0; i < bounces; ++i)
            add(y.bounces[i]);
        add(end.joins ? end.join : end.last);
        if (end.joins)
            steps.push_back({seen(path(base)[end.last.vertex].vertex), true, end.last});
    }
    s.jacobian = 1;
    for (const InspectedStep& step : steps)
        s.jacobian *= step.shifted.jacobian;
    s.ending = ending_of(slot);
    if (base == pixel_ || m == pixel_) {
        add_footprints(base, m, steps);
        s.steps = std::move(steps);
    }
}

/// Adds scalar footprints, theory (25) and (26), as if the offset path had been sampled from its own pixel.
/// Survival probabilities are those of the base path.
void Observer::add_footprints(int base, int m, std::vector<InspectedStep>& steps) const {
    const BasePath& own = path(m);
    if (own.empty())
        return;
    const Vertex& first = own[0].vertex;
    ScalarFootprint along({own.pixel_angle, own.pixel_width});
    glm::vec3 to_before = first.to_world(first.to_previous);
    float distance = 0; // the width begins as that of the pixel at y_1
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const DisplayVertex& y = steps[i].vertex;
        along.arrive(distance, std::abs(glm::dot(to_before, y.normal)));
        const Frame frame(y.normal);
        const float width = along.width(std::log2(samples_));
        steps[i].footprint = {width * frame.tangent, width * frame.bitangent};
        if (i + 1 == steps.size())
            break;
        const OffsetStep& step = steps[i].shifted;
        const glm::vec3 way = steps[i + 1].vertex.position - y.position;
        distance = glm::length(way);
        to_before = way / distance;
        const float cosine = std::abs(glm::dot(to_before, y.normal)),
                    survival = path(base)[static_cast<int>(i)].survival;
        along.scatter(cosine, step.is_delta, y.roughness, step.pdf_w, survival);
    }
}

std::string_view Observer::ending_of(int slot) const {
    const LightPaths& light = worker_.reuse.light_paths();
    if (light.has_join() && slot == light.tail_slot())
        return "all longer light paths";
    return slot == light.hit_slot(light.vertex_of(slot)) ? "emitter hit" : "emitter sampled";
}

} // namespace tessera
