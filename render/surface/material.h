#pragma once

#include "render/surface/bsdf.h"
#include "render/surface/texture.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tessera {

/// Lambert's law, or with alpha > 0 the diffuse grooves of Oren and Nayar.
struct DiffuseMaterial {
    Texture reflectance{Rgb(0.5f)};
    Texture alpha{Rgb(0)}; ///< RMS slope of the grooves, the red channel counts
    bool fast = false;     ///< the qualitative model of the grooves
};

/// A conductor; alpha = 0 means a perfect mirror, any above at least what microfacet theory can hold in floats.
struct ConductorMaterial {
    MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
    Texture alpha{Rgb(0)}; ///< roughness, by its luminance; constant 0: perfectly smooth
    Rgb eta{0};            ///< index of refraction relative to the outside; eta = 0, k = 1: reflects all
    Rgb k{1};              ///< absorption, likewise
    Texture specular_reflectance{Rgb(1)};
    std::optional<Texture> alpha_v{}; ///< roughness along v, `alpha` being that along u; nothing: the same
};

/// A boundary between two dielectrics, or a thin pane.
struct DielectricMaterial {
    bool thin = false;               ///< always smooth
    float eta = 1.5046f / 1.000277f; ///< inside over outside
    Texture specular_reflectance{Rgb(1)};
    Texture specular_transmittance{Rgb(1)};
    MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
    Texture alpha{Rgb(0)};            ///< roughness, by its luminance; constant 0: perfectly smooth
    std::optional<Texture> alpha_v{}; ///< as above
};

/// A diffuse base under a dielectric coating.
struct PlasticMaterial {
    float eta = 1.49f / 1.000277f;                           ///< inside over outside
    bool nonlinear = false;                                  ///< the colour deepens with each bounce inside
    Microfacets facets{MicrofacetDistribution::beckmann, 0}; ///< of the coating; alpha = 0: smooth
    std::shared_ptr<const Coating> coating;                  ///< of these eta and facets; not null
    Texture diffuse_reflectance{Rgb(0.5f)};
    Texture specular_reflectance{Rgb(1)};
    bool scatters_once = false; ///< what the coating sends back to the base is lost
};

/// A diffuse part and a lobe about the mirror direction.
struct PhongMaterial {
    Texture exponent{Rgb(30)}; ///< by its luminance
    Texture diffuse_reflectance{Rgb(0.5f)};
    Texture specular_reflectance{Rgb(0.2f)};
};

struct Material;

/// A weighted sum of materials, whose opacity, relief and two-sidedness do not count.
struct MixtureMaterial {
    std::vector<std::shared_ptr<const Material>> parts; ///< transparent ones refract all alike
    std::vector<float> weights{};                       ///< one a part, at most 1 together
    /// With two parts: the weight of the second by its luminance, of the first what is left to 1; `weights` then
    /// do not count.
    std::optional<Texture> second_share{};

    float weight(std::size_t part, const SurfacePoint& at) const;
};

/// A material under a smooth dielectric layer. The base's opacity, relief and two-sidedness do not count.
struct CoatedMaterial {
    float eta = 1.5046f / 1.000277f; ///< index of the layer over that outside
    float thickness = 1;
    Texture sigma_a{Rgb(0)}; ///< absorption per unit of thickness
    Texture specular_reflectance{Rgb(1)};
    std::shared_ptr<const Material> base; ///< opaque, not null
};

/// Disney's principled BSDF [Burley 2012, 2015]. All but the colour count by their luminance, and are in [0, 1].
struct PrincipledMaterial {
    Texture base_color{Rgb(0.5f)};
    Texture roughness{Rgb(0.5f)}; ///< root of the facets' alpha
    Texture anisotropic{Rgb(0)};
    Texture metallic{Rgb(0)};
    Texture spec_trans{Rgb(0)}; ///< share of what is not metal that is glass
    Texture spec_tint{Rgb(0)};  ///< how far the dielectric's reflection has the colour's hue
    Texture sheen{Rgb(0)};
    Texture sheen_tint{Rgb(0)};
    Texture flatness{Rgb(0)}; ///< how far the diffuse base looks like a scattering medium
    Texture clearcoat{Rgb(0)};
    Texture clearcoat_gloss{Rgb(0)};
    float eta = 1.5f; ///< inside over outside; not 1 where there is spec_trans
};

