#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/vec2.hpp>

namespace tessera {

/// How coarse the looks are that a pane has before its render: the first is there soon enough to follow a camera
/// that moves, on slow machines as well; where the camera rests, finer ones follow. A look has one pixel for
/// divisor x divisor of the picture's.
class FirstLooks {
public:
    static constexpr int finest = 4, coarsest = 16;
    static constexpr int least_edge = 40; ///< pixels that a look coarser than the finest has along either edge

    /// Of the next look at a request for a picture of that size; 0: there have been enough.
    int divisor(std::uint64_t generation, glm::ivec2 size) const {
        if (!is_first(generation))
            return next_;
        int divisor = first_;
        while (divisor > finest && std::min(size.x, size.y) < divisor * least_edge)
            divisor /= 2;
        return divisor;
    }
    /// Whether there has been none at this request.
    bool is_first(std::uint64_t generation) const { return generation != generation_; }

    /// That one has been made.
    /// @param divisor  of the look
    /// @param seconds  that it took
    /// @param budget   how long the first look at a request may take
    void count(std::uint64_t generation, int divisor, double seconds, double budget) {
        adapt(divisor, seconds, budget);
        generation_ = generation;
        next_ = divisor > finest ? divisor / 2 : 0;
    }

private:
    /// Half the divisor takes at most four times as long. Margins keep it from going back and forth.
    void adapt(int divisor, double seconds, double budget) {
        constexpr double margin = 1.5;
        if (divisor < first_ && margin * seconds < budget)
            first_ = divisor; // one that followed was soon enough
        for (; divisor == first_ && seconds > budget && first_ < coarsest; seconds /= 4)
            divisor = first_ *= 2;
        if (divisor == first_ && 4 * margin * seconds < budget)
            first_ = std::max(first_ / 2, finest);
    }

    int first_ = finest;           // divisor of a request's first look
    int next_ = 0;                 // ... and of the next at generation_
    std::uint64_t generation_ = 0; // the last that was looked at
};

} // namespace tessera
