#include "recon/metrics/metrics.h"
#include "render/run/first_hits.h"
#include "ui/state/buffer.h"
#include "ui/state/inspected.h"

#include <set>

#include <gtest/gtest.h>

namespace tessera {
namespace {

Snapshot snapshot_of(Method method) {
    auto images = std::make_shared<GradientImages>();
    images->primal = RgbImage(4, 3, Rgb(0.5f));
    images->very_direct = RgbImage(4, 3, Rgb(0.25f));
    if (has_gradients(method)) {
        images->dx = RgbImage(4, 3, Rgb(1));
        images->dy = RgbImage(4, 3, Rgb(2));
        images->dx_variance = Image<float>(4, 3, 11);
        images->dy_variance = Image<float>(4, 3, 12);
    }
    images->primal_variance = Image<float>(4, 3, 10);
    Snapshot snapshot;
    snapshot.settings.method = method;
    snapshot.images = images;
    if (method != Method::pt) // maps of two passes
        snapshot.reuse = std::make_shared<ReuseMaps>(ReuseMaps{{4, 3, {{15, 3, 0, 0, 2, 0}, 3, 1}},
                                                               2,
                                                               Image<float>(4, 3, 49),
                                                               Image<float>(4, 3, 2.5f),
                                                               Image<float>(4, 3, 9)});
    return snapshot;
}

std::shared_ptr<const Reconstruction> reconstruction(int width, int height) {
    auto result = std::make_shared<Reconstruction>();
    result->image = RgbImage(width, height, Rgb(7));
    return result;
}

float first(const Snapshot& snapshot, Buffer buffer) {
    RgbImage scratch;
    const RgbImage& image = picture(snapshot, buffer, scratch);
    return image.empty() ? -1.0f : image(0, 0).r;
}

TEST(Buffer, EachHasItsPicture) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    snapshot.reconstruction = reconstruction(4, 3);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reconstruction), 7);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::primal), 0.75f); // includes directly visible emission
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::dx), 1);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::dy), 2);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::very_direct), 0.25f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::primal_variance), 10);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::dx_variance), 11);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::dy_variance), 12);
}

TEST(Buffer, PrimalReplacesAMissingReconstruction) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reconstruction), 0.75f);
    snapshot.reconstruction = reconstruction(1, 1); // that of the preview
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reconstruction), 0.75f);
    Snapshot path_traced = snapshot_of(Method::pt); // denoised
    path_traced.reconstruction = reconstruction(4, 3);
    EXPECT_FLOAT_EQ(first(path_traced, Buffer::reconstruction), 7);
}

TEST(Buffer, MethodsWithoutGradientsHaveNone) {
    EXPECT_FLOAT_EQ(first(snapshot_of(Method::pt), Buffer::dx), -1);
    EXPECT_FLOAT_EQ(first(Snapshot{}, Buffer::primal), -1);
}

TEST(Buffer, BasisBuffersNeedABasis) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    auto images = std::make_shared<GradientImages>(*snapshot.images);
    images->demodulation = {RgbImage(4, 3, Rgb(0.4f)),
                            RgbImage(4, 3, Rgb(0.6f)),
                            RgbImage(4, 3, Rgb(0.7f)),
                            Image<float>(4, 3),
                            Image<float>(4, 3),
                            RgbImage(4, 3),
                            RgbImage(4, 3),
                            Image<float>(4, 3)};
    snapshot.images = images;
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::coefficient), 0.5f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::mean_albedo), 0.6f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::sampled_albedo), 0.7f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::covariance), 0.4f - 0.7f * 0.5f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::primal), 0.4f + 0.25f); // radiance, with directly visible emission
    snapshot = snapshot_of(Method::gpr);
    snapshot.settings.basis = Basis::none;
    for (Buffer buffer : {Buffer::coefficient, Buffer::mean_albedo, Buffer::sampled_albedo, Buffer::covariance}) {
        EXPECT_FLOAT_EQ(first(snapshot, buffer), -1);
        EXPECT_NE(missing_text(&snapshot, Method::gpr, buffer, {}).find("With basis \"none\""), std::string::npos);
        EXPECT_EQ(missing_text(nullptr, Method::pt, buffer, {}), "PT does not demodulate the albedo");
    }
}

