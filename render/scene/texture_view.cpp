#include "render/scene/texture_view.h"

namespace tessera {

TextureView::TextureView(TextureFilter filter, bool spares_first, const Camera& camera, glm::ivec2 size)
    : filter_(filter), is_parallel_(camera.is_orthographic), spares_first_(spares_first) {
    const Projection projection(camera, size);
    const Ray middle = projection.ray(glm::vec2(size) * 0.5f);
    eye_ = middle.origin;
    forward_ = middle.direction;
    width_ = projection.pixel_width();
}

} // namespace tessera
