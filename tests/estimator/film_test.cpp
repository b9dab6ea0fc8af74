// The film: rejected samples, means, variances, half differences, and sums of 10^5 passes.
#include "render/film/film.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

bool is_black_everywhere(const RgbImage& image) {
    for (Rgb c : image)
        if (c != Rgb(0))
            return false;
    return true;
}

TEST(Film, RejectsInvalidSamples) {
    for (const float invalid : {infinity, -infinity, nan})
        for (Rgb PixelSample::* member : {&PixelSample::primal, &PixelSample::dx, &PixelSample::dy,
                                          &PixelSample::very_direct, &PixelSample::albedo})
            for (int channel = 0; channel < 3; ++channel) {
                Film film(3, 2, {.gradients = true, .albedo = true, .reuse = true, .luminance = true});
                Counters counters;
                PixelSample sample{Rgb(1), Rgb(1), Rgb(1), Rgb(1), Rgb(1), {{1, 1, 1, 1, 1, 1}, 1, 1}, 1};
                (sample.*member)[channel] = invalid;
                film.add(1, 0, 4, sample, counters);
                EXPECT_EQ(counters.invalid_samples, 1u);
                ASSERT_EQ(counters.first_invalid.list().size(), 1u);
                EXPECT_EQ(counters.first_invalid.list()[0], (InvalidSample{4, 0, 1}));
                const GradientImages images = film.means(1);
                const Demodulation& d = images.demodulation;
                for (const RgbImage* image :
                     {&images.primal, &images.dx, &images.dy, &images.very_direct, &d.value, &d.sampled_albedo})
                    EXPECT_TRUE(is_black_everywhere(*image));
                const ReuseMaps maps = film.reuse_maps(1);
                for (const Image<float>& map : {maps.reused(), maps.failed(), maps.survival()})
                    EXPECT_EQ(map(1, 0), 0);
                EXPECT_EQ(film.path_luminance()(1, 0), 1); // LearnedReuse needs it for all base paths
            }
}

/// Brightness is the largest luminance of primal and gradients. Gradients across the image's border do not count.
TEST(Film, RemembersTheBrightestSample) {
    Film film(2, 1, {.gradients = true, .albedo = true});
    Counters counters;
    film.add(0, 0, 0, {Rgb(1), Rgb(-5), Rgb(0), Rgb(0), Rgb(0.5f)}, counters);
    film.add(0, 0, 1, {Rgb(4), Rgb(1), Rgb(9), Rgb(0), Rgb(0.25f)}, counters); // no pixel below
    film.add(1, 0, 0, {Rgb(1), Rgb(7), Rgb(0), Rgb(0), Rgb(1)}, counters);     // no pixel on the right
    film.add(1, 0, 1, {Rgb(2), Rgb(0), Rgb(0), Rgb(0), Rgb(1)}, counters);
    film.add(1, 0, 2, {Rgb(nan), Rgb(0), Rgb(0), Rgb(0), Rgb(1)}, counters);
    const BrightestSamples b = film.means(2).brightest;
    EXPECT_EQ(b.samples, 2);
    EXPECT_EQ(b.primal(0, 0), Rgb(1));
    EXPECT_EQ(b.dx(0, 0), Rgb(-5));
    EXPECT_EQ(b.albedo(0, 0), Rgb(0.5f));
    EXPECT_EQ(b.primal(1, 0), Rgb(2));
    EXPECT_EQ(b.dx(1, 0), Rgb(0));
    EXPECT_EQ(b.dy(0, 0), Rgb(0));
}

/// Returns a sample that is the mean of two paths. If e and a are correlated, v = m(e a) differs from m(e) m(a).
PixelSample mean_of_two(float e0, float a0, float e1, float a1) {
    PixelSample sample{Rgb((e0 + e1) / 2), Rgb(0), Rgb(0), Rgb(0), Rgb((a0 + a1) / 2)};
    sample.beside = Rgb((e0 * a0 + e1 * a1) / 2) - sample.primal * sample.albedo;
    return sample;
}

