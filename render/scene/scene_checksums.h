#pragma once

#include "render/io/memory.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

namespace tessera {

/// Checksums of bitmaps, which many textures share.
using BitmapChecksums = std::map<const Bitmap*, std::uint32_t>;

/// The checksum of values, whatever they are made of. Structs are taken apart by structured bindings, which name
/// all members: with one more, it no longer compiles, and so none is forgotten. Names of things do not count.
class SceneDigest {
public:
    /// `bitmaps` keeps what was found; it must live as long as this.
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
    /// Whether the bytes of a value are all that it is: it has no padding and no pointers.
    template <class T>
    static constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || IsVector<T>::value;

    template <class T>
    requires is_plain<T>
    void take(const T& value) { sum_ = tessera::checksum(std::as_bytes(std::span(&value, 1)), sum_); }
    template <class T>
    void take(const std::vector<T>& values) {
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
        std::visit([this](const auto& v) { take(v); }, value);
    }
    template <class T>
    void take(const std::shared_ptr<const T>& value) {
        take(value != nullptr);
        if (value)
            take(*value);
    }

    void take(const Mesh& mesh);
    void take(const Bitmap& bitmap);
    void take(const BitmapTexture& texture);
    void take(const CheckerboardTexture& texture);
    void take(const VertexColorTexture&) {}
    void take(const Texture& texture);
    void take(const Microfacets& facets);
    void take(const DiffuseMaterial& material);
    void take(const ConductorMaterial& material);
    void take(const DielectricMaterial& material);
    void take(const PlasticMaterial& material);
    void take(const PhongMaterial& material);
    void take(const MixtureMaterial& material);
    void take(const CoatedMaterial& material);
    void take(const Relief& relief);
    void take(const Material& material);
    void take(const AreaLight& light);
    void take(const PointLight& light);
    void take(const DirectionalLight& light);
    void take(const EnvironmentMap& map);
    void take(const SunDisk& sun);
    void take(const EnvironmentDescription& environment);
    void take(const Camera& camera);

    BitmapChecksums& bitmaps_;
    std::uint32_t sum_ = 0;
};

/// Checksums of all that a picture shows, part by part: two scenes that are alike have the same ones, whatever
/// their files and ids are called and wherever they lie. They are taken of what was loaded, bit by bit, and know
/// nothing of how it is rendered, nor of the size of the film.
struct SceneChecksums {
    std::uint32_t geometry = 0;
    std::uint32_t materials = 0; ///< shape by shape, textures and all
    std::uint32_t lights = 0;    ///< emission of shapes, lights without shape, environment
    std::uint32_t camera = 0;

    bool operator==(const SceneChecksums&) const = default;
};

SceneChecksums checksums_of(const SceneDescription& scene, const Camera& camera);

/// A text for headers and keys: "geometry 8c1f00d2 materials 00000000 lights 00000000 camera 00000000".
std::string to_string(const SceneChecksums& sums);
/// What such a text says; empty: it is none.
std::optional<SceneChecksums> scene_checksums_from(const std::string& text);

/// The parts in which the two differ: "geometry", "materials and camera"; empty: they do not.
std::string difference(const SceneChecksums& a, const SceneChecksums& b);

} // namespace tessera
