#include "ui/view_picture.h"

namespace tessera {

ScreenPixels view_picture(int pane, const CanvasShader& shader, const PaneImages& images,
                          const ViewerState& state) {
    const Showing showing = sides_of(state, pane).left;
    const PaneImage& image = images[static_cast<std::size_t>(showing.pane)];
    const PaneImage* subtrahend =
        showing.subtrahend < 0 ? nullptr : &images[static_cast<std::size_t>(showing.subtrahend)];
    const auto is_missing = [](const PaneImage& i) { return i.empty() || i.coarse(); };
    if (is_missing(image) || (subtrahend && is_missing(*subtrahend)))
        return {};
    CanvasView view = colours_of(showing, state, images);
    view.pane_size = {image.pixels().width(), image.pixels().height()};
    view.image_extent = view.pane_size;
    Canvas canvas;
    canvas.draw(shader, image.texture(), view, subtrahend ? &subtrahend->texture() : nullptr);
    const DrawInto source(canvas.framebuffer());
    return read_screen(view.pane_size);
}

} // namespace tessera
