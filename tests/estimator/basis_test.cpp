// Reconstructions of the coefficient (radiance over albedo): `l2` is unbiased at few samples, and the default
// keeps the mean radiance.
#include "recon/picture/reconstruct.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "tests/support/rooms.h"
#include "tests/support/z_scores.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

const TestScene& scene_named(const std::string& name) {
    static const std::vector<TestScene> scenes = all_test_scenes();
    return *std::ranges::find(scenes, name, &TestScene::name);
}

/// Two passes are too few for estimators that are only consistent. In these scenes albedo and radiance are
/// correlated within pixels, so the covariance of theory (28) matters.
TEST(Basis, IsUnbiasedInTheMeanOfManyRendersOfTwoPasses) {
    constexpr glm::ivec2 size(4, 4);
    constexpr int renders = 20'000;
    for (const char* name : {"texture_edges", "black_texels"}) {
        const TestScene& t = scene_named(name);
        const NaiveMeasured truth = render_naive(*t.scene, size, 3, 500'000, 7);
        const double covariance_fraction = [&] {
            RenderSettings s;
            s.max_depth = 3;
            Render render(t.scene, t.scene->camera(), size, s);
            ThreadPool pool(1);
            for (int i = 0; i < 64; ++i)
                render.pass(pool);
            const GradientImages images = render.images();
            double covariance = 0, value = 0;
            for (std::size_t i = 0; i < images.primal.size(); ++i) {
                const Rgb v = images.radiance().data()[i];
                const Rgb product = images.demodulation.albedo.data()[i] * images.primal.data()[i];
                covariance += std::abs(static_cast<double>(luminance(v - product)));
                value += static_cast<double>(luminance(v));
            }
            return covariance / value;
        }();
        EXPECT_GT(covariance_fraction, 0.03) << name << " has too little covariance to test";
        for (const Method method : {Method::gpt, Method::gpr}) {
            RenderSettings s;
            s.method = method;
            s.tile = 4;
            s.max_depth = 3;
            s.seed = 77'000;
            constexpr Norm l2[] = {Norm::l2};
            const ZResult z = z_test(measure(t.scene, size, s, renders, 2, l2).pictures.at(Norm::l2),
                                     sum(truth.light, truth.very_direct));
            EXPECT_TRUE(z.passes()) << name << ' ' << short_name(method) << ": " << z.to_string();
        }
    }
}

double mean_luminance(const RgbImage& image) {
    double sum = 0;
    for (const Rgb& c : image)
        sum += static_cast<double>(luminance(c));
    return sum / static_cast<double>(image.size());
}

/// The factor k of reconstruction (47) removes a part of the covariance at few samples. The mean of the samples
/// shows that this changes the brightness of the picture by little.
TEST(Basis, KeepsTheEnergyWithTwoPasses) {
    for (const char* name : {"edges", "leaves"}) {
        const std::string file = std::string(TESSERA_SOURCE_DIR) + "/assets/stability/" + name + ".xml";
        const auto scene = std::make_shared<const Scene>(load_mitsuba_xml(file).description);
        ThreadPool pool(2);
        double picture = 0, samples = 0;
        for (std::uint64_t seed = 0; seed < 24; ++seed) {
            RenderSettings s;
            s.seed = seed;
            Render render(scene, scene->camera(), {96, 72}, s);
            render.pass(pool);
            render.pass(pool);
            const GradientImages images = render.images();
            picture += mean_luminance(reconstruct(images, {}).image);
            samples += mean_luminance(images.radiance()) + mean_luminance(images.very_direct);
        }
        EXPECT_NEAR(picture / samples, 1, 0.003) << name;
    }
}

} // namespace

} // namespace tessera::test
