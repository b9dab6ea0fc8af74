#include "app/info.h"

#include "app/exit_codes.h"

#include <map>
#include <set>

#include <fmt/core.h>

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
        std::string operator()(const MixtureMaterial& m) const {
            return m.second_share ? "blendbsdf" : "mixturebsdf";
        }
        std::string operator()(const CoatedMaterial& c) const { return "coating on " + kind_of(*c.base); }
    };
    std::string kind = std::visit(Namer(), m.kind);
    if (m.relief)
        kind += m.relief->kind == Relief::Kind::bump ? ", bumpmap" : ", normalmap";
    return kind + (m.opacity ? ", mask" : "") + (m.two_sided ? ", two-sided" : "");
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
        bytes += static_cast<double>(
            s.mesh.positions.size() * sizeof(glm::vec3) + s.mesh.normals.size() * sizeof(glm::vec3) +
            s.mesh.uvs.size() * sizeof(glm::vec2) + s.mesh.triangles.size() * sizeof(glm::uvec3));
    return bytes;
}

void print_scene(const Scene& scene) {
    std::map<std::string, int> materials;
    for (const Material& m : scene.materials())
        ++materials[kind_of(m)];
    const TextureSummary textures = summarise_textures(scene);
    fmt::print("shapes     {}\n", scene.shapes().size());
    fmt::print("triangles  {} ({:.1f} MB)\n", scene.triangle_count(), mesh_bytes(scene) / 1e6);
    fmt::print("materials  {}\n", scene.materials().size());
    for (const auto& [kind, count] : materials)
        fmt::print("           {} x {}\n", count, kind);
    fmt::print("textures   {} bitmaps ({:.1f} MB), {} procedural\n", textures.bitmaps, textures.bytes / 1e6,
               textures.procedural);
    fmt::print("lights     {} area, of {} triangles\n", scene.description().area_lights.size(),
               scene.lights().size());
    fmt::print("film       {}x{}\n", scene.size().x, scene.size().y);
    fmt::print("max depth  {}\n", scene.max_depth());
}

} // namespace

int run_info(const SceneSource& source) {
    ThreadPool pool;
    const OpenedScene opened = open_scene(source, pool);
    fmt::print("{}\n", to_string(source));
    print_scene(*opened.scene);
    fmt::print("seconds    {:.3f} XML, {:.3f} meshes and textures, {:.3f} BVH\n", opened.parse_seconds,
               opened.file_seconds, opened.bvh_seconds);
    if (opened.notes.empty())
        fmt::print("nothing was ignored or replaced\n");
    else
        fmt::print("ignored, replaced or approximated:\n");
    for (const LoadNote& note : opened.notes)
        fmt::print("  {}: {}\n", note.where.to_string(), note.text);
    return exit_ok;
}

} // namespace tessera