TEST(Buffer, AComponentReplacesTheSum) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    auto images = std::make_shared<GradientImages>(*snapshot.images);
    const RgbImage grey_part(4, 3, Rgb(0.3f));
    const Image<float> variance(4, 3, 0.1f);
    for (const float projection : {0.25f, -0.75f})
        images->components.push_back(
            {Image<float>(4, 3, projection), grey_part, grey_part, grey_part, variance, variance, variance});
    images->demodulation.albedo = RgbImage(4, 3, Rgb(1));
    snapshot.images = images;
    snapshot.settings.basis = Basis::sh1;
    const auto first_of = [&](Buffer buffer, int component) {
        RgbImage scratch;
        Companions companions;
        if (component >= 0)
            companions.component = std::make_shared<const int>(component);
        EXPECT_EQ(companion_source(companions, buffer) != nullptr, component >= 0);
        return picture(snapshot, buffer, scratch, companions)(0, 0).r;
    };
    EXPECT_FLOAT_EQ(first_of(Buffer::projection, 1), -0.75f);
    EXPECT_FLOAT_EQ(first_of(Buffer::projection, -1), 0.25f);
    EXPECT_FLOAT_EQ(first_of(Buffer::coefficient, 1), 0.3f);
    EXPECT_FLOAT_EQ(first_of(Buffer::coefficient, -1), 0.5f);
    EXPECT_FLOAT_EQ(first_of(Buffer::coefficient, 2), 0.5f); // there is no such component: the sum
    EXPECT_FLOAT_EQ(first_of(Buffer::dx, 0), 0.3f);
    EXPECT_FLOAT_EQ(first_of(Buffer::dy_variance, 0), 0.1f);
    snapshot.settings.basis = Basis::albedo;
    EXPECT_NE(missing_text(&snapshot, Method::gpr, Buffer::projection, {}).find("one component"),
              std::string::npos);
    EXPECT_NE(missing_text(&snapshot, Method::pr, Buffer::projection, {}).find("no basis components"),
              std::string::npos);
}

TEST(Buffer, ReuseMapsNeedPathReuse) {
    const Snapshot snapshot = snapshot_of(Method::pr);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reused), 7.5f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::outcomes), 0.25f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::survival), 0.75f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reuse_set_size), 49);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::gain), 2.5f);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::samples), 9);
    EXPECT_EQ(legend_text(Buffer::gain, automatic_range(Buffer::gain, RgbImage(2, 2, Rgb(1e6f)))),
              "gain: 0.1 .. 10 times  log scale");
    EXPECT_EQ(picture_source(snapshot, Buffer::reused), snapshot.reuse);
    EXPECT_EQ(picture_source(snapshot, Buffer::outcomes), snapshot.reuse);
    for (Buffer map : {Buffer::reused, Buffer::outcomes, Buffer::survival, Buffer::reuse_set_size, Buffer::gain,
                       Buffer::samples}) {
        EXPECT_FLOAT_EQ(first(snapshot_of(Method::pt), map), -1);
        EXPECT_EQ(picture_source(snapshot_of(Method::pt), map), nullptr);
        EXPECT_TRUE(has_one_number(colour_map(map)));
    }
    EXPECT_NE(missing_text(&snapshot, Method::pr, Buffer::gain, {}).find("G-PR"), std::string::npos);
    EXPECT_NE(missing_text(&snapshot, Method::pr, Buffer::samples, {}).find("one sample per pass"), std::string::npos);
    EXPECT_NE(missing_text(nullptr, Method::gpt, Buffer::reuse_set_size, {}).find("no tiles"), std::string::npos);
}

