#pragma once

#include "render/estimator/pass.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <memory>

namespace tessera::test {

/// The pixels that see several things, 1, as a render finds them before its first pass.
inline std::shared_ptr<const Image<std::uint8_t>> mixed_pixels(const Scene& scene, glm::ivec2 size,
                                                               const RenderSettings& settings) {
    const ReusePlan plan(size, settings);
    const Pass pass(scene, scene.camera(), size, settings, plan, 0);
    Worker worker(scene, scene.camera(), size, settings, nullptr);
    PixelLooks looks(size.x, size.y, true);
    for (const PixelRect& block : blocks_of(pass))
        take_first_looks(pass, block, worker, looks);
    return std::make_shared<const Image<std::uint8_t>>(looks.mixed());
}

} // namespace tessera::test
