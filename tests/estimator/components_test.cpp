// Components of a basis [Fang 2024]: they equal those of the naive path tracer for all methods and shifts, and
// their sum loses nothing, theory (30) and (31).
#include "recon/picture/reconstruct.h"
#include "render/estimator/basis.h"
#include "render/run/render.h"
#include "tests/support/rooms.h"
#include "tests/support/z_scores.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr Basis expanding[] = {Basis::sh1, Basis::sh2, Basis::sh3, Basis::box};

/// Returns the integral of `value` over the sphere, by equal steps of z and azimuth.
double integral_over_sphere(const std::function<double(glm::vec3)>& value) {
    constexpr int steps = 600;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const float z = 2 * (static_cast<float>(i) + 0.5f) / steps - 1, r = std::sqrt(1 - z * z);
            const float phi = 2 * pi * (static_cast<float>(j) + 0.5f) / steps;
            sum += value({r * std::cos(phi), r * std::sin(phi), z});
        }
    return sum * 4 * static_cast<double>(pi) / (steps * steps);
}

TEST(Parts, FunctionsAreOrthogonalWithEqualNorms) {
    for (const Basis basis : expanding) {
        const int components = component_count(basis);
        const auto at = [&](glm::vec3 d, int l) {
            float values[max_components];
            evaluate_basis(basis, d, values);
            return static_cast<double>(values[l]);
        };
        const double square = integral_over_sphere([&](glm::vec3 d) { return at(d, 0) * at(d, 0); });
        float uniform[max_components];
        project_evenly(basis, uniform);
        // project_evenly() is for g = 1 / (4 pi): its projections are the integrals divided by this scale.
        const double scale = std::sqrt(4 * static_cast<double>(pi) * square);
        for (int l = 0; l < components; ++l) {
            EXPECT_NEAR(integral_over_sphere([&](glm::vec3 d) { return at(d, l); }),
                        scale * static_cast<double>(uniform[l]), 1e-3);
            for (int k = 0; k <= l; ++k)
                EXPECT_NEAR(integral_over_sphere([&](glm::vec3 d) { return at(d, l) * at(d, k); }),
                            l == k ? square : 0, 1e-3)
                    << l << ' ' << k;
        }
    }
}

TEST(Parts, ProjectionOfADiffuseSurfaceHasALengthOfAboutOne) {
    for (const Basis basis : expanding)
        for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::normalize(glm::vec3(1, -2, 0.5f))}) {
            Vertex x;
            x.frame = Frame(normal);
            x.to_previous = glm::normalize(glm::vec3(0.3f, 0.2f, 0.8f));
            x.bsdf.kind = Diffuse{Rgb(0.7f, 0.4f, 0.1f)};
            float s[max_components] = {};
            project(x, basis, 4000, s);
            double squares = 0;
            for (int l = 0; l < component_count(basis); ++l)
                squares += static_cast<double>(s[l] * s[l]);
            EXPECT_NEAR(squares, 1, basis == Basis::box ? 0.35 : basis == Basis::sh1 ? 0.13 : 0.01);
        }
}

/// The sum of functions times projections approximates g itself and not a multiple of it, which would leave a
/// large residual.
TEST(Parts, FunctionsTimesProjectionsApproximateTheBsdf) {
    for (const Basis basis : expanding) {
        Vertex x;
        x.frame = Frame(glm::normalize(glm::vec3(1, -2, 0.5f)));
        x.to_previous = glm::normalize(glm::vec3(0.3f, 0.2f, 0.8f));
        x.bsdf.kind = Diffuse{Rgb(0.7f)};
        float s[max_components] = {};
        project(x, basis, 4000, s);
        const auto g = [&](glm::vec3 d) { return std::max(glm::dot(d, x.frame.normal), 0.0f) * inv_pi; };
        const double residual = integral_over_sphere([&](glm::vec3 d) {
            float values[max_components];
            evaluate_basis(basis, d, values);
            double sum = -g(d);
            for (int l = 0; l < component_count(basis); ++l)
                sum += static_cast<double>(s[l] * values[l]);
            return sum * sum;
        });
        const double square = integral_over_sphere([&](glm::vec3 d) { return static_cast<double>(g(d) * g(d)); });
        EXPECT_LT(residual, square * (basis == Basis::box ? 0.35 : basis == Basis::sh1 ? 0.14 : 0.01));
    }
}

