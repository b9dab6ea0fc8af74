#include "render/load/plugins.h"
#include "render/load/shape_readers.h"
#include "render/mesh/meshes.h"
#include "render/sampling/sampling.h"

#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace tessera {

MeshPlacement placement_parameters(Properties& p) {
    MeshPlacement placement;
    placement.to_world = p.transform("to_world");
    placement.flip_normals = p.boolean("flip_normals", false);
    return placement;
}

namespace {

/// Places a generated mesh. Errors point at the shape, as there is no file.
void read_flat_shape(Properties& p, Shape& shape, Mesh mesh) {
    const MeshPlacement placement = placement_parameters(p);
    try {
        place_flat_mesh(mesh, placement);
    } catch (const std::runtime_error& e) {
        p.element().fail(e.what());
    }
    shape.mesh = std::move(mesh);
}

void read_rectangle(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    read_flat_shape(p, shapes[index], make_rectangle());
}

void read_cube(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    p.ignore({"face_normals"}); // a cube always has face normals
    read_flat_shape(p, shapes[index], make_cube());
}

float radius_parameter(Properties& p) {
    const float radius = p.number("radius", 1);
    if (!(radius > 0))
        p.take("radius")->fail("the radius must be above 0", "value");
    return radius;
}

/// `to_shape` maps the unit shape to the shape's parameters, and is applied before to_world.
void read_quadric(Properties& p, Shape& shape, Quadric::Kind kind, const glm::mat4& to_shape = glm::mat4(1.0f)) {
    const MeshPlacement placement = placement_parameters(p);
    try {
        shape.quadric.emplace(kind, placement.to_world * to_shape, placement.flip_normals);
    } catch (const std::runtime_error& e) {
        p.element().fail(e.what());
    }
}

void read_sphere(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    const glm::mat4 to_center = glm::translate(glm::mat4(1.0f), p.point("center", glm::vec3(0)));
    read_quadric(p, shapes[index], Quadric::Kind::sphere, glm::scale(to_center, glm::vec3(radius_parameter(p))));
}

void read_disk(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    read_quadric(p, shapes[index], Quadric::Kind::disk);
}

void read_cylinder(LoadContext&, Properties& p, std::vector<Shape>& shapes, std::size_t index) {
    const glm::vec3 p0 = p.point("p0", {0, 0, 0});
    const glm::vec3 axis = p.point("p1", {0, 0, 1}) - p0;
    const float radius = radius_parameter(p);
    const float length = glm::length(axis);
    if (!(length > 0))
        p.element().fail("p0 and p1 of a cylinder are the same point");
    const Frame frame(axis / length);
    const glm::mat4 to_shape(glm::vec4(radius * frame.tangent, 0), glm::vec4(radius * frame.bitangent, 0),
                             glm::vec4(axis, 0), glm::vec4(p0, 1));
    read_quadric(p, shapes[index], Quadric::Kind::cylinder, to_shape);
}

// A new plugin adds its row here. The reader fills mesh or quadric of shapes[index], at once or in a job.
constexpr Plugin<void (*)(LoadContext&, Properties&, std::vector<Shape>&, std::size_t)> plugins[] = {
    {"rectangle", read_rectangle}, {"cube", read_cube},
    {"disk", read_disk},           {"sphere", read_sphere},
    {"cylinder", read_cylinder},   {"obj", read_obj_shape},
    {"ply", read_ply_shape},       {"serialized", read_serialized_shape},
};

int material_parameter(LoadContext& context, Properties& p, bool emits_light) {
    if (p.type() == "obj") { // read_obj_shape() sets the material, because there may be several BSDFs
        for (const XmlElement& child : p.element().children())
            if (const XmlElement nested = context.resolve(child); nested.tag() == "bsdf")
                read_bsdf(context, nested);
        return 0;
    }
    const std::optional<XmlElement> bsdf = context.take_one_nested(p, "bsdf");
    return bsdf ? material_of(context, *bsdf) : default_material(context, emits_light);
}

int area_light_parameter(LoadContext& context, Properties& p) {
    const std::optional<XmlElement> emitter = context.take_one_nested(p, "emitter");
    return emitter ? add_shape_emitter(context, *emitter) : -1;
}

/// Adds a shape with a surface to `shapes`. The vector must stay at its address until all files are read. A shape
/// of an unknown type or with an invalid parameter is left out, with an error note.
void add_mesh_shape(LoadContext& context, Properties& properties, std::vector<Shape>& shapes) {
    Shape shape;
    shape.name = properties.name();
    shape.area_light = area_light_parameter(context, properties);
    shape.material = material_parameter(context, properties, shape.area_light >= 0);
    const std::size_t index = shapes.size(), loaded = context.shapes.size();
    try {
        const auto* plugin = find_plugin(plugins, properties.type());
        if (!plugin)
            properties.element().fail("the shape '" + properties.type() + "' is not known");
        shapes.push_back(std::move(shape));
        context.shapes.push_back({&shapes, index, properties.element()});
        plugin->read(context, properties, shapes, index);
        properties.report_unused();
    } catch (const LoadError& error) { // thrown before a job is added
        shapes.erase(shapes.begin() + static_cast<std::ptrdiff_t>(index), shapes.end());
        context.shapes.erase(context.shapes.begin() + static_cast<std::ptrdiff_t>(loaded), context.shapes.end());
        context.notes.push_back(error.note("the shape is left out"));
    }
}

void add_to_group(LoadContext& context, const XmlElement& element, std::vector<Shape>& shapes);

/// Adds the shapes nested in a `merge`. Mitsuba makes one mesh of those with the same BSDF, for speed only.
void add_merged(LoadContext& context, Properties& properties, std::vector<Shape>& shapes) {
    for (const XmlElement& shape : context.take_nested(properties, "shape")) {
        const NestingGuard guard(context, shape);
        if (&shapes == &context.scene.shapes)
            add_shape(context, shape);
        else
            add_to_group(context, shape, shapes);
    }
    properties.report_unused();
}

/// Adds a shape to a group. As in Mitsuba, it may neither emit light nor be a group or an instance.
void add_to_group(LoadContext& context, const XmlElement& element, std::vector<Shape>& shapes) {
    Properties properties(element, context.notes);
    if (properties.type() == "shapegroup" || properties.type() == "instance")
        element.fail("a shapegroup holds neither groups nor instances", "type");
    for (const XmlElement& child : element.children())
        if (const XmlElement nested = context.resolve(child); nested.tag() == "emitter")
            child.fail("a shape of a shapegroup cannot emit light: lights cannot be instanced");
    if (properties.type() == "merge")
        add_merged(context, properties, shapes);
    else
        add_mesh_shape(context, properties, shapes);
}

/// Returns the index of a <shape type="shapegroup"> in scene.groups, and adds it on first use.
int group_of(LoadContext& context, const XmlElement& element) {
    if (const auto known = context.groups.find(element.key()); known != context.groups.end())
        return known->second;
    Properties properties(element, context.notes);
    ShapeGroup& group = context.scene.groups.emplace_back();
    const int index = static_cast<int>(context.scene.groups.size()) - 1;
    context.groups[element.key()] = index;
    group.name = properties.name();
    for (const XmlElement& shape : context.take_nested(properties, "shape"))
        add_to_group(context, shape, group.shapes);
    if (group.shapes.empty())
        properties.note("there are no shapes in the group");
    properties.report_unused();
    return index;
}

/// Returns whether a transform has an inverse, which transforms rays into a group's space, and must be finite.
bool has_inverse(const glm::mat4& transform) {
    constexpr double largest = 1e12; // element of the inverse; not tuned
    const glm::dmat4 inverse = glm::inverse(glm::dmat4(transform));
    for (int i = 0; i < 16; ++i)
        if (!(std::abs(inverse[i / 4][i % 4]) < largest))
            return false;
    return true;
}

void add_instance(LoadContext& context, Properties& properties) {
    const std::vector<XmlElement> nested = context.take_nested(properties, "shape");
    if (nested.size() != 1 || nested[0].attribute("type") != "shapegroup")
        properties.element().fail("an instance needs exactly one shapegroup, nested or by reference");
    const int group = group_of(context, nested[0]);
    const glm::mat4 to_world = properties.transform("to_world");
    properties.report_unused();
    if (has_inverse(to_world))
        context.scene.instances.push_back({group, to_world});
    else
        context.notes.push_back(properties.element()
                                    .error("the 'to_world' of an instance must have an inverse")
                                    .note("the instance is left out"));
}

} // namespace