/// The same of a sheet without thickness.
struct ThinPrincipledMaterial {
    Texture base_color{Rgb(0.5f)};
    Texture roughness{Rgb(0.5f)};
    Texture anisotropic{Rgb(0)};
    Texture spec_trans{Rgb(0)};
    Texture eta{Rgb(1.5f)}; ///< of the sheet over that around it
    Texture spec_tint{Rgb(0)};
    Texture sheen{Rgb(0)};
    Texture sheen_tint{Rgb(0)};
    Texture flatness{Rgb(0)};
    Texture diff_trans{Rgb(0)}; ///< in [0, 2]: twice the share of the diffuse light that goes through
};

/// A diffuse part and a lobe about the mirror direction, stretched by grazing angles and along one direction.
struct WardMaterial {
    WardVariant variant = WardVariant::balanced;
    Texture alpha{Rgb(0.1f)};         ///< by its luminance
    std::optional<Texture> alpha_v{}; ///< roughness along v, `alpha` being that along u; nothing: the same
    Texture diffuse_reflectance{Rgb(0.5f)};
    Texture specular_reflectance{Rgb(0.2f)};
};

/// Lets diffuse light through, from both sides.
struct DiffuseTransmitterMaterial {
    Texture transmittance{Rgb(0.5f)};
};

/// A flat layer of a medium that scatters light once.
struct MediumLayerMaterial {
    Texture scattered{Rgb(0)}; ///< sigma_s, or its share of sigma_t
    Texture lost{Rgb(0)};      ///< sigma_a, or sigma_t
    bool by_share = false;     ///< whether these are the second of both
    float thickness = 1;
    float g = 0;          ///< mean cosine of scattering, in (-1, 1)
    bool is_clear = true; ///< whether light that is not scattered goes on
};

/// What bends the normals of shading.
struct Relief {
    enum class Kind : std::uint8_t {
        bump,       ///< a height above the surface, in units of the scene; a matter of its luminance's gradient
        normal_map, ///< normals in the frame of u, v and the normal, coded as (n + 1) / 2
    };
    Kind kind = Kind::bump;
    Texture map;
    float scale = 1;                 ///< factor on the height
    bool softens_terminator = false; ///< light that is steep to the unbent normal is dimmed [Estevez 2019]
};

/// What a surface is made of, before textures are looked up.
struct Material {
    std::string name;
    std::variant<DiffuseMaterial, ConductorMaterial, DielectricMaterial, PlasticMaterial, PhongMaterial,
                 MixtureMaterial, CoatedMaterial, PrincipledMaterial, ThinPrincipledMaterial, WardMaterial,
                 DiffuseTransmitterMaterial, MediumLayerMaterial>
        kind;
    bool two_sided = false; ///< the back looks like the front; otherwise the back of an opaque material is black
    std::optional<Texture> opacity{}; ///< share of light that meets the surface at all (luminance); nothing: all
    std::optional<Relief> relief{};

    /// The BSDF there, as plain numbers; those of mixtures and coatings refer to this material.
    Bsdf resolve(const SurfacePoint& at) const;

    /// The textures it looks up, constant ones and those of nested materials among them.
    std::vector<const Texture*> textures() const;

    /// Whether uv or vertex colours matter.
    bool is_textured() const;

    /// Whether it matters how the frame of shading lies about the normal: its tangent then must be along u.
    bool is_anisotropic() const;

    /// Whether its BSDF may be a mirror (Bsdf::is_mirror).
    bool may_be_mirror() const { return std::holds_alternative<ConductorMaterial>(kind); }

    /// Whether it is there for one ray and not for another, by an opacity other than 1.
    bool is_mask() const;

    /// Whether light gets through (holes by its opacity do not count).
    bool is_transparent() const;
};

} // namespace tessera
