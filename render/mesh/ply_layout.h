#pragma once

#include "render/mesh/ply_format.h"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A mesh attribute (MeshAttribute) in a PLY file, and the properties that hold its components.
struct PlyAttribute {
    std::string name;
    std::array<std::size_t, 3> properties{}; ///< property indices; three times the same for one number
    bool is_color = false;                   ///< whether PlyColors states its encoding
};

/// Assigns meanings to the properties of a PLY file's vertices or faces. Attributes are named as in Mitsuba 3:
/// - red green blue or r g b, with or without the prefix diffuse_: "color"
/// - NAME_0 NAME_1 NAME_2 (or counted from 1), or NAME_x NAME_y NAME_z: "NAME"
/// - NAME_r NAME_g NAME_b: "NAME_color"
/// - NAME_0 alone: "NAME", one number
/// Of more than three numbers, the first three are used. Lists, pairs and all other properties are ignored.
class PlyLayout {
public:
    /// Vertex properties that are not attributes.
    enum class Slot { x, y, z, nx, ny, nz, u, v, count };

    /// `prefix` of attribute names is "vertex_" or "face_".
    PlyLayout(const PlyElement& element, std::string_view prefix);

    const std::vector<PlyAttribute>& attributes() const { return attributes_; }
    /// Returns whether a property is used.
    bool is_used(std::size_t property) const { return is_used_[property]; }
    /// Returns the index of the property for a slot; empty: there is none.
    std::optional<std::size_t> place(Slot slot) const { return places_[static_cast<std::size_t>(slot)]; }
    bool has(std::initializer_list<Slot> slots) const;

private:
    std::vector<PlyAttribute> attributes_;
    std::vector<bool> is_used_;
    std::array<std::optional<std::size_t>, static_cast<std::size_t>(Slot::count)> places_;
};

} // namespace tessera
