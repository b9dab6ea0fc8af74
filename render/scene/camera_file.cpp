#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/io/text.h"
#include "render/scene/camera.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using json = nlohmann::ordered_json;

constexpr int most_edge = 1 << 20; // pixels, of a film in a camera file; not tuned

constexpr std::array known_fields = {"to_world",
                                     "fov",
                                     "fov_axis",
                                     "orthographic",
                                     "principal_point_offset",
                                     "aperture_radius",
                                     "focus_distance",
                                     "crop",
                                     "filter",
                                     "origin",
                                     "target",
                                     "up"};

/// Throws LoadError at the position of the field's value.
[[noreturn]] void fail(const JsonText& text, const std::string& field, const std::string& message) {
    text.fail_at(text.place_of(field), message);
}

float number(const JsonText& text, const std::string& field, const json& value) {
    if (!value.is_number())
        fail(text, field, fmt::format("'{}' must be numeric, not {}", field, value.type_name()));
    const float result = static_cast<float>(value.get<double>());
    if (!std::isfinite(result))
        fail(text, field, fmt::format("'{}' has a number that is too large", field));
    return result;
}

const json& required(const JsonText& text, const json& object, const std::string& field) {
    const auto found = object.find(field);
    if (found == object.end())
        text.fail_at(text.place_of(""), fmt::format("the camera has no '{}'", field));
    return *found;
}

glm::mat4 read_matrix(const JsonText& text, const json& value) {
    if (!value.is_array() || value.size() != 16)
        fail(text, "to_world",
             value.is_array() ? fmt::format("'to_world' must have 16 numbers, not {}", value.size())
                              : fmt::format("'to_world' must be a list of 16 numbers, not {}", value.type_name()));
    glm::mat4 m;
    for (int i = 0; i < 16; ++i)
        m[i % 4][i / 4] = number(text, "to_world", value[i]);
    for (int column = 0; column < 4; ++column)
        if (m[column][3] != (column == 3 ? 1.0f : 0.0f))
            fail(text, "to_world",
                 "the last four numbers of 'to_world' must be 0, 0, 0, 1 (the matrix is row by row)");
    return m;
}

/// Returns whether the matrix is singular. The determinant is compared with the product of the axes' lengths, so
/// that the result does not depend on the unit of length.
bool is_flat(const glm::mat4& m) {
    const glm::dmat3 axes{glm::mat3(m)};
    const double volume = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    return !(std::abs(glm::determinant(axes)) > 1e-6 * volume);
}

void read_field_of_view(const JsonText& text, const json& object, Camera& camera) {
    camera.fov = number(text, "fov", required(text, object, "fov"));
    if (!(camera.fov > 0 && camera.fov < 180))
        fail(text, "fov", "the field of view must be between 0 and 180 degrees");
    if (const auto axis = object.find("fov_axis"); axis != object.end()) {
        const auto known = axis->is_string() ? fov_axis_from_name(axis->get<std::string>()) : std::nullopt;
        if (!known)
            fail(text, "fov_axis", "'fov_axis' must be \"x\", \"y\", \"diagonal\", \"smaller\" or \"larger\"");
        camera.fov_axis = *known;
    }
}

bool read_is_orthographic(const JsonText& text, const json& object) {
    const auto found = object.find("orthographic");
    if (found != object.end() && !found->is_boolean())
        fail(text, "orthographic", "'orthographic' must be true or false");
    return found != object.end() && found->get<bool>();
}

glm::vec2 read_principal_offset(const JsonText& text, const json& object) {
    const auto found = object.find("principal_point_offset");
    if (found == object.end())
        return glm::vec2(0);
    if (!found->is_array() || found->size() != 2)
        fail(text, "principal_point_offset", "'principal_point_offset' must be 2 numbers");
    return {number(text, "principal_point_offset", (*found)[0]),
            number(text, "principal_point_offset", (*found)[1])};
}

