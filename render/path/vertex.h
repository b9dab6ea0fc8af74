#pragma once

#include "render/bsdf/bsdf.h"
#include "render/sampling.h"
#include "render/scene/light.h"

namespace tessera {

class Scene;
struct Hit;
struct Ray;

/// A point of a path on a surface, with everything that a scattering there needs: textures are looked up once.
struct Vertex {
    glm::vec3 position;
    glm::vec3 geometric_normal; ///< unit, of the triangle, on its front side
    Frame frame;                ///< of shading; on a two-sided material on the side of to_previous
    Bsdf bsdf;
    glm::vec3 to_previous;   ///< unit, in `frame`
    Rgb emitted{0};          ///< radiance given off on the front side; black: no light
    float emitter_pdf_a = 0; ///< density of emitter sampling here, per area; 0: no light

    glm::vec3 to_local(glm::vec3 world) const { return frame.to_local(world); }
    glm::vec3 to_world(glm::vec3 local) const { return frame.to_world(local); }

    /// The light of this vertex toward a unit direction (world, away from the surface); black from behind.
    LightPoint light_toward(glm::vec3 direction) const;
};

/// Makes `vertex` the one at `hit` on `ray`. (In place: a vertex is large, and paths are made of them.)
void make_vertex(const Scene& scene, const Hit& hit, const Ray& ray, Vertex& vertex);

} // namespace tessera
