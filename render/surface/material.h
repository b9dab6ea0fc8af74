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

/// Lambertian reflection, or the Oren-Nayar model for alpha > 0.
struct DiffuseMaterial {
    Texture reflectance{Rgb(0.5f)};
    Texture alpha{Rgb(0)}; ///< RMS slope of the grooves (luminance)
    bool fast = false;     ///< uses the qualitative Oren-Nayar model
};

/// A smooth or rough conductor. A positive alpha below smallest_alpha is raised to it.
struct ConductorMaterial {
    MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
    Texture alpha{Rgb(0)}; ///< roughness (luminance); 0: perfectly smooth
    Rgb eta{0};            ///< index of refraction relative to the outside; eta = 0, k = 1: perfect reflector
    Rgb k{1};              ///< extinction coefficient relative to the outside
    Texture specular_reflectance{Rgb(1)};
    std::optional<Texture> alpha_v{}; ///< roughness along v, while `alpha` is along u; empty: isotropic
};

/// A boundary between two dielectrics, or a thin pane.
struct DielectricMaterial {
    bool thin = false;               ///< a thin pane, always smooth
    float eta = 1.5046f / 1.000277f; ///< index of refraction inside over outside
    Texture specular_reflectance{Rgb(1)};
    Texture specular_transmittance{Rgb(1)};
    MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
    Texture alpha{Rgb(0)};            ///< roughness (luminance); 0: perfectly smooth
    std::optional<Texture> alpha_v{}; ///< as in ConductorMaterial
};

/// A diffuse base under a dielectric coating.
struct PlasticMaterial {
    float eta = 1.49f / 1.000277f;                           ///< index of refraction inside over outside
    bool nonlinear = false;                                  ///< the colour saturates with each internal bounce
    Microfacets facets{MicrofacetDistribution::beckmann, 0}; ///< of the coating; alpha = 0: smooth
    std::shared_ptr<const Coating> coating;                  ///< computed from eta and facets; not null
    Texture diffuse_reflectance{Rgb(0.5f)};
    Texture specular_reflectance{Rgb(1)};
    bool scatters_once = false; ///< no internal bounces, as Mitsuba 3's `pplastic`
};

/// The modified Phong model: a diffuse part and a lobe about the mirror direction.
struct PhongMaterial {
    Texture exponent{Rgb(30)}; ///< Phong exponent (luminance)
    Texture diffuse_reflectance{Rgb(0.5f)};
    Texture specular_reflectance{Rgb(0.2f)};
};

struct Material;

/// A weighted sum of materials. Their opacity, relief and two-sidedness are ignored.
struct MixtureMaterial {
    std::vector<std::shared_ptr<const Material>> parts; ///< transparent ones refract identically
    std::vector<float> weights{};                       ///< one per part; their sum is at most 1
    /// For two parts: the weight of the second (luminance); the first has the rest. Replaces `weights`.
    std::optional<Texture> blend_weight{};

    /// Returns the weight of parts[part] at a surface point.
    float weight(std::size_t part, const SurfacePoint& at) const;
};

/// A material under a smooth dielectric layer. The base's opacity, relief and two-sidedness are ignored.
struct CoatedMaterial {
    float eta = 1.5046f / 1.000277f; ///< index of refraction of the layer over the outside
    float thickness = 1;
    Texture sigma_a{Rgb(0)}; ///< absorption coefficient, per unit of thickness
    Texture specular_reflectance{Rgb(1)};
    std::shared_ptr<const Material> base; ///< opaque, not null
};

/// Disney's principled BSDF [Burley 2012, 2015]. All textures except the colour use their luminance, in [0, 1].
struct PrincipledMaterial {
    Texture base_color{Rgb(0.5f)};
    Texture roughness{Rgb(0.5f)}; ///< square root of the microfacet alpha
    Texture anisotropic{Rgb(0)};
    Texture metallic{Rgb(0)};
    Texture spec_trans{Rgb(0)}; ///< glass fraction of the non-metallic part
    Texture spec_tint{Rgb(0)};  ///< tint of the dielectric reflection toward the colour's hue
    Texture sheen{Rgb(0)};
    Texture sheen_tint{Rgb(0)};
    Texture flatness{Rgb(0)}; ///< blends the diffuse base toward subsurface scattering
    Texture clearcoat{Rgb(0)};
    Texture clearcoat_gloss{Rgb(0)};
    float eta = 1.5f; ///< index of refraction inside over outside; not 1 with spec_trans
};

