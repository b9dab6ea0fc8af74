#pragma once

#include "recon/norm.h"
#include "render/scene/scene.h"
#include "render/settings/settings.h"
#include "tests/support/naive.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace tessera::test {

/// What a method measured, in independent runs with seeds of their own.
struct MethodMeasured {
    Measured primal, very_direct, dx, dy;
    Measured coefficient; ///< what dx and dy are the gradients of; empty: `primal`
    /// By each reconstruction that guarantee_of() calls unbiased, with directly visible emission. Without
    /// gradients, `none` alone.
    std::map<Norm, Measured> pictures;
    double sharing = 0; ///< fraction of the pixels whose sampling sets have more than one pixel; of the last run
};
/// @param norms  the reconstructions whose pictures are measured, as far as guarantee_of() calls them unbiased
MethodMeasured measure(std::shared_ptr<const Scene> scene, glm::ivec2 size, const RenderSettings& settings,
                       int runs, int passes, std::span<const Norm> norms = all_norms);

/// How far two measurements lie apart, in units of their common standard error.
struct ZResult {
    int count = 0;          ///< pixels and channels compared
    double largest = 0;     ///< |z|
    double mean_square = 0; ///< about 1 when the two agree
    double shift = 0;       ///< mean z: a small bias in one direction over all pixels shows here first
    double limit = 0;       ///< for `largest`: passed by chance once in 10^4 images
    bool passes() const;
    std::string to_string() const;
};
ZResult z_test(const Measured& a, const Measured& b);

/// Z-tests by so many runs: tests_of(seed, runs), in the order of a list whose entries have a ZResult z. If any
/// fails, all by other runs, and eight times as many: a bias stands out the more then, and a long tail the less.
/// (What lies evenly, over passes and pixels, is the same in most runs and seldom something else, of which the
/// standard errors of a few know nothing.)
template <class TestsOf>
auto tests_by_enough_runs(std::uint64_t seed, int runs, TestsOf&& tests_of) {
    auto tests = tests_of(seed, runs);
    for (const auto& test : tests)
        if (!test.z.passes())
            return tests_of(seed + 1'000'000, 8 * runs);
    return tests;
}

/// Of what was measured independently, or the less of the two hardly varies.
Measured sum(const Measured& a, const Measured& b);
/// The measurement of dx from neighbours that were measured independently.
Measured difference_x(const Measured& image);
Measured difference_y(const Measured& image);

} // namespace tessera::test
