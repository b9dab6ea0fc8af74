#include "render/io/files.h"
#include "render/load/plugins.h"
#include "render/load/shape_readers.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <tiny_obj_loader.h>

namespace tessera {

namespace fs = std::filesystem;

namespace {

/// Returns an existing file beside the OBJ file, with "\" taken for "/" if needed; empty: there is none.
std::optional<fs::path> find_beside(const fs::path& obj, std::string name) {
    std::error_code error;
    for (int i = 0; i < 2; ++i) {
        if (!name.empty() && fs::is_regular_file(obj.parent_path() / name, error))
            return obj.parent_path() / name;
        std::ranges::replace(name, '\\', '/');
    }
    return {};
}

class MtlReader {
public:
    MtlReader(LoadContext& context, const LoadContext::File& obj) : context_(context), obj_(obj) {}

    /// Reads the files that an `mtllib` names: one whose name may have spaces, or several.
    void read_library(const std::string& names) {
        if (const std::optional<fs::path> file = find_beside(obj_.path, names))
            return read_file(*file);
        std::istringstream words(names);
        for (std::string name; words >> name;) {
            if (const std::optional<fs::path> file = find_beside(obj_.path, name))
                read_file(*file);
            else
                note("there is no material library '" + name + "': its materials are grey");
        }
    }

    /// Adds a material to the scene, if a library has it. Returns its index.
    std::optional<int> add(const std::string& name) {
        const auto found = materials_.find(name);
        if (found == materials_.end())
            return {};
        const auto index = static_cast<int>(context_.scene.materials.size());
        context_.scene.materials.push_back(material_of(found->second));
        context_.scene.materials.back().name = name;
        return index;
    }

private:
    void note(const std::string& text) { context_.notes.push_back({obj_.parameter.position(), text}); }

    void report_error(const std::string& text, const std::string& consequence) {
        context_.notes.push_back(obj_.parameter.error(text, "value").note(consequence));
    }

    void read_file(const fs::path& file) {
        try {
            std::ifstream stream = open_file(file);
            std::map<std::string, int> places;
            std::vector<tinyobj::material_t> materials;
            std::string warning, error;
            tinyobj::LoadMtl(&places, &materials, &stream, &warning, &error);
            for (const tinyobj::material_t& material : materials)
                materials_.emplace(material.name, material);
        } catch (const std::exception& error) {
            report_error("cannot load '" + file.filename().string() + "': " + error.what(),
                         "its materials are grey");
        }
    }

    static float fraction(float value, float fallback = 0) {
        return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : fallback;
    }
    static Rgb color(const tinyobj::real_t (&rgb)[3]) {
        return {fraction(rgb[0]), fraction(rgb[1]), fraction(rgb[2])};
    }

    /// Returns the texture of an image file, or grey with an error note. `options`: scale and offset of uv.
    Texture image(const std::string& name, const tinyobj::texture_option_t& options, bool srgb,
                  BitmapChannel channel = BitmapChannel::all) {
        Texture texture(Rgb(0.5f));
        const std::optional<fs::path> file = find_beside(obj_.path, name);
        if (!file) {
            report_error("there is no file '" + name + "'", "grey is used instead");
            return texture;
        }
        texture.kind = BitmapTexture{bitmap_of_file(context_, {obj_.parameter, *file}, srgb, channel),
                                     Filter::bilinear, options.clamp ? Wrap::clamp : Wrap::repeat};
        texture.to_uv = {options.scale[0],         0, 0, 0, options.scale[1], 0, options.origin_offset[0],
                         options.origin_offset[1], 1};
        return texture;
    }

    void note_unused(const tinyobj::material_t& m) {
        std::string names;
        const auto add = [&](bool is_used, const char* name) {
            if (is_used)
                names += (names.empty() ? "" : ", ") + std::string(name);
        };
        const auto is_above_0 = [](const tinyobj::real_t(&rgb)[3]) { return rgb[0] + rgb[1] + rgb[2] > 0; };
        add(is_above_0(m.emission) || !m.emissive_texname.empty(), "emission");
        add(!m.specular_texname.empty(), "map_Ks");
        add(!m.specular_highlight_texname.empty(), "map_Ns");
        add(!m.bump_texname.empty(), "map_bump");
        add(!m.normal_texname.empty(), "norm");
        add(!m.displacement_texname.empty(), "disp");
        add(!m.reflection_texname.empty(), "refl");
        add(m.roughness > 0 || m.metallic > 0 || m.sheen > 0 || m.clearcoat_thickness > 0, "Pr, Pm, Ps and Pc");
        if (!names.empty())
            note("material '" + m.name + "' of the MTL file: not used: " + names);
    }

    static Material glass(const tinyobj::material_t& m) {
        DielectricMaterial dielectric;
        dielectric.eta = std::isfinite(m.ior) && m.ior > 1 ? m.ior : 1.5f;
        return {{}, dielectric};
    }

    static Material mirror(Rgb specular) {
        ConductorMaterial conductor;
        conductor.specular_reflectance = specular;
        return {{}, conductor, true};
    }

    Material material_of(const tinyobj::material_t& m) {
        note_unused(m);
        const Rgb specular = color(m.specular);
        if (m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9)
            return glass(m);
        Material material = m.illum == 5 || m.illum == 8 ? mirror(specular) : reflector(m, specular);
        if (!m.alpha_texname.empty())
            material.opacity = image(m.alpha_texname, m.alpha_texopt, false);
        else if (fraction(m.dissolve, 1) < 1)
            material.opacity = Texture(Rgb(fraction(m.dissolve, 1)));
        return material;
    }

    /// Returns a `phong` or `diffuse`. Reflectances that add up to more than 1 are scaled down to it.
    Material reflector(const tinyobj::material_t& m, Rgb specular) {
        const Texture diffuse = m.diffuse_texname.empty() ? Texture(color(m.diffuse))
                                                          : image(m.diffuse_texname, m.diffuse_texopt, true);
        if (m.illum < 2 || !(m.shininess > 0) || !std::isfinite(m.shininess) || specular == Rgb(0))
            return {{}, DiffuseMaterial{diffuse}, true};
        PhongMaterial phong;
        phong.exponent = Texture(Rgb(m.shininess));
        phong.diffuse_reflectance = diffuse;
        phong.specular_reflectance = specular;
        return {{}, phong, true};
    }

    LoadContext& context_;
    const LoadContext::File& obj_;
    std::map<std::string, tinyobj::material_t> materials_;
};

} // namespace

std::map<std::string, int> read_mtl_libraries(LoadContext& context, const ObjScan& scan,
                                              const LoadContext::File& obj) {
    MtlReader reader(context, obj);
    for (const std::string& library : scan.libraries)
        reader.read_library(library);
    std::map<std::string, int> result;
    for (const std::string& name : scan.materials)
        if (const std::optional<int> index = reader.add(name))
            result.emplace(name, *index);
    return result;
}

} // namespace tessera
