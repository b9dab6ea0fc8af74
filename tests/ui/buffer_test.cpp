#include "ui/buffer.h"

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