TEST(Film, BrightestSampleThatIsAMeanKeepsItsRadiance) {
    Film film(1, 1, {.albedo = true, .means = true});
    Counters counters;
    film.add(0, 0, 0, mean_of_two(1, 0.5f, 1, 0.5f), counters);
    film.add(0, 0, 1, mean_of_two(1000, 0.01f, 0, 0.9f), counters);
    const GradientImages images = film.means(2);
    EXPECT_NEAR((images.brightest.primal(0, 0) * images.brightest.albedo(0, 0)).r, 5, 1e-4);
    EXPECT_NEAR(images.demodulation.value(0, 0).r, (0.5 + 5) / 2, 1e-4);
}

TEST(Film, CountsTheBasePathsOfMeans) {
    Film film(2, 1, {.means = true});
    Counters counters;
    PixelSample sample{Rgb(1)};
    film.add(0, 0, 0, sample, counters);
    sample.paths = 4;
    film.add(0, 0, 1, sample, counters);
    film.add(1, 0, 1, sample, counters);
    const ReuseMaps maps = film.reuse_maps(2);
    EXPECT_EQ(maps.paths(0, 0), 5);
    EXPECT_EQ(maps.paths(1, 0), 4);
    EXPECT_TRUE(Film(2, 1, {}).reuse_maps(2).paths.empty());
}

/// Half differences have expectation 0 and the variance of the mean, for odd numbers of passes, too,
/// reconstruction (41). The film keeps the weight that the brightest sample has in them.
TEST(Film, HalfDifferencesHaveTheNoiseOfTheMean) {
    const float values[] = {3, 1, 2, 8, 6}, signs[] = {1, -1, 1, -1, 1}; // halves of passes 2-3, 4-7, ...
    for (const int passes : {2, 3, 4, 5}) {
        Film film(1, 1, {});
        Counters counters;
        double mean = 0;
        for (int pass = 0; pass < passes; ++pass) {
            film.add(0, 0, pass, {Rgb(values[pass])}, counters);
            film.finish(pass);
            mean += static_cast<double>(values[pass]) / passes;
        }
        double balance = 0, expected = 0, squares = 0;
        for (int pass = 0; pass < passes; ++pass)
            balance += static_cast<double>(signs[pass]) / passes;
        for (int pass = 0; pass < passes; ++pass) {
            const double weight = (static_cast<double>(signs[pass]) - balance) / passes;
            expected += weight * static_cast<double>(values[pass]);
            squares += weight * weight;
        }
        const double scale = 1 / std::sqrt(squares * passes); // scales to the variance of the mean
        const GradientImages images = film.means(passes);
        EXPECT_NEAR(images.halves.primal(0, 0).r, scale * expected, 1e-5) << passes;
        const double brightest = passes > 3 ? signs[3] : signs[0]; // the sample 8, or 3
        EXPECT_NEAR(images.brightest.half(0, 0), scale * (brightest - balance), 1e-6) << passes;
        EXPECT_TRUE(images.halves.dx.empty());
    }
    EXPECT_TRUE(Film(1, 1, {}).means(1).halves.empty());
}

TEST(Film, HalfDifferencesOfEqualSamplesAreZero) {
    Film film(2, 2, {.gradients = true}), other_film(2, 2, {.gradients = true});
    Counters counters;
    for (int pass = 0; pass < 7; ++pass) {
        Film& to = pass < 3 ? film : other_film; // shards of one render
        for (int i = 0; i < 4; ++i)
            to.add(i % 2, i / 2, pass, {Rgb(2), Rgb(0.5f), Rgb(-0.25f)}, counters);
        to.finish(pass);
    }
    film.add(other_film);
    const HalfDifferences halves = film.means(7).halves;
    for (const RgbImage* image : {&halves.primal, &halves.dx, &halves.dy})
        for (Rgb c : *image)
            EXPECT_NEAR(c.r, 0, 1e-6);
}

