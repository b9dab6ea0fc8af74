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

/// Means over independent runs of a method, with different seeds.
struct MethodMeasured {
    Measured primal, very_direct, dx, dy;
    Measured coefficient; ///< dx and dy are its gradients; empty: they are gradients of `primal`
    /// Pictures of unbiased reconstructions, with directly visible emission. Only `none` without gradients.
    std::map<Norm, Measured> pictures;
    double sharing = 0; ///< fraction of the pixels whose sampling sets have more than one pixel; of the last run
};
/// Measures a method.
/// @param norms  reconstructions to measure, if guarantee_of() calls them unbiased
MethodMeasured measure(std::shared_ptr<const Scene> scene, glm::ivec2 size, const RenderSettings& settings,
                       int runs, int passes, std::span<const Norm> norms = all_norms);

/// Z-scores of the differences of two measurements, in units of their common standard error.
struct ZResult {
    int count = 0;          ///< pixels and channels compared
    double largest = 0;     ///< |z|
    double mean_square = 0; ///< about 1 when the two agree
    double shift = 0;       ///< mean z; the most sensitive to a bias of equal sign in all pixels
    double limit = 0;       ///< of `largest`; chance exceeds it once in 10^4 images
    bool passes() const;
    std::string to_string() const;
};
ZResult z_test(const Measured& a, const Measured& b);

/// Returns the z-tests of tests_of(seed, runs), a list whose entries have a ZResult z. If one fails, it repeats
/// all with another seed and eight times as many runs. That increases z of a bias, and reduces z of a long tail.
/// Stratified samples have long tails: few runs often miss the rare values, and underestimate standard errors.
template <class TestsOf>
auto tests_by_enough_runs(std::uint64_t seed, int runs, TestsOf&& tests_of) {
    auto tests = tests_of(seed, runs);
    for (const auto& test : tests)
        if (!test.z.passes())
            return tests_of(seed + 1'000'000, 8 * runs);
    return tests;
}

/// Returns the sum of two measurements. They must be independent, or one must have a small variance.
Measured sum(const Measured& a, const Measured& b);
/// Returns dx, or dy, of an image whose pixels were measured independently.
Measured difference_x(const Measured& image);
Measured difference_y(const Measured& image);

} // namespace tessera::test
