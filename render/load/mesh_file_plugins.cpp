#include "render/io/files.h"
#include "render/load/plugins.h"
#include "render/load/shape_readers.h"
#include "render/mesh/obj_scan.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

namespace {

constexpr const char* left_out = "the shape is left out";

/// Reads the largest angle (degrees) between faces that share smooth normals; a parameter of Mitsuba 0.6.
std::optional<float> max_smooth_angle_parameter(Properties& p, bool face_normals) {
    if (!p.has("max_smooth_angle"))
        return {};
    const float angle = p.number("max_smooth_angle", 0);
    if (!(angle >= 0 && angle <= 180))
        p.take("max_smooth_angle")->fail("'max_smooth_angle' must be from 0 to 180 degrees", "value");
    if (face_normals)
        p.take("max_smooth_angle")->fail("'max_smooth_angle' and 'face_normals' exclude each other");
    return angle;
}

/// How a file's mesh becomes meshes of shapes.
struct FilePlacement {
    MeshPlacement placement;
    bool flip_v = false; ///< v = 1 at the first row of an image
};

/// Reads the parameters. `flip_v` is the format's default for flipping v, as image rows run from the top.
FilePlacement file_placement(Properties& p, bool flip_v) {
    FilePlacement result{placement_parameters(p), flip_v};
    result.placement.face_normals = p.boolean("face_normals", false);
    result.placement.max_smooth_angle = max_smooth_angle_parameter(p, result.placement.face_normals);
    result.flip_v = p.boolean("flip_tex_coords", flip_v);
    return result;
}

/// A mesh for shapes[index].
struct PlacedMesh {
    std::size_t index;
    Mesh mesh;
};

/// Adds a job that reads a mesh file. `split` distributes its mesh to shapes.
void add_mesh_job(LoadContext& context, const LoadContext::File& file, std::vector<Shape>& shapes,
                  const FilePlacement& how, std::function<MeshFile(const std::filesystem::path&)> read,
                  std::function<std::vector<PlacedMesh>(MeshFile&)> split) {
    context.meshes.push_back({file.parameter.position("value"), file.parameter.attribute("value"), {}});
    // The job refers to the vector and indexes it: it belongs to the context, and may grow.
    const auto run = [&shapes, &listing = context.meshes.back(), path = file.path, read = std::move(read),
                      split = std::move(split), how](const auto&) {
        try {
            MeshFile content = read(path);
            FilePlacement placed = how;
            placed.placement.face_normals = how.placement.face_normals || content.face_normals;
            for (PlacedMesh& part : split(content)) {
                if (placed.flip_v)
                    for (glm::vec2& uv : part.mesh.uvs)
                        uv.y = 1 - uv.y;
                const std::string error = place_mesh(part.mesh, placed.placement);
                if (!error.empty())
                    content.report.errors.push_back(error);
                shapes[part.index].mesh = std::move(part.mesh);
            }
            listing.report = content.report;
            return content.report;
        } catch (const std::exception& error) {
            listing.report.errors.emplace_back(error.what());
            throw;
        }
    };
    context.jobs.add(file.parameter, left_out, run);
}

/// Adds a job for a file with the mesh of one shape.
void read_mesh_file(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index,
                    std::function<MeshFile(const std::filesystem::path&)> read) {
    const std::optional<LoadContext::File> file = context.take_file(p, left_out);
    const FilePlacement placement = file_placement(p, false);
    const auto whole = [index](MeshFile& content) {
        std::vector<PlacedMesh> meshes;
        meshes.push_back({index, std::move(content.mesh)});
        return meshes;
    };
    if (file)
        add_mesh_job(context, *file, shapes, placement, std::move(read), whole);
}

int shape_index_parameter(Properties& p, int fallback) {
    const int number = p.integer("shape_index", fallback);
    if (number < fallback)
        p.take("shape_index")->fail("'shape_index' must not be negative", "value");
    return number;
}

/// Materials of an OBJ file's parts, as indices into scene.materials.
class ObjMaterials {
public:
    ObjMaterials(LoadContext& context, Properties& p, bool emits_light)
        : context_(context), emits_light_(emits_light) {
        const auto is_bsdf = [&](const XmlElement& element) { return context.resolve(element).tag() == "bsdf"; };
        for (const XmlElement& element : p.take_all(is_bsdf)) {
            const std::string name = element.attribute("name");
            if (!name.empty())
                named_.emplace_back(name, element);
            else if (!for_all_)
                for_all_ = element;
            else
                p.note(element, "only the first <bsdf> without a name in 'obj' is used");
        }
    }

    /// Returns whether the materials depend on names in the file.
    bool depends_on_file() const { return !for_all_ || !named_.empty(); }

    /// Returns the material of all parts, if they do not depend on the file.
    int for_all() const { return index_of(for_all_); }

