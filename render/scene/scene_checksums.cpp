#include "render/scene/scene_checksums.h"

#include "render/io/memory.h"
#include "render/scene/scene.h"

#include <cstdio>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/core.h>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// Checksums of bitmaps, cached because many textures share a bitmap.
using BitmapChecksums = std::map<const Bitmap*, std::uint32_t>;

/// Computes a checksum of values of any type. Structured bindings name all members of a struct, so that a new
/// member causes a compile error instead of being forgotten. Names of objects are excluded.
class SceneDigest {
public:
    /// `bitmaps` is the cache; it must outlive this object.
    explicit SceneDigest(BitmapChecksums& bitmaps) : bitmaps_(bitmaps) {}

    template <class... Values>
    SceneDigest& add(const Values&... values) {
        (take(values), ...);
        return *this;
    }
    std::uint32_t checksum() const { return sum_; }

private:
    template <class T>
    struct IsVector : std::false_type {};
    template <glm::length_t n, class T, glm::qualifier q>
    struct IsVector<glm::vec<n, T, q>> : std::true_type {};
    template <glm::length_t n, glm::length_t m, class T, glm::qualifier q>
    struct IsVector<glm::mat<n, m, T, q>> : std::true_type {};
    /// Whether the bytes of a value determine it: no padding and no pointers.
    template <class T>
    static constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || IsVector<T>::value;

    /// Adds a value only if it is not the default. A feature added to the program then leaves the checksums of
    /// scenes without it, and so the identity of stored references, unchanged.
    template <class T>
    void add_if(bool is_there, const T& value) {
        if (is_there)
            take(value);
    }

    template <class T>
        requires is_plain<T>
    void take(const T& value) {
        sum_ = tessera::checksum(std::as_bytes(std::span(&value, 1)), sum_);
    }
    template <class T, class Memory>
    void take(const std::vector<T, Memory>& values) {
        take(values.size());
        if constexpr (is_plain<T>)
            sum_ = tessera::checksum(std::as_bytes(std::span(values)), sum_);
        else
            for (const T& value : values)
                take(value);
    }
    template <class T>
    void take(const std::optional<T>& value) {
        take(value.has_value());
        if (value)
            take(*value);
    }
    template <class... T>
    void take(const std::variant<T...>& value) {
        take(value.index());
        std::visit([this](const auto& v) { this->take(v); }, value);
    }
    template <class T>
    void take(const std::shared_ptr<const T>& value) {
        take(value != nullptr);
        if (value)
            take(*value);
    }

    void take(const Mesh& mesh);
    void take(const Quadric& quadric);
    void take(const Bitmap& bitmap);
    void take(const BitmapTexture& texture);
    void take(const CheckerboardTexture& texture);
    void take(const AttributeTexture& texture);
    void take(const Texture& texture);
    void take(const Microfacets& facets);
    void take(const DiffuseMaterial& material);
    void take(const ConductorMaterial& material);
    void take(const DielectricMaterial& material);
    void take(const PlasticMaterial& material);
    void take(const PhongMaterial& material);
    void take(const MixtureMaterial& material);
    void take(const CoatedMaterial& material);
    void take(const PrincipledMaterial& material);
    void take(const ThinPrincipledMaterial& material);
    void take(const WardMaterial& material);
    void take(const DiffuseTransmitterMaterial& material);
    void take(const MediumLayerMaterial& material);
    void take(const Relief& relief);
    void take(const Material& material);
    void take(const AreaLight& light);
    void take(const Slide& slide);
    void take(const PointLight& light);
    void take(const DirectionalLight& light);
    void take(const EnvironmentMap& map);
    void take(const SunDisk& sun);
    void take(const EnvironmentDescription& environment);
    void take(const Camera& camera);

    BitmapChecksums& bitmaps_;
    std::uint32_t sum_ = 0;
};

void SceneDigest::take(const Mesh& mesh) {
    const auto& [positions, normals, uvs, attributes, triangles] = mesh;
    // Vertex colours have a fixed place and no name, so that checksums in stored references stay valid.
    const MeshAttribute* colors = mesh.attribute(vertex_color);
    add(positions, normals, uvs, colors ? colors->values : std::vector<glm::vec3>(), triangles);
    for (const auto& [name, values] : attributes)
        if (name != vertex_color)
            add(std::vector<char>(name.begin(), name.end()), values);
}

void SceneDigest::take(const Quadric& quadric) {
    add(quadric.kind(), quadric.to_world(), quadric.has_front_inside());
}