/// Disney's principled BSDF for a sheet without thickness [Burley 2015].
struct ThinPrincipledMaterial {
    Texture base_color{Rgb(0.5f)};
    Texture roughness{Rgb(0.5f)};
    Texture anisotropic{Rgb(0)};
    Texture spec_trans{Rgb(0)};
    Texture eta{Rgb(1.5f)}; ///< index of refraction of the sheet over that around it
    Texture spec_tint{Rgb(0)};
    Texture sheen{Rgb(0)};
    Texture sheen_tint{Rgb(0)};
    Texture flatness{Rgb(0)};
    Texture diff_trans{Rgb(0)}; ///< in [0, 2]: twice the transmitted fraction of diffuse light
};

/// Ward's model: a diffuse part and an anisotropic glossy lobe.
struct WardMaterial {
    WardVariant variant = WardVariant::balanced;
    Texture alpha{Rgb(0.1f)};         ///< roughness (luminance)
    std::optional<Texture> alpha_v{}; ///< as in ConductorMaterial
    Texture diffuse_reflectance{Rgb(0.5f)};
    Texture specular_reflectance{Rgb(0.2f)};
};

/// Diffuse transmission, from both sides.
struct DiffuseTransmitterMaterial {
    Texture transmittance{Rgb(0.5f)};
};

/// A flat layer of a medium with single scattering, as Mitsuba 0.6's `hk`.
struct MediumLayerMaterial {
    Texture scattered{Rgb(0)}; ///< sigma_s; with by_share the albedo sigma_s / sigma_t
    Texture lost{Rgb(0)};      ///< sigma_a; with by_share sigma_t
    bool by_share = false;     ///< selects the second meaning of both
    float thickness = 1;
    float g = 0;          ///< mean cosine of the phase function, in (-1, 1)
    bool is_clear = true; ///< whether unscattered light is transmitted
};

/// A bump or normal map, which bends shading normals.
struct Relief {
    enum class Kind : std::uint8_t {
        bump,       ///< height above the surface (luminance), scene units
        normal_map, ///< normals in the frame of u, v and the normal, encoded as (n + 1) / 2
    };
    Kind kind = Kind::bump;
    Texture map;
    float scale = 1;                     ///< factor on the height of a bump map
    bool use_shadowing_function = false; ///< applies the shadowing of [Estevez 2019]
    /// The relief on the back of a two-sided material: the front's mirrored in the surface, as from Mitsuba's
    /// `twosided` around the relief; or the front's itself, seen from inside.
    bool is_mirrored_behind = false;
    bool turns_to_viewer = false; ///< Bsdf::turns_relief
};

/// The material of a surface, with its textures.
struct Material {
    std::string name;
    std::variant<DiffuseMaterial, ConductorMaterial, DielectricMaterial, PlasticMaterial, PhongMaterial,
                 MixtureMaterial, CoatedMaterial, PrincipledMaterial, ThinPrincipledMaterial, WardMaterial,
                 DiffuseTransmitterMaterial, MediumLayerMaterial>
        kind;
    bool two_sided = false; ///< shades the back like the front; otherwise the back of an opaque material is black
    std::optional<Texture> opacity{}; ///< probability that a ray hits the surface (luminance); empty: 1
    std::optional<Relief> relief{};
    std::shared_ptr<const Material> back{}; ///< of the back of a two-sided material, opaque; null: this one

    /// Returns the BSDF at a point. Some kinds of BSDF keep a pointer to this material.
    Bsdf resolve(const SurfacePoint& at) const;

    /// Returns all textures, including constant ones and those of nested materials; some may occur twice.
    std::vector<const Texture*> textures() const;

    /// Returns whether any texture is not constant.
    bool is_textured() const;

    /// Returns whether the BSDF is anisotropic, so that shading tangents must follow u.
    bool is_anisotropic() const;

    /// Returns whether the BSDF may be a mirror (Bsdf::is_mirror).
    bool may_be_mirror() const {
        return std::holds_alternative<ConductorMaterial>(kind) || (back && back->may_be_mirror());
    }

    /// Returns whether the opacity is not 1 everywhere.
    bool is_mask() const;

    /// Returns whether the BSDF transmits light; opacity is ignored.
    bool is_transparent() const;
};

} // namespace tessera
