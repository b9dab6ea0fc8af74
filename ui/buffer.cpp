#include "ui/buffer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tessera {

std::string_view short_name(Buffer buffer) {
    switch (buffer) {
    case Buffer::reconstruction:
        return "reconstruction";
    case Buffer::primal:
        return "primal";
    case Buffer::dx:
        return "dx";
    case Buffer::dy:
        return "dy";
    case Buffer::reused:
        return "reused";
    case Buffer::failed:
        return "failed";
    }
    return "";
}

std::string_view long_name(Buffer buffer) {
    switch (buffer) {
    case Buffer::reconstruction:
        return "Reconstruction";
    case Buffer::primal:
        return "Primal";
    case Buffer::dx:
        return "Gradient dx";
    case Buffer::dy:
        return "Gradient dy";
    case Buffer::reused:
        return "Reuse count";
    case Buffer::failed:
        return "Failed shifts";
    }
    return "";
}

ColourMap colour_map(Buffer buffer) {
    switch (buffer) {
    case Buffer::reconstruction:
    case Buffer::primal:
        return ColourMap::radiance;
    case Buffer::dx:
    case Buffer::dy:
        return ColourMap::signed_difference;
    case Buffer::reused:
    case Buffer::failed:
        return ColourMap::false_colour;
    }
    return ColourMap::radiance;
}

std::string_view paper_name(Method method) {
    switch (method) {
    case Method::pt:
        return "PT";
    case Method::pr:
        return "PR";
    case Method::gpt:
        return "G-PT";
    case Method::gpr:
        return "G-PR";
    }
    return "";
}

namespace {

const RgbImage& primal_with_very_direct(const GradientImages& images, RgbImage& scratch) {
    if (images.very_direct.size() != images.primal.size())
        return images.primal;
    scratch = images.primal;
    for (std::size_t i = 0; i < scratch.size(); ++i)
        scratch.data()[i] += images.very_direct.data()[i];
    return scratch;
}

/// The least of the steps times a power of ten that is not below `value` > 0.
float rounded_up(float value) {
    const float power = std::pow(10.0f, std::floor(std::log10(value)));
    for (float step : {1.0f, 1.2f, 1.5f, 2.0f, 2.5f, 3.0f, 4.0f, 5.0f, 6.0f, 8.0f}) {
        if (step * power >= value)
            return step * power;
    }
    return 10 * power;
}

// Of this size: a first look's may still be there when the first whole pass is.
bool has_reconstruction(const Snapshot& snapshot) {
    if (!snapshot.images || !snapshot.reconstruction || !has_gradients(snapshot.settings.method))
        return false;
    const RgbImage& image = snapshot.reconstruction->image;
    const RgbImage& primal = snapshot.images->primal;
    return !image.empty() && image.width() == primal.width() && image.height() == primal.height();
}

} // namespace

std::shared_ptr<const void> picture_source(const Snapshot& snapshot, Buffer buffer) {
    if (buffer == Buffer::reconstruction && has_reconstruction(snapshot))
        return snapshot.reconstruction;
    if (colour_map(buffer) == ColourMap::false_colour)
        return snapshot.reuse;
    return snapshot.images;
}

const RgbImage& picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch) {
    static const RgbImage none;
    if (!picture_source(snapshot, buffer))
        return none;
    if (buffer == Buffer::reused)
        return scratch = grey(snapshot.reuse->reused);
    if (buffer == Buffer::failed)
        return scratch = grey(snapshot.reuse->failed);
    if (buffer == Buffer::dx)
        return snapshot.images->dx;
    if (buffer == Buffer::dy)
        return snapshot.images->dy;
    if (buffer == Buffer::reconstruction && has_reconstruction(snapshot))
        return snapshot.reconstruction->image;
    return primal_with_very_direct(*snapshot.images, scratch);
}

float top_value(Buffer buffer, const RgbImage& image) {
    if (buffer == Buffer::failed)
        return 1;
    float top = 0;
    for (const Rgb& pixel : image)
        top = std::max(top, pixel.r);
    return top > 0 ? rounded_up(top) : 1;
}

std::string legend_text(Buffer buffer, float top) {
    char text[64];
    if (buffer == Buffer::failed)
        std::snprintf(text, sizeof text, "failed: 0 .. %.4g %%", static_cast<double>(top) * 100);
    else
        std::snprintf(text, sizeof text, "reused: 0 .. %.4g paths a pass", static_cast<double>(top));
    return text;
}

} // namespace tessera
