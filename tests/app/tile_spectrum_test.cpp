// Visibility of the tile grid in an error image, on synthetic images with and without a grid.
#include "app/experiment/artefacts.h"

#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr int width = 200, height = 150, tile = 6;
const RgbImage truth(width, height, Rgb(1));

/// Adds noise that is constant in each tile of a grid shifted by (x0, y0), in pixels.
void add_tiled_noise(RgbImage& image, int x0, int y0, float deviation, std::mt19937& random) {
    std::normal_distribution<float> normal(0, deviation);
    Image<float> values(width / tile + 3, height / tile + 3);
    for (float& v : values)
        v = normal(random);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image(x, y) += Rgb(values((x + x0) / tile, (y + y0) / tile));
}

void add_pixel_noise(RgbImage& image, float deviation, std::mt19937& random) {
    std::normal_distribution<float> normal(0, deviation);
    for (Rgb& c : image)
        c += Rgb(normal(random));
}

TEST(TileSpectrum, OfIndependentPixelsIsFlat) {
    std::mt19937 random(1);
    RgbImage image = truth;
    add_pixel_noise(image, 0.1f, random);
    const TileSpectrum s = measure_tile_spectrum(image, truth, tile);
    EXPECT_NEAR(s.error, 1, 0.15);
    EXPECT_LT(s.edges, 4); // distributed about as (1 + chi-square with 6 degrees of freedom) / 6
    EXPECT_NEAR(s.edge_ratio, 1, 0.1);
}

TEST(TileSpectrum, ConstantNoiseInTilesShowsAtTheirEdges) {
    std::mt19937 random(2);
    RgbImage image = truth;
    add_tiled_noise(image, 0, 0, 0.1f, random);
    add_pixel_noise(image, 0.02f, random);
    const TileSpectrum s = measure_tile_spectrum(image, truth, tile);
    EXPECT_LT(s.error, 0.2);
    EXPECT_GT(s.edges, 100);
    // The ratio of squared steps at edges and inside is 2 (0.01 + 0.0004) / (2 * 0.0004).
    EXPECT_NEAR(s.edge_ratio, 26, 6);
}

/// Each pass moves the grid, as in a render.
TEST(TileSpectrum, OfManyMovedGridsIsFlat) {
    std::mt19937 random(3);
    RgbImage image = truth;
    std::uniform_int_distribution<int> origin(0, tile - 1);
    for (int pass = 0; pass < 256; ++pass)
        add_tiled_noise(image, origin(random), origin(random), 0.1f / 16, random);
    const TileSpectrum s = measure_tile_spectrum(image, truth, tile);
    EXPECT_NEAR(s.edge_ratio, 1, 0.35); // 256 random origins are not exactly uniform
    EXPECT_LT(s.edges, 30);
}

TEST(TileSpectrum, DetectsAPatternInEveryTile) {
    std::mt19937 random(4);
    RgbImage image = truth;
    add_pixel_noise(image, 0.1f, random);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; x += tile)
            image(x, y) += Rgb(0.1f); // the first column of each tile is too bright
    EXPECT_GT(measure_tile_spectrum(image, truth, tile).error, 3);
    EXPECT_LT(measure_tile_spectrum(image, truth, tile + 1).error, 1.3) << "not for tiles of another size";
}

TEST(TileSpectrum, RelativeErrorsCountEquallyInDarkAndBrightAreas) {
    std::mt19937 random(5);
    RgbImage image = truth;
    add_tiled_noise(image, 2, 3, 0.1f, random);
    RgbImage brighter = image, bright = truth;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x) {
            brighter(x, y) *= 1000.0f;
            bright(x, y) *= 1000.0f;
        }
    const TileSpectrum a = measure_tile_spectrum(image, truth, tile),
                       b = measure_tile_spectrum(brighter, bright, tile);
    EXPECT_NEAR(a.edges / b.edges, 1, 0.01);
    EXPECT_NEAR(a.error / b.error, 1, 0.01);
}

TEST(TileSpectrum, RejectsImagesWithoutASpectrum) {
    EXPECT_THROW(measure_tile_spectrum(truth, truth, 1), std::invalid_argument);
    EXPECT_THROW(measure_tile_spectrum(truth, truth, 38), std::invalid_argument);
    EXPECT_THROW(measure_tile_spectrum(truth, RgbImage(3, 3), 2), std::invalid_argument);
    EXPECT_EQ(measure_tile_spectrum(truth, truth, 6).error, 1) << "without error, there is no grid";
}

} // namespace
} // namespace tessera