const TestScene& scene_named(const std::string& name) {
    static const std::vector<TestScene> scenes = all_test_scenes();
    return *std::ranges::find(scenes, name, &TestScene::name);
}

struct Variant {
    const char* name;
    Method method;
    int tile;
    Basis basis;
    ShiftKind shift;
};

constexpr Variant variants[] = {
    {"gpt", Method::gpt, 1, Basis::sh1, ShiftKind::half_vector},
    {"gpr", Method::gpr, 6, Basis::sh2, ShiftKind::half_vector},
    {"gpr, boxes", Method::gpr, 3, Basis::box, ShiftKind::half_vector},
    {"gpr, reconnection", Method::gpr, 4, Basis::sh1, ShiftKind::reconnection},
    {"gpr, replay", Method::gpr, 3, Basis::sh1, ShiftKind::replay},
    {"gpr, replay-reconnection", Method::gpr, 4, Basis::box, ShiftKind::replay_reconnection},
};

RenderSettings settings_of(const Variant& v, const TestScene& t) {
    RenderSettings s;
    s.method = v.method;
    s.tile = v.tile;
    s.basis = v.basis;
    s.shift = v.shift;
    s.max_depth = t.max_depth;
    s.shift_threshold = t.shift_threshold;
    s.shift_distance = t.shift_distance;
    s.roulette_depth = 0; // the paths that survive it weigh more, which needs more runs
    return s;
}

GradientImages images_of(const TestScene& t, const RenderSettings& settings, glm::ivec2 size, int passes) {
    Render render(t.scene, t.scene->camera(), size, settings);
    ThreadPool pool(1);
    for (int i = 0; i < passes; ++i)
        render.pass(pool);
    return render.images();
}

/// Mean and standard error of one component over many renders.
class PartMoments {
public:
    explicit PartMoments(glm::ivec2 size) : sum_(size.x, size.y, glm::dvec3(0)), squares_(sum_) {}

    void add(const RgbImage& image) {
        for (std::size_t i = 0; i < image.size(); ++i) {
            const glm::dvec3 v(image.data()[i]);
            sum_.data()[i] += v;
            squares_.data()[i] += v * v;
        }
        ++count_;
    }
    Measured measured() const {
        Measured result{RgbImage(sum_.width(), sum_.height()), RgbImage(sum_.width(), sum_.height())};
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            const glm::dvec3 mean = sum_.data()[i] / count_;
            const glm::dvec3 variance = glm::max(squares_.data()[i] / count_ - mean * mean, 0.0);
            result.mean.data()[i] = Rgb(mean);
            result.standard_error.data()[i] = Rgb(glm::sqrt(variance / (count_ - 1)));
        }
        return result;
    }

private:
    Image<glm::dvec3> sum_, squares_;
    double count_ = 0;
};

/// A z-test of one component.
struct ComponentTest {
    std::size_t component;
    const char* image;
    ZResult z;
};

/// Returns z-tests of all components by `runs` renders, with consecutive seeds from `settings.seed` on.
std::vector<ComponentTest> tests_of(const TestScene& t, RenderSettings settings, glm::ivec2 size, int runs,
                                    const std::vector<Measured>& truth) {
    constexpr int passes = 16;
    std::vector<PartMoments> primal(truth.size(), PartMoments(size)), dx(primal), dy(primal);
    for (int run = 0; run < runs; ++run, ++settings.seed) {
        const GradientImages images = images_of(t, settings, size, passes);
        for (std::size_t l = 0; l < primal.size(); ++l) {
            primal[l].add(images.components[l].primal);
            dx[l].add(images.components[l].dx);
            dy[l].add(images.components[l].dy);
        }
    }
    std::vector<ComponentTest> tests;
    for (std::size_t l = 0; l < primal.size(); ++l) {
        tests.push_back({l, "primal", z_test(primal[l].measured(), truth[l])});
        tests.push_back({l, "dx", z_test(dx[l].measured(), difference_x(truth[l]))});
        tests.push_back({l, "dy", z_test(dy[l].measured(), difference_y(truth[l]))});
    }
    return tests;
}

