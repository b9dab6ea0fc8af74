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

/// An attribute that the rows of an element have (MeshAttribute), and where its numbers stand.
struct PlyAttribute {
    std::string name;
    std::array<std::size_t, 3> properties{}; ///< of the element; for a single number three times the same
    bool is_color = false;                   ///< coded as PlyColors says
};

/// What is read of the vertices or faces of a PLY file: which of their properties mean what. The attributes are
/// named as in Mitsuba 3:
/// - red green blue, r g b, and these with diffuse_ before them: "color"
/// - NAME_0 NAME_1 NAME_2, or counted from 1, or NAME_x NAME_y NAME_z: "NAME"
/// - NAME_r NAME_g NAME_b: "NAME_color"
/// - NAME_0 alone: "NAME", one number
/// Of more than three the first three are taken; lists, two numbers and all other properties are none.
class PlyLayout {
public:
    /// What vertices have beside attributes.
    enum class Slot { x, y, z, nx, ny, nz, u, v, count };

    /// `prefix` of the attributes' names is "vertex_" or "face_".
    PlyLayout(const PlyElement& element, std::string_view prefix);

    const std::vector<PlyAttribute>& attributes() const { return attributes_; }
    /// Whether anything is made of a property.
    bool is_used(std::size_t property) const { return is_used_[property]; }
    /// The property for a slot; empty: there is none.
    std::optional<std::size_t> place(Slot slot) const { return places_[static_cast<std::size_t>(slot)]; }
    bool has(std::initializer_list<Slot> slots) const;

private:
    std::vector<PlyAttribute> attributes_;
    std::vector<bool> is_used_;
    std::array<std::optional<std::size_t>, static_cast<std::size_t>(Slot::count)> places_;
};

} // namespace tessera
