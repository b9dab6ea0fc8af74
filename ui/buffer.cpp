#include "ui/buffer.h"

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
    }
    return "";
}

ColourMap colour_map(Buffer buffer) {
    return buffer == Buffer::dx || buffer == Buffer::dy ? ColourMap::signed_difference : ColourMap::radiance;
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
    return snapshot.images;
}

const RgbImage& picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch) {
    static const RgbImage none;
    if (!snapshot.images)
        return none;
    if (buffer == Buffer::dx)
        return snapshot.images->dx;
    if (buffer == Buffer::dy)
        return snapshot.images->dy;
    if (buffer == Buffer::reconstruction && has_reconstruction(snapshot))
        return snapshot.reconstruction->image;
    return primal_with_very_direct(*snapshot.images, scratch);
}

} // namespace tessera