void read_lens(const JsonText& text, const json& object, Camera& camera) {
    const auto radius = object.find("aperture_radius");
    if (radius == object.end())
        return;
    camera.aperture_radius = number(text, "aperture_radius", *radius);
    if (camera.aperture_radius < 0)
        fail(text, "aperture_radius", "'aperture_radius' must not be negative");
    camera.focus_distance = number(text, "focus_distance", required(text, object, "focus_distance"));
    if (!(camera.focus_distance > 0))
        fail(text, "focus_distance", "'focus_distance' must be above 0");
}

/// Reads a whole number of pixels from 0 to most_edge.
int pixels(const JsonText& text, const std::string& field, const json& value) {
    const float read = number(text, field, value);
    if (!(read >= 0 && read <= most_edge && read == std::floor(read)))
        fail(text, field, fmt::format("'{}' must have whole numbers from 0 to {}", field, most_edge));
    return static_cast<int>(read);
}

CropWindow read_crop(const JsonText& text, const json& object) {
    const auto found = object.find("crop");
    if (found == object.end())
        return {};
    if (!found->is_array() || found->size() != 6)
        fail(text, "crop", "'crop' must be 6 numbers: size of the film, offset and size of the window");
    std::array<int, 6> n{};
    for (std::size_t i = 0; i < n.size(); ++i)
        n[i] = pixels(text, "crop", (*found)[i]);
    const CropWindow crop{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}};
    if (!crop.is_valid())
        fail(text, "crop", "the crop window does not lie within its film");
    return crop;
}

PixelFilter read_filter(const JsonText& text, const json& object) {
    const auto found = object.find("filter");
    if (found == object.end())
        return {};
    const auto kind = found->is_array() && found->size() == 4 && (*found)[0].is_string()
                          ? filter_kind_from_name((*found)[0].get<std::string>())
                          : std::nullopt;
    if (!kind)
        fail(text, "filter", "'filter' must be a filter's name, its radius and two parameters");
    const PixelFilter filter{*kind, number(text, "filter", (*found)[1]), number(text, "filter", (*found)[2]),
                             number(text, "filter", (*found)[3])};
    if (!filter.is_valid())
        fail(text, "filter", "the filter's parameters are invalid");
    return filter;
}

/// Formats a float so that it is read back exactly: nine digits suffice, and the decimal point keeps the sign of
/// -0.
std::string exact(float x) {
    std::string text = fmt::format("{:.9g}", x);
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text;
}

std::string triple(glm::vec3 v) {
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z);
}

/// Returns the matrix row by row, as in files. A last row other than 0 0 0 1, which readers reject, is replaced;
/// a valid one keeps the signs of its zeros.
std::array<std::string, 16> rows(glm::mat4 m) {
    if (glm::row(m, 3) != glm::vec4(0, 0, 0, 1))
        m = glm::row(m, 3, glm::vec4(0, 0, 0, 1));
    std::array<std::string, 16> numbers;
    for (int i = 0; i < 16; ++i)
        numbers[i] = exact(m[i % 4][i / 4]);
    return numbers;
}

} // namespace

Camera parse_camera(const std::string& json_text, const std::string& name) {
    const JsonText text(json_text, name);
    const json object = text.parse();
    if (!object.is_object())
        text.fail_at(0, fmt::format("a camera file holds one object {{...}}, not {}", object.type_name()));
    for (const auto& [field, value] : object.items())
        if (std::find(known_fields.begin(), known_fields.end(), field) == known_fields.end())
            fail(text, field, fmt::format("unknown camera field '{}'", field));
    Camera camera;
    camera.to_world = read_matrix(text, required(text, object, "to_world"));
    if (is_flat(camera.to_world))
        fail(text, "to_world", "the camera's transform is flat");
    camera.is_orthographic = read_is_orthographic(text, object);
    if (!camera.is_orthographic)
        read_field_of_view(text, object, camera);
    camera.principal_offset = read_principal_offset(text, object);
    read_lens(text, object, camera);
    camera.crop = read_crop(text, object);
    camera.filter = read_filter(text, object);
    return camera;
}

Camera read_camera(const std::filesystem::path& file) {
    return parse_camera(read_text(file), file.string());
}

