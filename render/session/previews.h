#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/vec2.hpp>

namespace tessera {

/// Chooses the resolution of the previews that a pane shows before its first pass. The first preview is coarse
/// enough to follow a moving camera, even on slow machines. Finer ones follow while the camera rests. A preview
/// has one pixel for divisor x divisor pixels of the picture.
class Previews {
public:
    static constexpr int finest = 4, coarsest = 16;
    static constexpr int most_pixels = 400'000; ///< of a first preview, unless its divisor is `coarsest`
    static constexpr int least_edge = 40; ///< least width and height in pixels, unless the divisor is `finest`

    /// Returns the divisor of a request's next preview; 0: no preview is left.
    /// @param size  of the picture, pixels
    int divisor(std::uint64_t generation, glm::ivec2 size) const {
        if (!is_first(generation))
            return next_;
        int divisor = first_;
        while (divisor < coarsest && size.x / divisor > most_pixels / std::max(size.y / divisor, 1))
            divisor *= 2;
        while (divisor > finest && std::min(size.x, size.y) < divisor * least_edge)
            divisor /= 2;
        return divisor;
    }
    /// Returns whether the request has had no preview yet.
    bool is_first(std::uint64_t generation) const { return generation != generation_; }

    /// Records a finished preview.
    /// @param seconds  wall time that it took
    /// @param budget   seconds that the first preview of a request may take
    void count(std::uint64_t generation, int divisor, double seconds, double budget) {
        adapt(divisor, seconds, budget);
        generation_ = generation;
        next_ = divisor > finest ? divisor / 2 : 0;
    }

private:
    /// Updates the divisor of the next request's first preview. Half the divisor takes at most four times as long.
    /// The margin prevents oscillation.
    void adapt(int divisor, double seconds, double budget) {
        constexpr double margin = 1.5;
        if (divisor < first_ && margin * seconds < budget)
            first_ = divisor; // a later, finer preview was fast enough
        for (; divisor == first_ && seconds > budget && first_ < coarsest; seconds /= 4)
            divisor = first_ *= 2;
        if (divisor == first_ && 4 * margin * seconds < budget)
            first_ = std::max(first_ / 2, finest);
    }

    int first_ = finest;           // divisor of a request's first preview
    int next_ = 0;                 // divisor of the next preview of generation_
    std::uint64_t generation_ = 0; // of the last preview
};

} // namespace tessera
