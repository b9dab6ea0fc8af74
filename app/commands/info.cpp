#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <variant>

#include <fmt/format.h>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

std::string kind_of(const Material& m) {
    struct Namer {
        static std::string rough(const Texture& alpha) {
            return alpha.is_constant() && std::get<Rgb>(alpha.kind).r <= 0 ? "" : "rough";
        }
        std::string operator()(const DiffuseMaterial& d) const { return rough(d.alpha) + "diffuse"; }
        std::string operator()(const ConductorMaterial& c) const { return rough(c.alpha) + "conductor"; }
        std::string operator()(const DielectricMaterial& d) const {
            return d.thin ? "thindielectric" : rough(d.alpha) + "dielectric";
        }
        std::string operator()(const PlasticMaterial& p) const {
            return p.facets.alpha > 0 ? "roughplastic" : "plastic";
        }
        std::string operator()(const PhongMaterial&) const { return "phong"; }
        std::string operator()(const PrincipledMaterial&) const { return "principled"; }
        std::string operator()(const ThinPrincipledMaterial&) const { return "principledthin"; }
        std::string operator()(const WardMaterial&) const { return "ward"; }
        std::string operator()(const DiffuseTransmitterMaterial&) const { return "difftrans"; }
        std::string operator()(const MediumLayerMaterial&) const { return "hk"; }
        std::string operator()(const MixtureMaterial& m) const {
            return m.blend_weight ? "blendbsdf" : "mixturebsdf";
        }
        std::string operator()(const CoatedMaterial& c) const { return "coating on " + kind_of(*c.base); }
    };
    std::string kind = std::visit(Namer(), m.kind);
    if (m.relief)
        kind += m.relief->kind == Relief::Kind::bump ? ", bumpmap" : ", normalmap";
    const std::string sides = m.back ? ", with " + kind_of(*m.back) + " behind" : m.two_sided ? ", two-sided" : "";
    return kind + (m.opacity ? ", mask" : "") + sides;
}

struct TextureSummary {
    std::size_t bitmaps = 0, procedural = 0;
    double bytes = 0;
};

TextureSummary summarise_textures(const Scene& scene) {
    TextureSummary sum;
    std::set<const Bitmap*> bitmaps;
    std::vector<const Texture*> all;
    for (const Material& material : scene.materials())
        for (const Texture* texture : material.textures())
            all.push_back(texture);
    for (const AreaLight& light : scene.description().area_lights)
        all.push_back(&light.radiance);
    if (const auto& map = scene.description().environment.map)
        bitmaps.insert(map->bitmap.get());
    for (const Texture* texture : all) {
        if (const auto* b = std::get_if<BitmapTexture>(&texture->kind))
            bitmaps.insert(b->bitmap.get());
        else if (!texture->is_constant())
            ++sum.procedural;
    }
    sum.bitmaps = bitmaps.size();
    for (const Bitmap* b : bitmaps)
        sum.bytes += static_cast<double>(b->bytes.size() + b->floats.size() * sizeof(Rgb));
    return sum;
}

double mesh_bytes(const Scene& scene) {
    double bytes = 0;
    for_each_shape(scene.description(), [&](const Shape& s) {
        bytes += static_cast<double>(
            s.mesh.positions.size() * sizeof(glm::vec3) + s.mesh.normals.size() * sizeof(glm::vec3) +
            s.mesh.uvs.size() * sizeof(glm::vec2) + s.mesh.triangles.size() * sizeof(glm::uvec3));
        bytes += s.quadric ? sizeof(Quadric) : 0;
        for (const MeshAttribute& attribute : s.mesh.attributes)
            bytes += static_cast<double>(attribute.values.size() * sizeof(glm::vec3));
    });
    return bytes;
}

/// Counts surfaces: "14 triangles", "1 quadric" or "14 triangles and 1 quadric".
std::string count_of(std::size_t triangles, std::size_t quadrics) {
    const std::string round = fmt::format("{} quadric{}", quadrics, quadrics == 1 ? "" : "s");
    if (triangles == 0 && quadrics > 0)
        return round;
    return fmt::format("{} triangles{}", triangles, quadrics > 0 ? " and " + round : "");
}

