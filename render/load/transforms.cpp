#include "render/load/properties.h"

#include <cmath>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace tessera {

namespace {

glm::vec3 triple(const XmlElement& element, const char* attribute) {
    const auto values = element.numbers(attribute);
    if (values.size() != 3)
        element.fail("'" + element.attribute(attribute) + "' must be three numbers", attribute);
    return {values[0], values[1], values[2]};
}

/// Reads value="x y z" (or one number for all three if `uniform`), or attributes x, y and z.
glm::vec3 components(const XmlElement& element, float fallback, bool uniform) {
    if (element.has("value")) {
        const auto values = element.numbers("value");
        if (uniform && values.size() == 1)
            return glm::vec3(values[0]);
        return triple(element, "value");
    }
    glm::vec3 result(fallback);
    static constexpr const char* names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i)
        if (element.has(names[i]))
            result[i] = element.number(names[i]);
    return result;
}

glm::mat4 matrix_of_rows(const XmlElement& element) {
    const auto v = element.numbers("value");
    if (v.size() != 16 && v.size() != 9)
        element.fail("a matrix has 16 numbers, or 9; here are " + std::to_string(v.size()), "value");
    const std::size_t rows = v.size() == 16 ? 4 : 3;
    glm::mat4 m(1.0f);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < rows; ++column)
            m[static_cast<int>(column)][static_cast<int>(row)] = v[row * rows + column];
    return m;
}

/// Reads a matrix. Nine numbers are a transform of the plane, whose translation goes to the fourth column.
glm::mat4 planar_matrix(const XmlElement& element) {
    const glm::mat4 m = matrix_of_rows(element);
    if (element.numbers("value").size() == 16)
        return m;
    glm::mat4 result(1.0f);
    result[0] = {m[0][0], m[0][1], 0, 0};
    result[1] = {m[1][0], m[1][1], 0, 0};
    result[3] = {m[2][0], m[2][1], 0, 1};
    return result;
}

/// Returns the transform of a camera that looks along its +z, with its +x to the left, as in Mitsuba.
glm::mat4 look_at(const XmlElement& element) {
    const glm::vec3 origin = triple(element, "origin");
    const glm::vec3 target = triple(element, "target");
    if (origin == target)
        element.fail("origin and target of a lookat are the same point", "target");
    const glm::vec3 forward = glm::normalize(target - origin);
    glm::vec3 up = element.has("up") ? triple(element, "up") : glm::vec3(0);
    if (up == glm::vec3(0)) // any direction that is not parallel to `forward`
        up = std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    glm::vec3 left = glm::cross(glm::normalize(up), forward);
    if (!(glm::length(left) > 1e-6f)) // `up` is parallel to `forward`
        left = std::abs(forward.y) < 0.9f ? glm::cross(glm::vec3(0, 1, 0), forward)
                                          : glm::cross(glm::vec3(0, 0, 1), forward);
    glm::mat4 m(1.0f);
    m[0] = glm::vec4(glm::normalize(left), 0);
    m[1] = glm::vec4(glm::cross(forward, glm::normalize(left)), 0);
    m[2] = glm::vec4(forward, 0);
    m[3] = glm::vec4(origin, 1);
    return m;
}

glm::mat4 rotation(const XmlElement& element, bool planar) {
    const bool has_axis = element.has("value") || element.has("x") || element.has("y") || element.has("z");
    const glm::vec3 axis = planar && !has_axis ? glm::vec3(0, 0, 1) : components(element, 0, false);
    if (glm::length(axis) == 0)
        element.fail("a rotation needs an axis");
    const float angle = glm::radians(element.number("angle"));
    if (is_mitsuba_0(element) || std::abs(glm::length(axis) - 1) < 1e-6f)
        return glm::rotate(glm::mat4(1.0f), angle, glm::normalize(axis));
    // Mitsuba 3 does not normalise the axis. Rodrigues' formula with an axis of another length also stretches.
    const float c = std::cos(angle), s = std::sin(angle);
    const glm::mat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
    return glm::mat4(c * glm::mat3(1.0f) + s * cross + (1 - c) * glm::outerProduct(axis, axis));
}