void SceneDigest::take(const AttributeTexture& texture) {
    if (texture.name != vertex_color)
        add(std::vector<char>(texture.name.begin(), texture.name.end()));
}

void SceneDigest::take(const Bitmap& bitmap) {
    const auto [known, is_new] = bitmaps_.emplace(&bitmap, 0);
    if (is_new) {
        const auto& [width, height, srgb, bytes, floats, mips] = bitmap;
        known->second = SceneDigest(bitmaps_).add(width, height, srgb, bytes, floats).checksum();
    }
    take(known->second);
}

void SceneDigest::take(const BitmapTexture& texture) {
    const auto& [bitmap, filter, wrap] = texture;
    add(bitmap, filter, wrap);
}

void SceneDigest::take(const CheckerboardTexture& texture) {
    const auto& [color0, color1] = texture;
    add(color0, color1);
}

void SceneDigest::take(const Texture& texture) {
    const auto& [kind, to_uv, scale] = texture;
    add(kind, to_uv, scale);
}

void SceneDigest::take(const Microfacets& facets) {
    const auto& [distribution, alpha, stretch] = facets;
    add(distribution, alpha);
    add_if(stretch != 1, stretch);
}

void SceneDigest::take(const DiffuseMaterial& material) {
    const auto& [reflectance, alpha, fast] = material;
    add(reflectance, alpha, fast);
}

void SceneDigest::take(const ConductorMaterial& material) {
    const auto& [distribution, alpha, eta, k, specular_reflectance, alpha_v] = material;
    add(distribution, alpha, eta, k, specular_reflectance);
    add_if(alpha_v.has_value(), alpha_v);
}

void SceneDigest::take(const DielectricMaterial& material) {
    const auto& [thin, eta, specular_reflectance, specular_transmittance, distribution, alpha, alpha_v] = material;
    add(thin, eta, specular_reflectance, specular_transmittance, distribution, alpha);
    add_if(alpha_v.has_value(), alpha_v);
}

void SceneDigest::take(const PlasticMaterial& material) {
    // The coating is a table computed from eta and facets.
    const auto& [eta, nonlinear, facets, coating, diffuse_reflectance, specular_reflectance, scatters_once] =
        material;
    add(eta, nonlinear, facets, diffuse_reflectance, specular_reflectance);
    add_if(scatters_once, scatters_once);
}

void SceneDigest::take(const PhongMaterial& material) {
    const auto& [exponent, diffuse_reflectance, specular_reflectance] = material;
    add(exponent, diffuse_reflectance, specular_reflectance);
}

void SceneDigest::take(const MixtureMaterial& material) {
    const auto& [parts, weights, blend_weight] = material;
    add(parts, weights, blend_weight);
}

void SceneDigest::take(const CoatedMaterial& material) {
    const auto& [eta, thickness, sigma_a, specular_reflectance, base] = material;
    add(eta, thickness, sigma_a, specular_reflectance, base);
}

void SceneDigest::take(const PrincipledMaterial& material) {
    const auto& [base_color, roughness, anisotropic, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness,
                 clearcoat, clearcoat_gloss, eta] = material;
    add(base_color, roughness, anisotropic, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness,
        clearcoat, clearcoat_gloss, eta);
}

void SceneDigest::take(const ThinPrincipledMaterial& material) {
    const auto& [base_color, roughness, anisotropic, spec_trans, eta, spec_tint, sheen, sheen_tint, flatness,
                 diff_trans] = material;
    add(base_color, roughness, anisotropic, spec_trans, eta, spec_tint, sheen, sheen_tint, flatness, diff_trans);
}

void SceneDigest::take(const WardMaterial& material) {
    const auto& [variant, alpha, alpha_v, diffuse_reflectance, specular_reflectance] = material;
    add(variant, alpha, alpha_v, diffuse_reflectance, specular_reflectance);
}

void SceneDigest::take(const DiffuseTransmitterMaterial& material) {
    const auto& [transmittance] = material;
    add(transmittance);
}

void SceneDigest::take(const MediumLayerMaterial& material) {
    const auto& [scattered, lost, by_share, thickness, g, is_clear] = material;
    add(scattered, lost, by_share, thickness, g, is_clear);
}

void SceneDigest::take(const Relief& relief) {
    const auto& [kind, map, scale, use_shadowing_function, is_mirrored_behind, turns_to_viewer] = relief;
    add(kind, map, scale, use_shadowing_function);
    add_if(is_mirrored_behind, is_mirrored_behind);
    add_if(turns_to_viewer, turns_to_viewer);
}

