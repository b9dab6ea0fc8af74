#pragma once

#include "recon/image.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace tessera {

/// What one camera ray tells of a pixel.
struct Look {
    Rgb albedo{0}; ///< at x_1, or of what mirrors show there; black where it meets nothing
    Guide guide;
};

/// What is known of the pixels from camera rays of their own, none of them a sample's. The points of a pixel are a
/// net: at an edge, the variance of their mean falls about as count^-1.5. They are the same for all passes of
/// a render, and each pixel has as many as it takes to know it well.
class PixelLooks {
public:
    /// @param for_albedo  albedos are to be known as well as the light is; else as guides are
    PixelLooks(int width, int height, bool for_albedo) : points_(width, height), for_albedo_(for_albedo) {}

    static std::uint64_t bytes(int width, int height) {
        return sizeof(Points) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }

    /// At how many points a pixel is known, and at how many more it is to be after the pass at hand.
    int count(int x, int y) const { return points_(x, y).count; }
    int wanted(int x, int y) const {
        constexpr int most = 16; // a pass: all pixels are to have some soon
        return std::min(points_(x, y).wanted, most);
    }
    /// False: it is not finite, and black takes its place, so that the next point is another.
    bool add(int x, int y, const Look& look);

    /// Between passes: finds out where more points are needed, for the means of so many passes.
    void ask_for_more(int passes);

    /// Pixels that see several things, by the guides of theirs and of the pixels around them: 1, else 0.
    Image<std::uint8_t> mixed() const;

    /// Takes those of another render of the same picture, whose points are the same ones, where it has more.
    void take_more_of(const PixelLooks& other);

    /// Of pixel i: the mean of the albedo, and the variance of one point, summed over the channels.
    Rgb albedo(std::size_t i) const;
    float albedo_variance(std::size_t i) const;
    int count(std::size_t i) const { return points_.data()[i].count; }

    GuideImages guides() const;
    /// Gives all memory up.
    void clear() { points_ = {}; }
    Memory memory() { return {memory_of(points_)}; }

private:
    struct Points {
        glm::dvec3 albedo{0};
        double albedo_squares = 0; ///< of the lengths of colours
        Guide guide{};
        float guide_squares = 0; ///< of the lengths of followed albedos and of normals
        int count = 0;
        int wanted = 4; ///< more

        void operator+=(const Look& look);
        void operator+=(const Points& other);
        double relative_albedo_variance() const;
        double guide_variance() const;
    };

    /// Of a pixel and those around it: a few points of one may well be alike by chance.
    Points around(int x, int y) const;

    Image<Points> points_;
    bool for_albedo_;
};

} // namespace tessera