glm::mat4 step(const XmlElement& element, bool planar) {
    const std::string_view tag = element.tag();
    if (tag == "matrix")
        return planar ? planar_matrix(element) : matrix_of_rows(element);
    if (tag == "lookat" || tag == "look_at" || tag == "lookAt")
        return look_at(element);
    if (tag == "translate")
        return glm::translate(glm::mat4(1.0f), components(element, 0, false));
    if (tag == "scale")
        return glm::scale(glm::mat4(1.0f), components(element, 1, true));
    if (tag == "rotate")
        return rotation(element, planar);
    element.fail("<" + std::string(tag) + "> is not a step of a transform");
}

glm::mat4 product_of_steps(const XmlElement& transform, bool planar, std::vector<LoadNote>& notes) {
    glm::mat4 result(1.0f);
    for (const XmlElement& child : transform.children()) {
        try {
            result = step(child, planar) * result;
        } catch (const LoadError& error) {
            notes.push_back(error.note("this step of the transform is left out"));
        }
    }
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(result[i / 4][i % 4])) {
            notes.push_back(transform.error("the transform's numbers are too large").note("it is left out"));
            return glm::mat4(1.0f);
        }
    return result;
}

/// Returns the key of an <animation> of Mitsuba 0.6 with the smallest time; empty: it has none.
std::optional<XmlElement> first_key(const XmlElement& animation) {
    std::optional<XmlElement> first;
    const auto time_of = [](const XmlElement& key) { return key.has("time") ? key.number("time") : 0.0f; };
    for (const XmlElement& key : animation.children())
        if (key.tag() == "transform" && (!first || time_of(key) < time_of(*first)))
            first = key;
    return first;
}

/// Returns the transform that an <animation> has at its first key, with an error note.
glm::mat4 still_of(const XmlElement& animation, std::vector<LoadNote>& notes) {
    try {
        const std::optional<XmlElement> key = first_key(animation);
        notes.push_back(animation.error("animations are not rendered")
                            .note(key ? "its first key is used at all times" : "it has no keys and is left out"));
        return key ? product_of_steps(*key, false, notes) : glm::mat4(1.0f);
    } catch (const LoadError& error) {
        notes.push_back(error.note("the animation is left out"));
        return glm::mat4(1.0f);
    }
}

} // namespace

glm::mat4 read_transform(const XmlElement& transform, std::vector<LoadNote>& notes) {
    if (transform.tag() == "animation")
        return still_of(transform, notes);
    if (transform.tag() == "transform")
        return product_of_steps(transform, false, notes);
    notes.push_back(transform
                        .error("'" + transform.attribute("name") + "' must be of type <transform>, not <" +
                               std::string(transform.tag()) + ">")
                        .note("it is left out"));
    return glm::mat4(1.0f);
}

std::optional<glm::mat3> rotation_of(const glm::mat4& transform) {
    glm::mat3 m(transform);
    for (int i = 0; i < 3; ++i) {
        const float full_length = glm::length(m[i]);
        for (int j = 0; j < i; ++j)
            m[i] -= glm::dot(m[i], m[j]) * m[j];
        const float length = glm::length(m[i]);
        if (!(length > 1e-5f * full_length))
            return {};
        m[i] /= length;
    }
    return m;
}

glm::mat3 read_uv_transform(const XmlElement& transform, std::vector<LoadNote>& notes) {
    const glm::mat4 m = product_of_steps(transform, true, notes);
    return {m[0][0], m[0][1], 0, m[1][0], m[1][1], 0, m[3][0], m[3][1], 1};
}

glm::vec3 read_point(const XmlElement& point) {
    return components(point, 0, false);
}

} // namespace tessera