/// Values are fractions. Colours are the mean of the outcomes' colours.
TEST(Buffer, OutcomesAreShownByMeanColours) {
    const Snapshot snapshot = snapshot_of(Method::pr);
    const auto colour = [](ShiftOutcome outcome) {
        const ImU32 c = outcome_colour(outcome);
        return Rgb(c & 255, c >> 8 & 255, c >> 16 & 255) / 255.0f;
    };
    const Rgb mean = 0.75f * colour(ShiftOutcome::ok) + 0.15f * colour(ShiftOutcome::occluded) +
                     0.1f * colour(ShiftOutcome::outside);
    const Rgb seen = own_colours(snapshot, Buffer::outcomes)(3, 2);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], mean[c], 1e-5f);
    EXPECT_TRUE(own_colours(snapshot, Buffer::survival).empty());
    EXPECT_TRUE(own_colours(snapshot_of(Method::pt), Buffer::outcomes).empty());
    EXPECT_EQ(outcome_colours({{1, 1}, 5})(0, 0), Rgb(0));
}

TEST(Buffer, FractionsOfOutcomesAsText) {
    EXPECT_EQ(outcome_shares({{714, 202, 0, 0, 3, 81}, 0, 0}),
              "ok 71 %, occluded 20 %, no light 8.1 %, outside 0.3 %");
    EXPECT_EQ(outcome_shares({{0, 0, 0, 7, 0, 0}, 0, 0}), "total reflection 100 %");
    EXPECT_EQ(outcome_shares({}), "no shifts");
}

TEST(Buffer, ErrorsOfEachKind) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    auto reconstructed = std::make_shared<Reconstruction>();
    reconstructed->image = RgbImage(4, 3, Rgb(0.5f, 0, 1));
    snapshot.reconstruction = reconstructed;
    auto reference = std::make_shared<Reference>();
    reference->image = RgbImage(4, 3, Rgb(0.25f, 0.5f, 1));
    reference->mean = 0.42f;
    const Companions companions{reference, nullptr};
    RgbImage scratch;
    const auto error = [&](Buffer buffer) { return picture(snapshot, buffer, scratch, companions)(2, 1).r; };
    EXPECT_FLOAT_EQ(error(Buffer::error_squared), (0.0625f + 0.25f) / 3);
    EXPECT_FLOAT_EQ(error(Buffer::error_absolute), 0.75f / 3);
    EXPECT_FLOAT_EQ(error(Buffer::error_relative), (0.25f / 0.26f + 0.5f / 0.51f) / 3);
    EXPECT_FLOAT_EQ(error(Buffer::error_relative_squared), (0.0625f / 0.0635f + 0.25f / 0.251f) / 3);
    EXPECT_NEAR(measure_error(reconstructed->image, reference->image).relative_mse,
                static_cast<double>(error(Buffer::error_relative_squared)), 1e-6);

    for (Buffer buffer : {Buffer::error_relative_squared, Buffer::error_squared, Buffer::error_absolute}) {
        const ValueRange range = automatic_range(buffer, scratch, companions);
        EXPECT_TRUE(range.logarithmic);
        EXPECT_GT(range.low, 0);
        EXPECT_EQ(range,
                  automatic_range(buffer, RgbImage(2, 2, Rgb(77)), companions)); // the same range for all pictures
    }
    EXPECT_EQ(companion_source(companions, Buffer::error_squared), reference);
    EXPECT_EQ(companion_source(companions, Buffer::primal), nullptr);
}

TEST(Buffer, MissingTextGivesTheReason) {
    const Snapshot snapshot = snapshot_of(Method::pt);
    RgbImage scratch;
    EXPECT_TRUE(picture(snapshot, Buffer::error_squared, scratch).empty());
    const auto why = [&](Buffer buffer, const Companions& companions = {}) {
        return missing_text(&snapshot, Method::pt, buffer, companions);
    };
    EXPECT_EQ(why(Buffer::primal), "");
    EXPECT_EQ(why(Buffer::albedo), "");
    EXPECT_EQ(why(Buffer::dx), "PT measures no gradients");
    EXPECT_EQ(why(Buffer::reused), "PT reuses no paths");
    EXPECT_NE(why(Buffer::error_squared).find("drop an EXR"), std::string::npos);
    auto other_size = std::make_shared<Reference>();
    other_size->image = RgbImage(7, 3, Rgb(1));
    EXPECT_TRUE(picture(snapshot, Buffer::error_squared, scratch, {other_size, nullptr}).empty());
    EXPECT_EQ(why(Buffer::error_squared, {other_size, nullptr}), "The reference has 7 x 3 pixels");
}

