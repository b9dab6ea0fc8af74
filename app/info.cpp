#include "app/info.h"

#include "app/exit_codes.h"
#include "app/load_notes.h"
#include "app/process_usage.h"
#include "render/scene/traits.h"

#include <map>
#include <set>

#include <fmt/core.h>

namespace tessera {

namespace {

std::string kind_of(const Material& m) {
    struct Namer {
        std::string operator()(const DiffuseMaterial&) const { return "diffuse"; }
        std::string operator()(const ConductorMaterial& c) const {
            return c.alpha.is_constant() && std::get<Rgb>(c.alpha.kind).r <= 0 ? "conductor" : "roughconductor";
        }
        std::string operator()(const DielectricMaterial& d) const {
            return d.thin ? "thindielectric" : "dielectric";
        }
        std::string operator()(const PlasticMaterial& p) const {
            return p.facets.alpha > 0 ? "roughplastic" : "plastic";
        }
    };
    return std::visit(Namer(), m.kind) + (m.two_sided ? ", two-sided" : "");
}

struct TextureSummary {
    std::size_t bitmaps = 0, procedural = 0;
    double bytes = 0;
};

TextureSummary summarise_textures(const Scene& scene) {
    TextureSummary sum;
    std::set<const Bitmap*> bitmaps;
    for (const Material& material : scene.materials())
        for (const Texture* texture : material.textures()) {
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
    for (const Shape& s : scene.shapes())
        bytes +=
            static_cast<double>(s.mesh.positions.size() * sizeof(glm::vec3) +
                                s.mesh.normals.size() * sizeof(glm::vec3) + s.mesh.uvs.size() * sizeof(glm::vec2) +
                                s.mesh.colors.size() * sizeof(Rgb) + s.mesh.triangles.size() * sizeof(glm::uvec3));
    return bytes;
}

void print_scene(const Scene& scene, const TextureSummary& textures) {
    std::map<std::string, int> materials;
    for (const Material& m : scene.materials())
        ++materials[kind_of(m)];
    fmt::print("shapes     {}\n", scene.shapes().size());
    fmt::print("triangles  {}\n", scene.triangle_count());
    fmt::print("materials  {}\n", scene.materials().size());
    for (const auto& [kind, count] : materials)
        fmt::print("           {} x {}\n", count, kind);
    fmt::print("textures   {} bitmaps, {} procedural\n", textures.bitmaps, textures.procedural);
    fmt::print("lights     {} x area, of {} triangles\n", scene.description().area_lights.size(),
               scene.lights().size());
    fmt::print("film       {}x{}\n", scene.size().x, scene.size().y);
    fmt::print("max depth  {}\n", scene.max_depth());
}

/// A line a trait: what the renderer must reckon with, and what costs nothing here.
void print_traits(const SceneTraits& traits) {
    const auto print = [](const char* name, int count, const char* of_what) {
        if (count > 0)
            fmt::print("  {:<16} {} {}{}\n", name, count, of_what, count == 1 ? "" : "s");
        else
            fmt::print("  {:<16} none\n", name);
    };
    fmt::print("traits (none: costs nothing)\n");
    print("delta lobes", traits.delta_lobes, "material");
    print("glossy below 0.1", traits.glossy_lobes, "material");
    print("transmission", traits.transmission, "material");
    print("textures", traits.textures, "material");
    print("vertex colours", traits.vertex_colors, "material");
    print("relief", traits.relief, "material");
    print("masks", traits.masks, "material");
    print("shading normals", traits.shading_normals, "shape");
    print("area lights", traits.area_lights, "shape");
    fmt::print("  {:<16} {}\n", "environment", traits.environment ? "yes" : "none");
}

void print_cost(const OpenedScene& opened, const TextureSummary& textures) {
    const Scene& scene = *opened.scene;
    fmt::print("seconds    {:.3f} XML, {:.3f} meshes and textures, {:.3f} BVH\n", opened.parse_seconds,
               opened.file_seconds, opened.bvh_seconds);
    fmt::print(
        "memory     {:.1f} MB meshes, {:.1f} MB textures, {:.1f} MB BVH and its triangles; at most {:.1f} MB in "
        "all\n",
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
    print_traits(traits_of(opened.scene->description()));
    const std::vector<std::string> notes = group_notes(opened.notes);
    fmt::print("{}\n", notes.empty() ? "nothing was ignored or replaced" : "ignored, replaced or approximated:");
    for (const std::string& note : notes)
        fmt::print("  {}\n", note);
    return exit_ok;
}

} // namespace tessera