    /// Returns the material of each name in the file. A <bsdf> whose name does not occur has a note; if it is the
    /// only one, it is for all parts.
    std::map<std::string, int> by_name(const ObjScan& scan, const LoadContext::File& file, const Properties& p) {
        const auto occurs = [&](const auto& named) { return std::ranges::count(scan.materials, named.first) > 0; };
        if (!for_all_ && named_.size() == 1 && !occurs(named_[0]))
            for_all_ = named_[0].second;
        else
            for (const auto& named : named_)
                if (!occurs(named))
                    p.note(named.second, "no face of the file has the material '" + named.first + "'");
        std::map<std::string, int> result;
        std::optional<std::map<std::string, int>> library;
        for (const std::string& name : scan.materials) {
            const auto given = std::ranges::find(named_, name, [](const auto& named) { return named.first; });
            if (given != named_.end()) {
                result[name] = index_of(given->second);
                continue;
            }
            if (!for_all_ && !emits_light_ && !library)
                library = read_mtl_libraries(context_, scan, file);
            const bool is_in_library = library && library->contains(name);
            result[name] = is_in_library ? library->at(name) : for_all();
        }
        return result;
    }

private:
    int index_of(const std::optional<XmlElement>& bsdf) const {
        return bsdf ? material_of(context_, context_.resolve(*bsdf)) : default_material(context_, emits_light_);
    }

    LoadContext& context_;
    bool emits_light_;
    std::optional<XmlElement> for_all_;
    std::vector<std::pair<std::string, XmlElement>> named_;
};

/// Scans an OBJ file for names. Returns nothing if it cannot be read, which the job that reads it reports.
ObjScan scan_file(const std::filesystem::path& path) {
    try {
        std::ifstream stream = open_file(path);
        ObjScan scan = scan_obj(stream);
        if (!scan.has_continuation)
            return scan;
        std::istringstream joined(join_lines(stream));
        return scan_obj(joined);
    } catch (const std::exception&) {
        return {};
    }
}

/// Chooses the parts of an OBJ file for each shape.
struct ObjSplit {
    std::map<std::string, std::size_t> shape_of; ///< index of a shape by the name of a material
    std::size_t other;                           ///< index of the shape of all other parts
    int wanted;                                  ///< the only part that is used; -1: all

    std::vector<PlacedMesh> operator()(MeshFile& content) const {
        if (wanted >= static_cast<int>(content.parts.size()))
            throw std::runtime_error("there is no part " + std::to_string(wanted) + ", only " +
                                     std::to_string(content.parts.size()));
        std::map<std::size_t, std::vector<const MeshPart*>> parts;
        for (std::size_t i = 0; i < content.parts.size(); ++i) {
            const auto shape = shape_of.find(content.parts[i].material);
            if (wanted < 0 || static_cast<std::size_t>(wanted) == i)
                parts[shape == shape_of.end() ? other : shape->second].push_back(&content.parts[i]);
        }
        std::vector<PlacedMesh> meshes;
        if (wanted < 0 && parts.size() <= 1)
            meshes.push_back({parts.empty() ? other : parts.begin()->first, std::move(content.mesh)});
        else
            for (const auto& [index, list] : parts)
                meshes.push_back({index, mesh_of_parts(content.mesh, list)});
        return meshes;
    }
};

} // namespace

void read_obj_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    p.ignore({"collapse"});
    const std::optional<LoadContext::File> file = context.take_file(p, left_out);
    const FilePlacement placement = file_placement(p, true);
    ObjSplit split{{}, index, shape_index_parameter(p, -1)};
    ObjMaterials materials(context, p, shapes[index].area_light >= 0);
    std::map<std::string, int> material_of_name;
    if (file && materials.depends_on_file())
        material_of_name = materials.by_name(scan_file(file->path), *file, p);
    if (material_of_name.empty()) {
        shapes[index].material = materials.for_all();
    } else {
        std::map<int, std::size_t> shape_of; // by material
        for (const auto& [name, material] : material_of_name) {
            const auto [place, is_new] = shape_of.emplace(material, shape_of.empty() ? index : shapes.size());
            if (is_new && place->second != index) {
                Shape copy = shapes[index];
                shapes.push_back(std::move(copy));
                context.shapes.push_back({&shapes, place->second, p.element()});
            }
            shapes[place->second].material = material;
            split.shape_of[name] = place->second;
        }
    }
    if (file)
        add_mesh_job(context, *file, shapes, placement, [](const auto& path) { return read_obj(path); }, split);
}

void read_ply_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    // Bytes are sRGB. Floats are linear in Mitsuba 3, and sRGB in 0.6. The parameter `srgb` overrides both.
    PlyColors colors;
    colors.srgb_floats = p.boolean("srgb", context.old_syntax);
    colors.srgb_bytes = p.boolean("srgb", true);
    read_mesh_file(context, p, shapes, index,
                   [colors](const std::filesystem::path& path) { return read_ply(path, colors); });
}

void read_serialized_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    const int number = shape_index_parameter(p, 0);
    read_mesh_file(context, p, shapes, index,
                   [number](const std::filesystem::path& path) { return read_serialized(path, number); });
}

} // namespace tessera
