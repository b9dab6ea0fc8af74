#pragma once

#include "render/paths/base_path.h"
#include "render/paths/offsets.h"
#include "render/settings/settings.h"

#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

// Lossless Basis Expansion [Fang 2024] with tiles and antialiasing, theory (30) and (31).
//
// x_1 of a pixel with albedo a scatters light from direction w by g(w) = f cos / a, so the coefficient of the
// pixel is e = integral of g h, with arriving radiance h. All pixels use the same functions b^l(w). g is the sum
// of s^l b^l and of a residual r, which is distributed over the functions [Fang 2024, eq. 17 with n = 2]:
//     b_m^l = b^l + w^l r ,   w^l = s^l / sum of (s^k)^2
// So g = sum of s^l b_m^l and e = sum of s^l e^l hold for any numbers s^l, for each path. The components
//     e^l = integral of b_m^l h = w^l e + B^l - w^l sum of s^k B^k ,   B^l = integral of b^l h
// are smooth even where normals and roughnesses are not. Beside its radiance, a base path contributes only to
// B^l: the light that arrives at x_1, before it is scattered (ArrivingLight).

inline constexpr int max_components = 16;

/// Returns the number of functions b^l of a basis; 0: it has no components.
int component_count(Basis basis);
/// Returns the number of basis components of a render.
inline int component_count(const RenderSettings& s) {
    return is_expanded(s) ? component_count(s.basis) : 0;
}

/// Evaluates the component_count() functions b^l in a unit direction (world). They are orthogonal and have the
/// same length. With this length, the projection of a diffuse surface has a length of about 1, so a misfit of
/// components weighs as much as a misfit of e in the reconstruction.
void evaluate_basis(Basis basis, glm::vec3 direction, float* values);

/// Sets `s` to the projection, of length 1, of a surface that scatters light equally from all directions.
void project_evenly(Basis basis, float* s);

/// Adds to `sums` the projection s^l of a vertex that a camera ray hits: the luminance of the integral of b^l g,
/// over the squared length of b^l. It is estimated with `directions` samples of the BSDF, from the same numbers
/// for all vertices. Light by delta scatters counts as if it arrived equally from all directions.
void project(const Vertex& x, Basis basis, int directions, float* sums);

/// Sums of B^l for the pixels of a sampling set, one lane for each pixel.
///
/// A light path with c_m adds b^l(w) c_m / max(f cos, g_0 a), with g_0 = 0.3 / pi. Without g_0 the variance is
/// unbounded where g goes to 0, at the horizon and beside lobes, because BSDF sampling has a pdf like g. This
/// scales b^l down there, and the residual makes up for it, so the expansion stays lossless. Delta scatters add
/// nothing; all of their light is in the residual.
class ArrivingLight {
public:
    /// Sets all sums to 0, for pixels with these albedos. Keeps nothing if the basis has no components.
    void reset(Basis basis, std::span<const Rgb> albedos);

    int components() const { return components_; }
    bool is_kept() const { return components_ > 0; }

    /// Adds light paths in all lanes.
    /// @param scatter  at y_1 of each lane
    /// @param carried  weighted sum of c_m over the light paths through this scatter
    void add(const FirstScatter& scatter, const Vec3Lanes& carried);
    /// Adds light paths in one lane.
    void add(int lane, glm::vec3 direction, Rgb f_cos, Rgb carried);

    /// Computes the components e^l of pixel m, theory (31).
    /// @param coefficient  e, the radiance over the albedo
    /// @param projection   s^l
    /// @param parts        receives parts() components
    void expand(int m, Rgb coefficient, const float* projection, Rgb* components) const;

private:
    void add_eight(int first, const FirstScatter& scatter, const Vec3Lanes& carried);
    const Vec3Lanes& component(int l) const { return *light_[l]; }
    Vec3Lanes& component(int l) { return *light_[l]; }

    Basis basis_ = Basis::none;
    int components_ = 0, count_ = 0;
    Vec3Lanes least_f_cos_;
    std::vector<std::unique_ptr<Vec3Lanes>> light_; // never shrinks
};

} // namespace tessera