/// Expects the components of all variants to equal those of the naive path tracer with so many samples a pixel.
void expect_naive_components(const std::string& scene, int runs, int samples) {
    constexpr glm::ivec2 size(6, 5);
    const TestScene& t = scene_named(scene);
    for (const Variant& v : variants) {
        RenderSettings settings = settings_of(v, t);
        const int components = component_count(v.basis);
        const std::vector<BasisComponent> expanded = images_of(t, settings, size, 1).components;
        const ComponentsOf components_of = [&](glm::ivec2 p, Rgb albedo, std::span<const ByDirection> light,
                                               std::span<Rgb> result) {
            ArrivingLight arriving;
            arriving.reset(v.basis, {&albedo, 1});
            Rgb all(0);
            for (const ByDirection& one : light) {
                if (!std::isinf(one.f_cos.x))
                    arriving.add(0, one.direction, one.f_cos, one.carried);
                all += one.carried;
            }
            float projection[max_components];
            for (int l = 0; l < components; ++l)
                projection[l] = expanded[static_cast<std::size_t>(l)].projection(p.x, p.y);
            arriving.expand(0, all / albedo, projection, result.data());
        };
        const std::vector<Measured> truth = render_naive_components(
            *t.scene, size, t.max_depth, samples * t.effort, 11, components, components_of);
        const auto tests_of_runs = [&](std::uint64_t seed, int count) {
            settings.seed = seed;
            return tests_of(t, settings, size, count, truth);
        };
        for (const ComponentTest& test : tests_by_enough_runs(400, runs * t.effort, tests_of_runs))
            EXPECT_TRUE(test.z.passes()) << scene << ' ' << v.name << " component " << test.component << ' '
                                         << test.image << ": " << test.z.to_string();
    }
}

class PartsOfScene : public testing::TestWithParam<std::string> {};
TEST_P(PartsOfScene, EqualTheNaivePathTracers) {
    expect_naive_components(GetParam(), 60, 40'000);
}
INSTANTIATE_TEST_SUITE_P(scenes, PartsOfScene, testing::Values("texture_edges", "black_texels", "rough_plastic"),
                         [](const auto& p) { return p.param; });

/// In scenes with rare bright paths, few runs underestimate standard errors.
class SlowPartsOfScene : public testing::TestWithParam<std::string> {};
TEST_P(SlowPartsOfScene, EqualTheNaivePathTracers) {
    expect_naive_components(GetParam(), 300, 200'000);
}
INSTANTIATE_TEST_SUITE_P(scenes, SlowPartsOfScene,
                         testing::Values("shining_wall", "translucent", "mirror", "glossy", "brushed"),
                         [](const auto& p) { return p.param; });

/// The film's projections are means over points of a pixel, not sums.
TEST(Parts, ProjectionsOfDiffusePixelsHaveALengthOfAboutOne) {
    const TestScene& t = scene_named("diffuse");
    const GradientImages images = images_of(t, settings_of(variants[1], t), {9, 7}, 1);
    for (std::size_t i = 0; i < images.primal.size(); ++i) {
        double squares = 0;
        for (const BasisComponent& component : images.components)
            squares += static_cast<double>(component.projection.data()[i] * component.projection.data()[i]);
        EXPECT_GT(squares, 0.06); // a pixel that sees black at three of four points
        EXPECT_LT(squares, 1.1);
    }
}

/// theory (31): the sum of components times projections is the coefficient of each sample, and so of the means.
TEST(Parts, SumTimesProjectionsIsTheCoefficient) {
    constexpr glm::ivec2 size(9, 7);
    for (const TestScene& t : all_test_scenes())
        for (const Variant& v : variants) {
            const GradientImages images = images_of(t, settings_of(v, t), size, 2);
            double largest = 0, difference = 0;
            for (std::size_t i = 0; i < images.primal.size(); ++i) {
                Rgb sum(0);
                for (const BasisComponent& component : images.components)
                    sum += component.projection.data()[i] * component.primal.data()[i];
                largest = std::max(largest, static_cast<double>(glm::length(images.primal.data()[i])));
                difference = std::max(difference, static_cast<double>(glm::length(sum - images.primal.data()[i])));
            }
            EXPECT_LE(difference, 1e-5 * largest) << t.name << ' ' << v.name;
        }
}

} // namespace

} // namespace tessera::test