TEST(Buffer, FirstHitsNeedNoSamples) {
    auto hits = std::make_shared<FirstHits>();
    hits->albedo = RgbImage(2, 2, Rgb(0.5f));
    hits->normal = RgbImage(2, 2, Rgb(0, 1, 0));
    hits->depth = Image<float>(2, 2, 9);
    hits->footprint_1 = Image<float>(2, 2, 0.25f);
    RgbImage scratch;
    const Companions companions{nullptr, hits};
    EXPECT_EQ(picture({}, Buffer::albedo, scratch, companions)(0, 0), Rgb(0.5f));
    EXPECT_EQ(picture({}, Buffer::normal, scratch, companions)(0, 0), Rgb(0, 1, 0));
    EXPECT_EQ(picture({}, Buffer::depth, scratch, companions)(0, 0), Rgb(9));
    EXPECT_EQ(picture({}, Buffer::footprint_1, scratch, companions)(0, 0), Rgb(0.25f));
    EXPECT_TRUE(picture({}, Buffer::footprint_2, scratch, companions).empty()) << "it was not requested";
    EXPECT_TRUE(picture({}, Buffer::depth, scratch).empty());
}

TEST(Buffer, UpperLimitsAreRoundNumbers) {
    const auto top = [](float greatest) {
        RgbImage image(3, 2, Rgb(0));
        image(1, 1) = Rgb(greatest);
        return top_value(Buffer::reused, image);
    };
    EXPECT_FLOAT_EQ(top(47), 50);
    EXPECT_FLOAT_EQ(top(50), 50);
    EXPECT_FLOAT_EQ(top(8.1f), 10);
    EXPECT_FLOAT_EQ(top(10), 10);
    EXPECT_FLOAT_EQ(top(0.11f), 0.12f);
    EXPECT_FLOAT_EQ(top(101), 120);
    EXPECT_FLOAT_EQ(top(0), 1);
    EXPECT_FLOAT_EQ(top_value(Buffer::reused, RgbImage()), 1);
    EXPECT_FLOAT_EQ(top_value(Buffer::outcomes, RgbImage(2, 2, Rgb(0.3f))), 1);
    EXPECT_FLOAT_EQ(top_value(Buffer::survival, RgbImage(2, 2, Rgb(0.3f))), 1);
}

TEST(Buffer, LegendNamesTheQuantity) {
    EXPECT_EQ(legend_text(Buffer::reused, {0, 50}), "reused: 0 .. 50 paths per pass");
    EXPECT_EQ(legend_text(Buffer::reused, {0, 0.12f}), "reused: 0 .. 0.12 paths per pass");
    EXPECT_EQ(legend_text(Buffer::survival, {0, 1}), "survival: 0 .. 100 %");
}

TEST(Buffer, NamesAreUnique) {
    std::set<std::string_view> names;
    for (Buffer buffer : all_buffers) {
        EXPECT_TRUE(names.insert(short_name(buffer)).second);
        EXPECT_TRUE(names.insert(long_name(buffer)).second);
    }
    EXPECT_EQ(names.count(""), 0u);
    for (Buffer buffer : all_buffers)
        EXPECT_EQ(info(buffer).buffer, buffer);
}

TEST(Buffer, SourceChangesOnlyWithThePicture) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    snapshot.reconstruction = reconstruction(4, 3);
    Snapshot newer = snapshot_of(Method::gpr);
    newer.reconstruction = snapshot.reconstruction;
    EXPECT_EQ(picture_source(snapshot, Buffer::reconstruction), picture_source(newer, Buffer::reconstruction));
    EXPECT_NE(picture_source(snapshot, Buffer::dx), picture_source(newer, Buffer::dx));
    EXPECT_EQ(picture_source(Snapshot{}, Buffer::dx), nullptr);
}

} // namespace
} // namespace tessera
