#pragma once

#include "recon/image.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace tessera {

/// Features along one camera ray.
struct FeatureSample {
    Rgb albedo{0}; ///< at x_1, or of the surface that mirrors show there; black where the ray leaves the scene
    SurfaceFeatures features;
};

/// Feature samples of all pixels: camera rays that are independent of the passes' samples. The points of a pixel
/// are a net; at an edge, the variance of their mean falls about as count^-1.5. All passes of a render see the
/// same points, and each pixel has as many as its variance demands.
class PixelFeatures {
public:
    /// @param for_albedo  the albedo must be as accurate as radiance; otherwise only the features count
    PixelFeatures(int width, int height, bool for_albedo) : points_(width, height), for_albedo_(for_albedo) {}

    static std::uint64_t bytes(int width, int height) {
        return sizeof(Points) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }

    /// Returns the number of samples of a pixel.
    int count(int x, int y) const { return points_(x, y).count; }
    /// Returns the number of further samples that the current pass takes.
    int wanted(int x, int y) const {
        constexpr int most = 16; // distributes the cost over passes; not tuned
        return std::min(points_(x, y).wanted, most);
    }
    /// Adds a sample. Returns false if it is invalid; black then replaces it, so that the next sample has another
    /// point.
    bool add(int x, int y, const FeatureSample& sample);

    /// Computes how many more samples each pixel needs for the means of so many passes. To be called between
    /// passes.
    void request_more(int passes);

    /// Returns 1 for mixed pixels, whose features have a large variance over 3 x 3 pixels, and 0 for others.
    Image<std::uint8_t> mixed() const;

    /// Replaces the samples of each pixel for which `other`, of another render of the same picture, has more. The
    /// points of both are the same.
    void take_more_of(const PixelFeatures& other);

    /// Returns the mean albedo of pixel i.
    Rgb albedo(std::size_t i) const;
    /// Returns the variance of one albedo sample of pixel i, summed over the channels.
    float albedo_variance(std::size_t i) const;
    int count(std::size_t i) const { return points_.data()[i].count; }

    FeatureImages images() const;
    /// Frees all memory.
    void clear() { points_ = {}; }
    Memory memory() { return {memory_of(points_)}; }

private:
    struct Points {
        glm::dvec3 albedo{0};
        double albedo_squares = 0; ///< sum of squared lengths of colours
        SurfaceFeatures features{};
        float feature_squares = 0; ///< sum of squared lengths of features, without nearness
        int count = 0;
        int wanted = 4; ///< further samples

        void operator+=(const FeatureSample& sample);
        void operator+=(const Points& other);
        double relative_albedo_variance() const;
        double feature_variance() const;
    };

    /// Returns the sums over 3 x 3 pixels, because the few samples of one pixel can be equal by chance.
    Points around(int x, int y) const;

    Image<Points> points_;
    bool for_albedo_;
};

} // namespace tessera