std::vector<Camera> read_camera_path(const std::filesystem::path& file) {
    const std::string content = read_text(file), name = file.string();
    const JsonText text(content, name);
    const json list = text.parse();
    if (!list.is_array() || list.empty())
        text.fail_at(0, fmt::format("a camera path holds a list [...] of cameras, not {}",
                                    list.is_array() ? "an empty one" : list.type_name()));
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < list.size(); ++i)
        cameras.push_back(parse_camera(text.only(std::to_string(i)), name));
    return cameras;
}

std::string camera_json(const Camera& camera) {
    const std::array<std::string, 16> m = rows(camera.to_world);
    std::string matrix;
    for (std::size_t i = 0; i < 16; i += 4)
        matrix += fmt::format("{}\n    {}, {}, {}, {}", i > 0 ? "," : "", m[i], m[i + 1], m[i + 2], m[i + 3]);
    const glm::vec3 origin(camera.to_world[3]);
    const glm::vec3 forward = glm::normalize(glm::vec3(camera.to_world[2]));
    const glm::vec3 up = glm::normalize(glm::vec3(camera.to_world[1]));
    std::string kind = camera.is_orthographic ? "  \"orthographic\": true,\n"
                                              : fmt::format("  \"fov\": {},\n  \"fov_axis\": \"{}\",\n",
                                                            exact(camera.fov), to_string(camera.fov_axis));
    if (camera.principal_offset != glm::vec2(0))
        kind += fmt::format("  \"principal_point_offset\": [{}, {}],\n", exact(camera.principal_offset.x),
                            exact(camera.principal_offset.y));
    if (camera.aperture_radius > 0)
        kind += fmt::format("  \"aperture_radius\": {},\n  \"focus_distance\": {},\n",
                            exact(camera.aperture_radius), exact(camera.focus_distance));
    if (const CropWindow& c = camera.crop; !c.empty())
        kind += fmt::format("  \"crop\": [{}, {}, {}, {}, {}, {}],\n", c.film.x, c.film.y, c.offset.x, c.offset.y,
                            c.size.x, c.size.y);
    if (const PixelFilter& f = camera.filter; f != PixelFilter())
        kind += fmt::format("  \"filter\": [\"{}\", {}, {}, {}],\n", to_string(f.kind), exact(f.radius),
                            exact(f.first), exact(f.second));
    return fmt::format("{{\n  \"to_world\": [{}\n  ],\n{}  \"origin\": {},\n  \"target\": {},\n  \"up\": {}\n}}\n",
                       matrix, kind, triple(origin), triple(origin + forward), triple(up));
}

void write_camera(const std::filesystem::path& file, const Camera& camera) {
    write_text(file, camera_json(camera));
}

std::string camera_xml(const Camera& camera) {
    const bool has_lens = camera.aperture_radius > 0;
    std::string xml;
    if (camera.is_orthographic || has_lens)
        xml = fmt::format("<!-- for a sensor of type {} -->\n", !camera.is_orthographic ? "thinlens"
                                                                : has_lens              ? "telecentric"
                                                                                        : "orthographic");
    const auto add = [&](std::string_view name, float value) {
        xml += fmt::format("<float name=\"{}\" value=\"{}\"/>\n", name, exact(value));
    };
    if (!camera.is_orthographic) {
        add("fov", camera.fov);
        xml += fmt::format("<string name=\"fov_axis\" value=\"{}\"/>\n", to_string(camera.fov_axis));
    }
    if (camera.principal_offset != glm::vec2(0)) {
        add("principal_point_offset_x", camera.principal_offset.x);
        add("principal_point_offset_y", camera.principal_offset.y);
    }
    if (has_lens) {
        add("aperture_radius", camera.aperture_radius);
        add("focus_distance", camera.focus_distance);
    }
    return xml + fmt::format("<transform name=\"to_world\">\n    <matrix value=\"{}\"/>\n</transform>\n",
                             fmt::join(rows(camera.to_world), " "));
}

} // namespace tessera
