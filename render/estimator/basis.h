#pragma once

#include "render/paths/base_path.h"
#include "render/paths/offsets.h"
#include "render/settings/settings.h"

#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

// Lossless Basis Expansion [Fang 2024], in tiles and with antialiasing (METHODS.md, The basis: parts of light).
//
// Where a pixel's x_1 scatters light that arrives along w by g(w) = f cos / a, a its albedo, what the pixel gets
// is e = integral of g h, with h the light from there. In functions b^l(w) that all pixels have in common, g is
// the sum of s^l b^l and a residual r = g - sum s^l b^l. The residual is dealt out over them [Fang 2024, eq. 17, n
// = 2],
//     b_m^l = b^l + w^l r ,   w^l = s^l / sum of (s^k)^2 ,
// so that g is the sum of s^l b_m^l whatever numbers s^l are, and e that of s^l e^l, path by path. The parts
//     e^l = integral of b_m^l h = w^l e + B^l - w^l sum of s^k B^k ,   B^l = integral of b^l h ,
// are smooth where normals and roughnesses are not. So all that a base path has to bring beside its radiance is
// B^l, the light that arrives, before it is scattered, in each of the functions: ArrivingLight.

inline constexpr int most_parts = 16;

/// How many functions b^l the basis has; 0: it expands nothing.
int part_count(Basis basis);
/// How many parts the light of a render is measured in.
inline int part_count(const RenderSettings& s) {
    return is_expanded(s) ? part_count(s.basis) : 0;
}

/// The functions b^l in a unit direction (world), part_count() of them: orthogonal, and of one length. By that
/// length the projection of a diffuse surface has a length of about 1, so that misfits of parts weigh as those of
/// e do in the reconstruction.
void evaluate_basis(Basis basis, glm::vec3 direction, float* values);

/// s^l of length 1 for what scatters light from everywhere alike.
void project_evenly(Basis basis, float* s);

/// Adds to `sums` the s^l of a vertex that a camera ray has met, the integrals of b^l g over the square of b^l's
/// length, as luminances, from `directions` samples of its BSDF, which are alike for all vertices. What is
/// scattered by delta parts counts as if it arrived from everywhere.
void project(const Vertex& x, Basis basis, int directions, float* sums);

/// B^l of the pixels of a sampling set, a lane a pixel.
///
/// A light path of value c brings b^l(w) c / (f cos). As BSDF sampling has g for its density, that would have a
/// variance without bound where g goes to 0, at the horizon and beside lobes. So it brings
/// b^l(w) c / max(f cos, least a): as if b^l were smaller there, which the residual makes up for. Delta scatters
/// bring nothing: all of theirs is residual.
class ArrivingLight {
public:
    /// For so many pixels, of which none has got anything. No functions: nothing is kept.
    void reset(Basis basis, std::span<const Rgb> albedos);

    int parts() const { return parts_; }
    bool is_kept() const { return parts_ > 0; }

    /// @param scatter  at y_1 of each lane
    /// @param carried  values c of light paths that go through it, times their weights
    void add(const FirstScatter& scatter, const Vec3Lanes& carried);
    /// The same in one lane.
    void add(int lane, glm::vec3 direction, Rgb f_cos, Rgb carried);

    /// The parts e^l of what pixel m got.
    /// @param coefficient  e: all that it got, over its albedo
    /// @param projection   s^l
    /// @param parts        receives as many
    void expand(int m, Rgb coefficient, const float* projection, Rgb* parts) const;

private:
    void add_eight(int first, const FirstScatter& scatter, const Vec3Lanes& carried);
    const Vec3Lanes& part(int l) const { return *light_[l]; }
    Vec3Lanes& part(int l) { return *light_[l]; }

    Basis basis_ = Basis::none;
    int parts_ = 0, count_ = 0;
    Vec3Lanes least_f_cos_;
    std::vector<std::unique_ptr<Vec3Lanes>> light_; // never shrinks
};

} // namespace tessera
