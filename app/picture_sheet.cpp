#include "app/picture_sheet.h"

#include <algorithm>

#include <stb_easy_font.h>

namespace tessera {

namespace {

constexpr int label_height = 18;

/// Draws text at the top left corner of `image`, in pixels; what does not fit is cut off.
void draw_text(RgbImage& image, int left, int top, const std::string& text) {
    struct Corner {
        float x, y, z;
        unsigned char color[4];
    };
    std::vector<Corner> corners(text.size() * 64);
    std::string copy = text; // the font's interface takes no const
    const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, corners.data(),
                                          static_cast<int>(corners.size() * sizeof(Corner)));
    for (int q = 0; q < quads; ++q) {
        const Corner* c = corners.data() + 4 * q;
        for (int y = static_cast<int>(c[0].y); y < static_cast<int>(c[2].y); ++y)
            for (int x = static_cast<int>(c[0].x); x < static_cast<int>(c[2].x); ++x)
                if (left + x < image.width() && top + y < image.height())
                    image(left + x, top + y) = Rgb(1);
    }
}

} // namespace

RgbImage picture_sheet(const std::vector<LabelledPicture>& pictures, int columns) {
    const int w = pictures[0].image.width(), h = pictures[0].image.height() + label_height;
    const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
    RgbImage sheet(columns * w, rows * h, Rgb(0.02f));
    for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
        const int left = i % columns * w, top = i / columns * h;
        const RgbImage& image = pictures[static_cast<std::size_t>(i)].image;
        for (int y = 0; y < image.height(); ++y)
            std::copy_n(image.row(y), image.width(), sheet.row(top + label_height + y) + left);
        draw_text(sheet, left + 4, top + 5, pictures[static_cast<std::size_t>(i)].label);
    }
    return sheet;
}

} // namespace tessera
