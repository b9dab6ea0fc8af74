#include "render/load/shape_plugins.h"

#include "render/load/bsdf_plugins.h"
#include "render/load/builtin_shapes.h"
#include "render/load/emitter_plugins.h"
#include "render/load/mesh_files.h"
#include "render/load/mesh_tools.h"
#include "render/load/plugin_table.h"

namespace tessera {

namespace {

MeshPlacement placement_parameters(Properties& p) {
    MeshPlacement placement;
    placement.to_world = p.transform("to_world");
    placement.flip_normals = p.boolean("flip_normals", false);
    return placement;
}

void read_flat_shape(Properties& p, Shape& shape, Mesh mesh) {
    place_flat_mesh(mesh, placement_parameters(p));
    shape.mesh = std::move(mesh);
}

void read_rectangle(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    read_flat_shape(p, shapes[index], make_rectangle());
}

void read_cube(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    p.ignore({"face_normals"}); // it has no others
    read_flat_shape(p, shapes[index], make_cube());
}

/// A mesh in a file. `flip_v` is the format's default: images begin with the top row.
void read_mesh_file(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index,
                    Mesh (*read)(const std::filesystem::path&), bool flip_v) {
    const LoadContext::File file = context.take_file(p);
    MeshPlacement placement = placement_parameters(p);
    placement.face_normals = p.boolean("face_normals", false);
    flip_v = p.boolean("flip_tex_coords", flip_v);
    // The vector may still grow, but not move: it belongs to the context.
    context.jobs.add(file.parameter, [&shapes, index, path = file.path, read, placement, flip_v] {
        Mesh mesh = read(path);
        if (flip_v)
            for (glm::vec2& uv : mesh.uvs)
                uv.y = 1 - uv.y;
        const std::string note = place_mesh(mesh, placement);
        shapes[index].mesh = std::move(mesh);
        return note;
    });
}

void read_obj_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    p.ignore({"collapse"});
    read_mesh_file(context, p, shapes, index, read_obj, true);
}

void read_ply_shape(LoadContext& context, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    p.ignore({"srgb"});
    read_mesh_file(context, p, shapes, index, read_ply, false);
}

// A plugin adds its row here; it fills shapes[index].mesh, now or in a job.
constexpr Plugin<void (*)(LoadContext&, Properties&, std::vector<Shape>&, std::size_t)> plugins[] = {
    {"rectangle", read_rectangle},
    {"cube", read_cube},
    {"obj", read_obj_shape},
    {"ply", read_ply_shape},
};

int material_parameter(LoadContext& context, Properties& p, bool gives_light) {
    const std::vector<XmlElement> bsdfs = context.take_nested(p, "bsdf");
    if (bsdfs.size() > 1)
        p.note(bsdfs[1], "only the first <bsdf> of a shape is used");
    return bsdfs.empty() ? default_material(context, gives_light) : material_of(context, bsdfs[0]);
}

int area_light_parameter(LoadContext& context, Properties& p) {
    const std::vector<XmlElement> emitters = context.take_nested(p, "emitter");
    if (emitters.size() > 1)
        p.note(emitters[1], "only the first <emitter> of a shape is used");
    return emitters.empty() ? -1 : add_shape_emitter(context, emitters[0]);
}

} // namespace

void add_shape(LoadContext& context, const XmlElement& element) {
    Properties properties(element, context.notes);
    const auto* plugin = find_plugin(plugins, properties.type());
    if (!plugin) {
        properties.note("the shape '" + properties.type() + "' is not known and left out");
        return;
    }
    std::vector<Shape>& shapes = context.scene.shapes;
    Shape shape;
    shape.name = properties.name();
    shape.area_light = area_light_parameter(context, properties);
    shape.material = material_parameter(context, properties, shape.area_light >= 0);
    shapes.push_back(std::move(shape));
    plugin->read(context, properties, shapes, shapes.size() - 1);
    properties.report_unused();
}

} // namespace tessera
