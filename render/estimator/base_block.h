#pragma once

#include "render/estimator/pass.h"
#include "render/film/albedo_moments.h"
#include "render/paths/base_path.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Traces the base path of one sample of this pass. Rejects and counts an invalid path, and leaves it empty: it
/// would spoil all pixels that reuse it.
/// @param number  index of the path, as in Pass::camera_sample()
void trace_pixel(const Pass& pass, const Tracer& tracer, int x, int y, const CameraSample& from, BasePath& path,
                 int number = 0);

/// Mean over several base paths of a pixel that reuses no paths, theory (21).
struct MeanOfPaths {
    Rgb coefficient{0}, very_direct{0};
    float coverage = 0;
    AlbedoMoments<Rgb> moments; ///< of albedo and radiance

    /// Adds one of `count` paths.
    void add(const Pass& pass, const BasePath& path, int count);
};

/// The base paths of a rectangle of pixels.
class BaseBlock {
public:
    /// Traces the base paths of `rect`, for reuse by the pixels of the block of `inside` only.
    /// @param number  index of the paths, as in Pass::camera_sample()
    void trace(const Pass& pass, const Tracer& tracer, PixelRect rect, glm::ivec2 inside, int number = 0);
    const BasePath& at(int x, int y) const { return paths_[index(x, y)]; }

    /// Returns whether any of its pixels is mixed (Pass::is_mixed).
    bool is_mixed() const { return !mixed_.empty(); }
    /// Traces what the mixed pixels see from a position.
    void see_from(const Pass& pass, const Tracer& tracer, int position);
    /// Returns what a pixel sees from the position of the last see_from(): its base path; or only x_1, for a
    /// mixed pixel whose path is reused at another position. Returns the base path without see_from() since
    /// trace().
    const BasePath& seen(int x, int y) const {
        const std::size_t i = index(x, y);
        return i < first_vertex_of_.size() && first_vertex_of_[i] >= 0 ? first_vertices_[first_vertex_of_[i]]
                                                                       : paths_[i];
    }

    /// Returns the storage for the mean of a pixel that reuses no paths; undefined until the caller sets it.
    MeanOfPaths& mean(int x, int y) {
        means_.resize(paths_.size());
        return means_[index(x, y)];
    }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>((y - rect_.y0) * rect_.width() + x - rect_.x0);
    }

    PixelRect rect_{0, 0, 0, 0};
    std::vector<BasePath> paths_; ///< never shrinks, so vertices keep their memory
    std::vector<MeanOfPaths> means_;
    glm::ivec2 inside_{0};
    int number_ = 0;
    std::vector<glm::ivec2> mixed_;             ///< pixels
    std::vector<std::int16_t> first_vertex_of_; ///< index into first_vertices_, by pixel; -1: base path
    std::vector<BasePath> first_vertices_;      ///< paths of one vertex; never shrinks
};

/// Returns whether the base path with these random numbers is a guiding path: later passes learn from it.
bool is_guiding_path(const Pass& pass, const Random& random);

/// Appends the radiance that a base path found beyond its vertices, if it is a guiding path.
void record_light(const Pass& pass, const BasePath& path, std::vector<FoundLight>& found);

} // namespace tessera
