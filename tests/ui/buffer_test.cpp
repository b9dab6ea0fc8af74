#include "ui/buffer.h"

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
    }
    Snapshot snapshot;
    snapshot.settings.method = method;
    snapshot.images = images;
    if (method != Method::pt)
        snapshot.reuse = std::make_shared<ReuseMaps>(ReuseMaps{{4, 3, 17.0f}, {4, 3, 0.25f}});
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

TEST(Buffer, PictureOfEach) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    snapshot.reconstruction = reconstruction(4, 3);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reconstruction), 7);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::primal), 0.75f); // with the very direct light
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::dx), 1);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::dy), 2);
}

TEST(Buffer, PrimalStandsInForTheReconstruction) {
    Snapshot snapshot = snapshot_of(Method::gpr);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reconstruction), 0.75f);
    snapshot.reconstruction = reconstruction(1, 1); // still that of the first look
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reconstruction), 0.75f);
    Snapshot path_traced = snapshot_of(Method::pt); // whose newest pass needs none
    path_traced.reconstruction = reconstruction(4, 3);
    EXPECT_FLOAT_EQ(first(path_traced, Buffer::reconstruction), 0.75f);
}

TEST(Buffer, MethodsWithoutGradientsHaveNone) {
    EXPECT_FLOAT_EQ(first(snapshot_of(Method::pt), Buffer::dx), -1);
    EXPECT_FLOAT_EQ(first(Snapshot{}, Buffer::primal), -1);
}

TEST(Buffer, MapsOfReuseWhereThereIsAny) {
    const Snapshot snapshot = snapshot_of(Method::pr);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::reused), 17);
    EXPECT_FLOAT_EQ(first(snapshot, Buffer::failed), 0.25f);
    EXPECT_EQ(picture_source(snapshot, Buffer::reused), snapshot.reuse);
    EXPECT_EQ(picture_source(snapshot, Buffer::failed), snapshot.reuse);
    for (Buffer map : {Buffer::reused, Buffer::failed}) {
        EXPECT_FLOAT_EQ(first(snapshot_of(Method::pt), map), -1);
        EXPECT_EQ(picture_source(snapshot_of(Method::pt), map), nullptr);
        EXPECT_EQ(colour_map(map), ColourMap::false_colour);
    }
}

TEST(Buffer, TopValuesReadWell) {
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
    EXPECT_FLOAT_EQ(top_value(Buffer::failed, RgbImage(2, 2, Rgb(0.3f))), 1);
}

TEST(Buffer, LegendSaysWhatTheColoursStandFor) {
    EXPECT_EQ(legend_text(Buffer::reused, 50), "reused: 0 .. 50 paths a pass");
    EXPECT_EQ(legend_text(Buffer::reused, 0.12f), "reused: 0 .. 0.12 paths a pass");
    EXPECT_EQ(legend_text(Buffer::failed, 1), "failed: 0 .. 100 %");
}

TEST(Buffer, EveryOneHasNamesOfItsOwn) {
    std::set<std::string_view> names;
    for (Buffer buffer : all_buffers) {
        EXPECT_TRUE(names.insert(short_name(buffer)).second);
        EXPECT_TRUE(names.insert(long_name(buffer)).second);
    }
    EXPECT_EQ(names.count(""), 0u);
}

TEST(Buffer, SourceChangesWithWhatIsShownOnly) {
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
