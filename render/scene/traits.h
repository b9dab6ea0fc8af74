#pragma once

#include "render/scene/scene.h"

namespace tessera {

/// What a scene contains, and so what a renderer must reckon with: whatever has a count of 0 needs no code and
/// costs nothing. Only materials that some shape is made of count. An upper bound: a texture is taken to reach all
/// its values.
struct SceneTraits {
    int delta_lobes = 0;      ///< materials with perfect reflection or refraction: no connection at them
    int glossy_lobes = 0;     ///< materials with microfacets of alpha below 0.1, but not perfectly smooth
    int transmission = 0;     ///< materials that let light through
    int textures = 0;         ///< materials that look up any texture
    int vertex_colors = 0;    ///< materials that look up the colours of vertices
    int relief = 0;           ///< materials with a bump or normal map
    int masks = 0;            ///< materials with an opacity other than 1
    int shading_normals = 0;  ///< shapes whose normals are interpolated
    int area_lights = 0;      ///< emitting shapes
    int point_lights = 0;     ///< lights without extent: points, spots, directions
    bool environment = false; ///< light from infinitely far away

    bool operator==(const SceneTraits&) const = default;
};

SceneTraits traits_of(const SceneDescription& scene);

} // namespace tessera