void SceneDigest::take(const Material& material) {
    const auto& [name, kind, two_sided, opacity, relief, back] = material;
    add(kind, two_sided, opacity, relief);
    if (back)
        take(*back);
}

void SceneDigest::take(const AreaLight& light) {
    const auto& [radiance] = light;
    add(radiance);
}

void SceneDigest::take(const Slide& slide) {
    const auto& [picture, camera, kind] = slide;
    add(picture, camera, kind);
}

void SceneDigest::take(const PointLight& light) {
    const auto& [position, intensity, axis, cutoff, beam_width, slide] = light;
    add(position, intensity, axis, cutoff, beam_width);
    if (slide) // as add_if()
        add(*slide);
}

void SceneDigest::take(const DirectionalLight& light) {
    const auto& [to_light, irradiance] = light;
    add(to_light, irradiance);
}

void SceneDigest::take(const EnvironmentMap& map) {
    const auto& [bitmap, scale, to_world] = map;
    add(bitmap, scale, to_world);
}

void SceneDigest::take(const SunDisk& sun) {
    const auto& [direction, radius, radiance] = sun;
    add(direction, radius, radiance);
}

void SceneDigest::take(const EnvironmentDescription& environment) {
    const auto& [map, sun] = environment;
    add(map, sun);
}

void SceneDigest::take(const Camera& camera) {
    const auto& [to_world, fov, fov_axis, is_orthographic, principal_offset, aperture_radius, focus_distance, crop,
                 filter] = camera; // the filter is a setting of a picture
    add(to_world, fov, fov_axis);
    // Default values are left out, as in add_if().
    if (is_orthographic)
        add(is_orthographic);
    if (principal_offset != glm::vec2(0))
        add(principal_offset);
    if (aperture_radius > 0)
        add(aperture_radius, focus_distance);
    if (!crop.empty())
        add(crop.film, crop.offset, crop.size);
}

} // namespace

SceneChecksums checksums_of(const SceneDescription& scene, const Camera& camera) {
    const auto& [shapes, groups, instances, materials, area_lights, point_lights, directional_lights, environment,
                 own_camera, size, max_depth, format, hides_emitters, sensors] = scene;
    BitmapChecksums bitmaps;
    std::vector<std::uint32_t> material_checksums;
    for (const Material& material : materials)
        material_checksums.push_back(SceneDigest(bitmaps).add(material).checksum());
    SceneDigest geometry(bitmaps), surfaces(bitmaps), lights(bitmaps);
    for_each_shape(scene, [&](const Shape& shape) {
        const auto& [name, mesh, material, area_light, quadric] = shape;
        geometry.add(mesh);
        if (quadric) // as add_if()
            geometry.add(*quadric);
        // The index itself would depend on unused materials.
        surfaces.add(material_checksums.at(static_cast<std::size_t>(material)));
        lights.add(area_light >= 0);
        if (area_light >= 0)
            lights.add(scene.area_lights.at(static_cast<std::size_t>(area_light)));
    });
    for (const auto& [name, group_shapes] : groups)
        geometry.add(group_shapes.size());
    for (const auto& [group, to_world] : instances)
        geometry.add(group, to_world);
    lights.add(point_lights, directional_lights, environment);
    if (hides_emitters)
        lights.add(hides_emitters);
    return {geometry.checksum(), surfaces.checksum(), lights.checksum(),
            SceneDigest(bitmaps).add(camera).checksum()};
}

std::string to_string(const SceneChecksums& sums) {
    return fmt::format("geometry {:08x} materials {:08x} lights {:08x} camera {:08x}", sums.geometry,
                       sums.materials, sums.lights, sums.camera);
}

std::optional<SceneChecksums> scene_checksums_from(const std::string& text) {
    SceneChecksums sums;
    if (std::sscanf(text.c_str(), "geometry %x materials %x lights %x camera %x", &sums.geometry, &sums.materials,
                    &sums.lights, &sums.camera) != 4)
        return {};
    return sums;
}

std::string difference(const SceneChecksums& a, const SceneChecksums& b) {
    std::vector<std::string> parts;
    for (const auto& [name, differs] :
         {std::pair("geometry", a.geometry != b.geometry), std::pair("materials", a.materials != b.materials),
          std::pair("lights", a.lights != b.lights), std::pair("camera", a.camera != b.camera)})
        if (differs)
            parts.emplace_back(name);
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    return text;
}

} // namespace tessera
