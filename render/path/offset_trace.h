#pragma once

#include "render/path/vertex.h"

#include <string_view>
#include <vector>

namespace tessera {

/// A vertex as one looks at it.
struct SeenVertex {
    glm::vec3 position;
    glm::vec3 normal;      ///< unit, of shading
    std::string_view bsdf; ///< kind_name()
    float roughness;       ///< alpha of the roughest part that is no delta; 0: there is none

    SeenVertex(const Vertex& v)
        : position(v.position), normal(v.frame.normal), bsdf(kind_name(v.bsdf)), roughness(v.bsdf.roughness()) {}
};

/// One scattering of an offset path, in the numbers that the shift calculates with.
struct OffsetStep {
    int vertex = 0;  ///< where: 0 is y_1
    float pdf_w = 0; ///< of the way on: per solid angle, or a probability after a delta scatter; at the end of a
                     ///< light path that of all strategies together
    bool is_delta = false;
    float jacobian = 1; ///< solid angle at the offset over solid angle at the base
    float ratio = 0;    ///< so far: density of the offset, with all Jacobians, over that of the base; no unit
    Rgb value{0};       ///< so far: f of the offset with all Jacobians over the base's pdf; at the end of a light
                        ///< path with its light, radiance
};

/// What a shift did to all offset paths, for who wants to look: one a pixel of the sampling set.
class OffsetTrace {
public:
    /// How a light path, a slot of LightPaths, ended in the offset, whatever visibility made of it then.
    struct End {
        bool is_there = false;
        bool joins = false; ///< it goes through `join` to the base's own vertex, where `last` is
        OffsetStep join;
        OffsetStep last;
    };
    struct Path {
        std::vector<SeenVertex> vertices; ///< y_1, y_2, ...
        std::vector<OffsetStep> bounces;  ///< at y_1, y_2, ..., those that led to another vertex
        std::vector<End> ends;            ///< one a slot
    };

    void reset(int offsets, int slots) {
        paths_.resize(static_cast<std::size_t>(offsets));
        for (Path& path : paths_) {
            path.vertices.clear();
            path.bounces.clear();
            path.ends.assign(static_cast<std::size_t>(slots), {});
        }
    }
    void add(int m, const Vertex& y) { at(m).vertices.emplace_back(y); }
    void bounce(int m, const OffsetStep& step) { at(m).bounces.push_back(step); }
    /// A light path ends at a light as the offset sees it, ...
    void end(int m, int slot, const OffsetStep& last) { end_at(m, slot) = {true, false, {}, last}; }
    /// ... or beyond the vertex of the base path that it joins.
    void end_beyond(int m, int slot, const OffsetStep& join, const OffsetStep& last) {
        end_at(m, slot) = {true, true, join, last};
    }

    const Path& operator[](int m) const { return paths_[static_cast<std::size_t>(m)]; }

private:
    Path& at(int m) { return paths_[static_cast<std::size_t>(m)]; }
    End& end_at(int m, int slot) { return at(m).ends[static_cast<std::size_t>(slot)]; }

    std::vector<Path> paths_;
};

} // namespace tessera