/// PixelSample::beside comes from the correlation of e and a within one sample. The unexplained variance is that
/// of the samples' means, and does not depend on it.
TEST(Film, UnexplainedVarianceIgnoresBeside) {
    const auto unexplained = [](bool has_beside) {
        Film film(1, 1, {.albedo = true, .means = true});
        Counters counters;
        const float e[] = {1, 2, 2, 1}, a[] = {0.5f, 0.5f, 0.6f, 0.6f};
        for (int i = 0; i < 4; ++i) {
            PixelSample sample = mean_of_two(e[i], a[i], e[i], a[i]);
            sample.beside = has_beside ? Rgb(0.05f) : Rgb(0);
            film.add(0, 0, i, sample, counters);
        }
        return film.means(4).demodulation.unexplained_variance(0, 0);
    };
    EXPECT_NEAR(unexplained(false), 3 * 1.0 / (4 * 2), 1e-6);
    EXPECT_FLOAT_EQ(unexplained(true), unexplained(false));
}

TEST(Film, RejectsInvalidFeatureAlbedos) {
    for (const float invalid : {infinity, -infinity, nan}) {
        Film film(2, 1, {.albedo = true});
        Counters counters;
        film.add_feature_sample(0, 0, 3, {Rgb(0.5f), {}}, counters);
        film.add_feature_sample(0, 0, 3, {Rgb(0.5f, invalid, 0.5f), {}}, counters);
        EXPECT_EQ(film.features().count(0, 0), 2);
        EXPECT_EQ(film.means(1).demodulation.albedo(0, 0), Rgb(0.25f));
        ASSERT_EQ(counters.invalid_samples, 1u);
        EXPECT_EQ(counters.first_invalid.list()[0], (InvalidSample{3, 0, 0}));
    }
}

/// The help of the settings table states this number.
TEST(Film, AlbedosTake168BytesAPixel) {
    EXPECT_EQ(Film::bytes(10, 1, {.albedo = true}) - Film::bytes(10, 1, {}) + 10 * Demodulation::bytes_a_pixel,
              1680u);
}

TEST(Film, AddsTheLargestFloat) {
    Film film(1, 1, {});
    Counters counters;
    for (int pass = 0; pass < 4; ++pass)
        film.add(0, 0, pass, {Rgb(std::numeric_limits<float>::max())}, counters);
    EXPECT_EQ(counters.invalid_samples, 0u);
    EXPECT_EQ(film.means(4).primal(0, 0), Rgb(std::numeric_limits<float>::max()));
}

/// Sums in floats would lose the small values. The means are exact to half a unit in the last place.
TEST(Film, SumsOfManyPassesDoNotDrift) {
    constexpr int passes = 100'001;
    Film film(1, 1, {.gradients = true, .reuse = true});
    Counters counters;
    film.add(0, 0, 0, {Rgb(1e8f, 1, 0), Rgb(0), Rgb(0), Rgb(-1e8f, 0, 1e8f)}, counters);
    for (int pass = 1; pass < passes; ++pass)
        film.add(0, 0, pass, {Rgb(0.1f, 1e-8f, 0.1f), Rgb(0), Rgb(0), Rgb(0.1f, 1e-8f, 1e-8f)}, counters);
    const GradientImages images = film.means(passes);
    const auto mean = [](double first, float others) { return (first + 1e5 * double(others)) / passes; };
    const glm::dvec3 primal(mean(1e8, 0.1f), mean(1, 1e-8f), mean(0, 0.1f));
    const glm::dvec3 very_direct(mean(-1e8, 0.1f), mean(0, 1e-8f), mean(1e8, 1e-8f));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(images.primal(0, 0)[c] / primal[c], 1, 1e-7);
        EXPECT_NEAR(images.very_direct(0, 0)[c] / very_direct[c], 1, 1e-7);
    }
}

