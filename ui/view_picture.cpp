#include "ui/view_picture.h"

namespace tessera {

ScreenPixels view_picture(int pane, const CanvasShader& shader, const PaneImages& images,
                          const ViewerState& state) {
    const Showing showing = sides_of(state, pane).left;
    const PaneImage& image = images[static_cast<std::size_t>(showing.pane)];
    const auto is_missing = [&](int i) {
        const PaneImage& of = images[static_cast<std::size_t>(i)];
        return of.empty() || of.coarse();
    };
    if (is_missing(showing.pane) || (showing.subtrahend >= 0 && is_missing(showing.subtrahend)))
        return {};
    CanvasView view = colours_of(showing, state, images);
    view.pane_size = {image.pixels().width(), image.pixels().height()};
    view.image_extent = view.pane_size;
    Canvas canvas;
    const ShowingTextures textures = textures_of(showing, images);
    canvas.draw(shader, textures.image, view, textures.subtrahend);
    const DrawInto source(canvas.framebuffer());
    return read_screen(view.pane_size);
}

} // namespace tessera
