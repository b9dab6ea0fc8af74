#pragma once

#include "render/load/xml_document.h"

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// The product of a <transform>'s steps (matrix, lookat, translate, rotate, scale); the first step is applied to a
/// point first. Throws LoadError.
glm::mat4 read_transform(const XmlElement& transform);

/// The rotation (and mirroring) nearest to a transform, by Gram and Schmidt; empty: the transform is flat.
std::optional<glm::mat3> rotation_of(const glm::mat4& transform);

/// The same as read_transform() for texture coordinates (u, v, 1); a matrix may have 9 numbers instead of 16.
glm::mat3 read_uv_transform(const XmlElement& transform);

/// A <point> or <vector>: value="x y z", or attributes x, y and z, 0 where one is left out. Throws LoadError.
glm::vec3 read_point(const XmlElement& point);

} // namespace tessera