void add_shape(LoadContext& context, const XmlElement& element) {
    Properties properties(element, context.notes);
    if (properties.type() == "shapegroup")
        group_of(context, element);
    else if (properties.type() == "instance")
        add_instance(context, properties);
    else if (properties.type() == "merge")
        add_merged(context, properties, context.scene.shapes);
    else
        add_mesh_shape(context, properties, context.scene.shapes);
}

void note_missing_attributes(LoadContext& context) {
    const SceneDescription& scene = context.scene;
    for (const LoadContext::LoadedShape& loaded : context.shapes) {
        const Shape& shape = (*loaded.shapes)[loaded.index];
        if (shape.mesh.triangles.empty() && !shape.quadric)
            continue; // an empty mesh has a note of its own
        std::vector<const Texture*> textures = scene.materials[shape.material].textures();
        if (shape.area_light >= 0)
            textures.push_back(&scene.area_lights[shape.area_light].radiance);
        for (const Texture* texture : textures) {
            const auto* attribute = std::get_if<AttributeTexture>(&texture->kind);
            if (attribute && !shape.mesh.attribute(attribute->name))
                context.notes.push_back(
                    {loaded.element.position(),
                     "the shape has no attribute '" + attribute->name + "'; white is used instead"});
        }
    }
}

} // namespace tessera
