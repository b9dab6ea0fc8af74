#pragma once

#include "render/path/tracer.h"
#include "render/random.h"

#include <span>
#include <vector>

namespace tessera {

/// A vertex x_i of a base path with the two ways in which light is looked for from it: emitter sampling, and BSDF
/// sampling that goes on to x_{i+1}. Every pdf is per solid angle at x_i, or a probability after a delta scatter.
struct BaseVertex {
    Vertex vertex;

    // Emitter sampling. `light_brings` is black when there was nothing to sample, or the way is blocked.
    LightPoint light;
    glm::vec3 to_light;      ///< unit, in the vertex's frame
    float light_pdf_w = 0;   ///< of emitter sampling
    float light_pdf_sum = 0; ///< of all strategies that could have found this light together
    Rgb light_brings{0};     ///< radiance toward x_{i-1}, with its MIS weight: f cos Le / light_pdf_sum

    // BSDF sampling; valid when the path has a next vertex, or leaves the scene here.
    bool escapes = false; ///< it leaves the scene toward an environment: its light counts as a hit
    glm::vec3 to_next;
    Rgb f_cos{0};
    float pdf_w = 0;
    bool is_delta = false;
    Scatter scatter = Scatter::reflect;
    float next_geometry = 0; ///< |cos| at x_{i+1} over the squared distance: what turns pdf_w into pdf_a

    float hit_pdf_w = 0; ///< of emitter sampling at the emitter met: x_{i+1}, or infinity; 0: cannot be sampled
    Rgb hit_brings{0};   ///< radiance from that emitter, with its MIS weight
    Rgb arriving{0};     ///< radiance from x_{i+1} by all longer light paths, with their MIS weights
};

/// A path from the camera and the light it found. One vertex list carries many light paths: for each vertex one
/// that ends by emitter sampling and one that ends by hitting an emitter.
struct BasePath {
    Rgb very_direct{0}; ///< emission seen by the camera itself
    Rgb radiance{0};    ///< sum over all its other light paths: an unbiased estimate for the pixel

    /// x_1, x_2, ...; none: the camera ray left the scene. Vertex 0 is x_1.
    int size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const BaseVertex& operator[](int i) const { return vertices_[static_cast<std::size_t>(i)]; }
    BaseVertex& operator[](int i) { return vertices_[static_cast<std::size_t>(i)]; }

    void clear() { size_ = 0; }
    /// Room for one more vertex, which counts only once keep() is called. Old references end here.
    BaseVertex& spare() {
        if (vertices_.size() == static_cast<std::size_t>(size_))
            vertices_.emplace_back();
        return vertices_[static_cast<std::size_t>(size_)];
    }
    void keep() { ++size_; }

private:
    std::vector<BaseVertex> vertices_; // never shrinks: paths are traced into the memory of earlier ones
    int size_ = 0;
};

/// Traces the path of one sample. Light paths have `max_depth` edges at most, as in Mitsuba.
void trace_base_path(const Tracer& tracer, const Ray& camera_ray, int max_depth, const Random& random,
                     BasePath& path);

} // namespace tessera