/// Describes the lights: "2 area (of 14 triangles), 1 spot, environment map of 512x256, sun".
std::string lights_of(const Scene& scene) {
    const SceneDescription& d = scene.description();
    std::size_t triangles = 0, quadrics = 0;
    for (const Shape& shape : d.shapes) {
        triangles += shape.area_light >= 0 ? shape.mesh.triangles.size() : 0;
        quadrics += shape.area_light >= 0 && shape.quadric;
    }
    const auto is_spot = [](const PointLight& light) { return light.cutoff < 180; };
    const auto is_projector = [&](const PointLight& light) { return light.slide && !is_spot(light); };
    const auto spots = std::count_if(d.point_lights.begin(), d.point_lights.end(), is_spot);
    const auto projectors = std::count_if(d.point_lights.begin(), d.point_lights.end(), is_projector);
    const auto points = static_cast<std::ptrdiff_t>(d.point_lights.size()) - spots - projectors;
    std::vector<std::string> parts;
    if (!d.area_lights.empty())
        parts.push_back(fmt::format("{} area (of {})", d.area_lights.size(), count_of(triangles, quadrics)));
    if (points > 0)
        parts.push_back(fmt::format("{} point", points));
    if (spots > 0)
        parts.push_back(fmt::format("{} spot", spots));
    if (projectors > 0)
        parts.push_back(fmt::format("{} projector", projectors));
    if (!d.directional_lights.empty())
        parts.push_back(fmt::format("{} directional", d.directional_lights.size()));
    if (const auto& map = d.environment.map)
        parts.push_back(map->bitmap->width * map->bitmap->height == 1
                            ? "constant environment"
                            : fmt::format("environment map of {}x{}", map->bitmap->width, map->bitmap->height));
    if (d.environment.sun)
        parts.emplace_back("sun");
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

void print_scene(const Scene& scene, const TextureSummary& textures) {
    std::map<std::string, int> materials;
    for (const Material& m : scene.materials())
        ++materials[kind_of(m)];
    fmt::print("shapes     {}\n", scene.shapes().size());
    fmt::print("triangles  {}\n", scene.triangle_count());
    if (scene.quadric_count() > 0)
        fmt::print("quadrics   {}\n", scene.quadric_count());
    if (const SceneDescription& d = scene.description(); !d.groups.empty())
        fmt::print("instances  {} of {} shape group{}\n", d.instances.size(), d.groups.size(),
                   d.groups.size() == 1 ? "" : "s");
    fmt::print("materials  {}\n", scene.materials().size());
    for (const auto& [kind, count] : materials)
        fmt::print("           {} x {}\n", count, kind);
    fmt::print("textures   {} bitmaps, {} procedural\n", textures.bitmaps, textures.procedural);
    fmt::print("lights     {}\n", lights_of(scene));
    fmt::print("film       {}x{}\n", scene.size().x, scene.size().y);
    if (const CropWindow& crop = scene.camera().crop; !crop.empty())
        fmt::print("crop       {} of {}x{}\n", text_of(crop), crop.film.x, crop.film.y);
    if (scene.description().sensors.size() > 1)
        fmt::print("sensors    {}\n", list_of(scene.description().sensors));
    fmt::print("max depth  {}\n", scene.max_depth());
}

/// Prints a line for each feature of the scene that affects rendering.
void print_traits(const SceneTraits& traits) {
    const auto print = [](const char* name, int count, const char* of_what) {
        if (count > 0)
            fmt::print("  {:<16} {} {}{}\n", name, count, of_what, count == 1 ? "" : "s");
        else
            fmt::print("  {:<16} none\n", name);
    };
    fmt::print("traits (none: not in this scene)\n");
    print("delta lobes", traits.delta_lobes, "material");
    print("glossy below 0.1", traits.glossy_lobes, "material");
    print("transmission", traits.transmission, "material");
    print("textures", traits.textures, "material");
    print("mesh attributes", traits.mesh_attributes, "material");
    print("relief", traits.relief, "material");
    print("masks", traits.masks, "material");
    print("shading normals", traits.shading_normals, "shape");
    print("instances", traits.instances, "instance");
    print("area lights", traits.area_lights, "shape");
    print("other lights", traits.point_lights, "light");
    fmt::print("  {:<16} {}\n", "environment", traits.environment ? "yes" : "none");
}

/// Prints what each mesh file has, what of it is not used, and what is damaged.
void print_meshes(const std::vector<MeshListing>& meshes) {
    if (!meshes.empty())
        fmt::print("mesh files\n");
    for (const MeshListing& mesh : meshes) {
        fmt::print("  {}: {}\n", mesh.file, fmt::join(mesh.report.contents, ", "));
        for (const std::string& ignored : mesh.report.ignored)
            fmt::print("    not used: {}\n", ignored);
        for (const std::string& error : mesh.report.errors)
            fmt::print("    error: {}\n", error);
    }
}

void print_cost(const OpenedScene& opened, const TextureSummary& textures) {
    const Scene& scene = *opened.scene;
    fmt::print("seconds    {:.3f} XML, {:.3f} meshes and textures, {:.3f} BVH\n", opened.parse_seconds,
               opened.file_seconds, opened.bvh_seconds);
    fmt::print(
        "memory     {:.1f} MB meshes, {:.1f} MB textures, {:.1f} MB BVH and its triangles; peak {:.1f} MB\n",
        mesh_bytes(scene) / 1e6, textures.bytes / 1e6, static_cast<double>(scene.intersector().bytes()) / 1e6,
        peak_memory_bytes() / 1e6);
}

} // namespace

int run_info(const SceneSource& source) {
    ThreadPool pool;
    const OpenedScene opened = open_scene(source, pool);
    const TextureSummary textures = summarise_textures(*opened.scene);
    fmt::print("{}\n", to_string(source));
    print_scene(*opened.scene, textures);
    print_cost(opened, textures);
    print_meshes(opened.meshes);
    print_traits(traits_of(opened.scene->description()));
    const SceneNotes notes = group_notes(opened.notes);
    fmt::print("{}\n", notes.empty() ? "nothing was ignored or replaced" : "ignored, replaced or approximated:");
    for (const SceneNote& note : notes)
        fmt::print("  {}{}\n", note.is_error ? "error: " : "", note.text);
    return exit_ok;
}

} // namespace tessera