/// The variance of a mean is the sum over the channels of s^2 / n, with s^2 as the sample variance.
TEST(Film, VariancesAreThoseOfTheMeans) {
    Film film(2, 2, {.gradients = true});
    Counters counters;
    const float values[] = {1, 2, 6}; // mean 3, s^2 = (4 + 1 + 9) / 2
    for (int pass = 0; pass < 3; ++pass)
        film.add(0, 0, pass, {Rgb(values[pass], 5, 0), Rgb(0, 2 * values[pass], 0), Rgb(0, 0, -values[pass])},
                 counters);
    EXPECT_TRUE(film.means(1).primal_variance.empty());
    for (const GradientImages& images : {film.means(3), film.take_means(3)}) {
        EXPECT_FLOAT_EQ(images.primal_variance(0, 0), 7.0f / 3);
        EXPECT_FLOAT_EQ(images.dx_variance(0, 0), 28.0f / 3);
        EXPECT_FLOAT_EQ(images.dy_variance(0, 0), 7.0f / 3);
        EXPECT_EQ(images.primal_variance(1, 1), 0);
        EXPECT_EQ(images.primal(0, 0), Rgb(3, 5, 0));
    }
}

TEST(Film, VariancesStayFinite) {
    Film film(1, 1, {});
    Counters counters;
    for (const float value : {std::numeric_limits<float>::max(), 0.0f})
        film.add(0, 0, 0, {Rgb(value)}, counters);
    EXPECT_EQ(film.means(2).primal_variance(0, 0), std::numeric_limits<float>::max());
}

/// Samples are sorted by pass, row and column, and each counts once. Neither their order nor their distribution
/// over counters changes the result.
TEST(Counters, KeepTheFirstInvalidSamplesInAnyOrder) {
    const InvalidSample in_order[] = {{1, 2, 9}, {1, 3, 0}, {1, 3, 1}, {2, 0, 0}};
    std::size_t order[] = {0, 1, 2, 3};
    do {
        Counters one, sums[2];
        for (std::size_t i = 0; i < 4; ++i) {
            one.refuse(in_order[order[i]]);
            sums[i % 2].refuse(in_order[order[i]]);
        }
        Counters all;
        all += sums[0];
        all += Counters{};
        all += sums[1];
        one.refuse(in_order[0]); // twice, as pixels that two blocks trace
        all.refuse(in_order[3]);
        for (const Counters& c : {one, all}) {
            EXPECT_EQ(c.invalid_samples, 5u);
            EXPECT_TRUE(std::ranges::equal(c.first_invalid.list(), in_order));
        }
    } while (std::next_permutation(std::begin(order), std::end(order)));
}

TEST(Counters, KeepOnlyTheFirstInvalidSamples) {
    Counters counters;
    constexpr int count = 3 * FirstInvalid::most;
    for (int i = 0; i < count; ++i)
        counters.refuse({0, 0, 7 * i % count}); // 7 and 48 have no common factor, so each occurs once
    EXPECT_EQ(counters.invalid_samples, static_cast<std::uint64_t>(count));
    ASSERT_EQ(counters.first_invalid.list().size(), FirstInvalid::most);
    for (std::size_t i = 0; i < FirstInvalid::most; ++i)
        EXPECT_EQ(counters.first_invalid.list()[i].x, static_cast<int>(i));
}

TEST(Counters, NameThePlaceOfTheFirstInvalidSample) {
    Counters counters;
    EXPECT_EQ(invalid_text(counters, 3), "");
    counters.refuse({5, 2, 7});
    counters.refuse({6, 2, 7});
    const std::string text = invalid_text(counters, 1234);
    for (const char* part : {"2 samples", "pass 5", "pixel (7, 2)", "seed 1234"})
        EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

} // namespace

} // namespace tessera::test
