#include "app/compare/picture_comparison.h"

#include "recon/metrics/seen_error.h"
#include "recon/metrics/valid_pixels.h"
#include "render/run/reference_image.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

PixelRect common(const PixelRect& a, const PixelRect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// Returns the pixels of the image within its view.
PixelRect visible(const Picture& picture) {
    return common(picture.data, picture.display);
}

std::string text_of(const PixelRect& rect) {
    return fmt::format("{}x{} pixels from ({}, {})", rect.width(), rect.height(), rect.x0, rect.y0);
}

std::string size_text(const PixelRect& rect) {
    return fmt::format("{}x{}", rect.width(), rect.height());
}

RgbImage cut(const Picture& picture, const PixelRect& rect) {
    RgbImage part(rect.width(), rect.height());
    for (int y = 0; y < rect.height(); ++y)
        std::copy_n(picture.image.row(y + rect.y0 - picture.data.y0) + (rect.x0 - picture.data.x0), rect.width(),
                    part.row(y));
    return part;
}

/// Returns the common pixels of two pictures. Throws std::runtime_error.
PixelRect common_rect(const NamedPicture& a, const NamedPicture& b) {
    const PixelRect in_a = visible(a.picture), in_b = visible(b.picture);
    const bool are_whole = in_a == a.picture.display && in_b == b.picture.display;
    const bool have_one_corner = in_a.x0 == in_b.x0 && in_a.y0 == in_b.y0;
    if (are_whole && have_one_corner && in_a != in_b)
        throw std::runtime_error(fmt::format("sizes differ: {} is {}, {} is {}", a.path.string(), size_text(in_a),
                                             b.path.string(), size_text(in_b)));
    for (const auto& [picture, rect] : {std::pair(&a, in_a), std::pair(&b, in_b)})
        if (rect.empty())
            throw std::runtime_error(picture->path.string() + " has no pixels within its display window");
    const PixelRect rect = common(in_a, in_b);
    if (rect.empty())
        throw std::runtime_error(fmt::format("the pictures do not overlap: {} has {}, {} has {}", a.path.string(),
                                             text_of(in_a), b.path.string(), text_of(in_b)));
    return rect;
}

/// Adds what is cut of a picture.
void note_cuts(const NamedPicture& p, const PixelRect& rect, std::vector<std::string>& notes) {
    const PixelRect seen = visible(p.picture);
    if (seen != p.picture.data)
        notes.push_back(fmt::format("{}: pixels outside its display window are cut: {} of {} remain",
                                    p.path.string(), size_text(seen), size_text(p.picture.data)));
    if (seen != rect)
        notes.push_back(fmt::format("{}: compared where the pictures overlap: {} of its {}", p.path.string(),
                                    text_of(rect), size_text(seen)));
}

void check_tile(const RgbImage& image, int tile) {
    if (tile < 2 || std::min(image.width(), image.height()) < 4 * tile)
        throw std::runtime_error("a tile spectrum needs tiles of at least 2 pixels, and 4 tiles along each edge");
}

} // namespace

RgbImage AlignedPictures::mean_reference() const {
    return reference2.empty() ? reference1 : mean_of(reference1, reference2);
}

AlignedPictures align(const NamedPicture& image, const References& references) {
    PixelRect rect = common_rect(image, references.first);
    if (references.second)
        rect = common(rect, common_rect(image, *references.second));
    if (rect.empty())
        throw std::runtime_error("the picture and both references have no common pixels");
    AlignedPictures aligned{cut(image.picture, rect), cut(references.first.picture, rect), {}, rect};
    note_cuts(image, rect, aligned.notes);
    note_cuts(references.first, rect, aligned.notes);
    if (references.second) {
        aligned.reference2 = cut(references.second->picture, rect);
        if (references.second->path != references.first.path) // halves of one file
            note_cuts(*references.second, rect, aligned.notes);
    }
    return aligned;
}

PictureComparison compare_pictures(const AlignedPictures& pictures, int tile) {
    const bool has_two = !pictures.reference2.empty();
    const RgbImage& image = pictures.image;
    const RgbImage& reference1 = pictures.reference1;
    const RgbImage& reference2 = has_two ? pictures.reference2 : reference1;
    const std::vector<std::size_t> invalid = invalid_pixels({&image, &reference1, &reference2});
    if (invalid.size() == image.size())
        throw std::runtime_error("no pixel is finite in all pictures");
    PictureComparison result;
    result.pixels = image.size();
    result.invalid = invalid.size();
    result.image_invalid = invalid_pixels({&image}).size();

    const RgbImage mean = pictures.mean_reference();
    const RgbImage valid = without(image, invalid), valid1 = without(reference1, invalid),
                   valid2 = without(reference2, invalid);
    result.metrics = measure_error(valid, without(mean, invalid));
    result.psnr = psnr(valid, valid1, valid2);
    const auto dark = std::ranges::count_if(valid, [](Rgb c) { return luminance(c) <= 0; });
    result.without_light = static_cast<double>(dark) / static_cast<double>(valid.size());

    // Errors that depend on neighbours: invalid pixels are black in all images, and the mean is over the others.
    const RgbImage black = blackened(image, invalid), black_mean = blackened(mean, invalid);
    const double valid_fraction = static_cast<double>(valid.size()) / static_cast<double>(image.size());
    double flip_sum = 0;
    for (const Rgb& difference : without(grey(flip(black, black_mean)), invalid))
        flip_sum += static_cast<double>(difference.r);
    result.flip = flip_sum / static_cast<double>(valid.size());
    if (has_two) {
        FloorFreeError error =
            measure_floor_free_error(black, blackened(reference1, invalid), blackened(reference2, invalid));
        error.relative_mse /= valid_fraction;
        error.standard_error /= valid_fraction;
        result.floor_free = error;
        result.energy_change = measure_energy_change(valid, valid1, valid2);
    }
    if (tile > 0) {
        check_tile(image, tile);
        result.tiles = measure_tile_spectrum(black, black_mean, tile);
    }
    return result;
}

} // namespace tessera
