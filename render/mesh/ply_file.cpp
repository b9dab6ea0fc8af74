#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/mesh/meshes.h"
#include "render/mesh/ply_format.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// The fewest bytes that a row of the element can take.
std::size_t smallest_row(const PlyElement& element, bool is_text) {
    if (is_text)
        return 2 * element.properties.size(); // a digit and a space or line end each
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties)
        size += size_of(property.is_list ? property.count_type : property.type);
    return size;
}

/// A file must be able to hold what it promises, before any memory is set aside for it.
void check_count(const PlyElement& element, const PlyValues& values) {
    const std::uint64_t available = values.left() + 1; // the last line of a text may have no end
    if (element.count > available / smallest_row(element, values.is_text()))
        throw std::runtime_error("the header promises " + std::to_string(element.count) + " rows of '" +
                                 element.name + "', but the file ends too early for them");
    if (element.count >= std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("there are too many rows of '" + element.name + "'");
}

std::uint64_t next_length(PlyValues& values, PlyType type) {
    const double length = values.next(type);
    if (!(length >= 0) || length != std::floor(length) || length > 0x1p32)
        throw std::runtime_error("a list cannot have the length " + std::to_string(length));
    return static_cast<std::uint64_t>(length);
}

void skip(PlyValues& values, const PlyProperty& property) {
    const std::uint64_t count = property.is_list ? next_length(values, property.count_type) : 1;
    for (std::uint64_t i = 0; i < count; ++i)
        values.next(property.type);
}

// The places of a vertex's properties in a row of numbers.
enum Slot { x, y, z, nx, ny, nz, u, v, red, green, blue, slots, unused = slots };

Slot slot_of(const PlyProperty& property) {
    struct Name {
        std::string_view name;
        Slot slot;
    };
    static constexpr Name names[] = {
        {"x", x},
        {"y", y},
        {"z", z},
        {"nx", nx},
        {"ny", ny},
        {"nz", nz},
        {"u", u},
        {"v", v},
        {"s", u},
        {"t", v},
        {"texture_u", u},
        {"texture_v", v},
        {"red", red},
        {"green", green},
        {"blue", blue},
        {"r", red},
        {"g", green},
        {"b", blue},
        {"color_0", red}, // as Mitsuba 3 writes them
        {"color_1", green},
        {"color_2", blue},
        {"diffuse_red", red},
        {"diffuse_green", green},
        {"diffuse_blue", blue},
    };
    for (const Name& known : names)
        if (!property.is_list && known.name == property.name)
            return known.slot;
    return unused;
}

/// What stands for full intensity: integers are shares of their largest value.
float largest_color(PlyType type) {
    if (type == PlyType::float32 || type == PlyType::float64)
        return 1;
    const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    return std::exp2(8 * static_cast<float>(size_of(type)) - (is_signed ? 1 : 0)) - 1;
}

/// The header, which must fit into memory; leaves the bytes after it.
PlyHeader take_header(ByteWindow& bytes) {
    bytes.fill(ByteWindow::capacity);
    PlyHeader header = parse_ply_header(bytes.bytes());
    bytes.take(header.size);
    return header;
}

class PlyReader {
public:
    PlyReader(std::istream& stream, PlyColors colors)
        : bytes_(stream), header_(take_header(bytes_)), values_(bytes_, header_.format), colors_(colors) {}

    Mesh read() {
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty() || element.count == 0)
                continue;
            check_count(element, values_);
            read_element(element);
        }
        check_indices();
        mesh_.triangles.shrink_to_fit();
        return std::move(mesh_);
    }

private:
    void read_element(const PlyElement& element) {
        std::uint64_t row = 0;
        try {
            if (element.name == "vertex")
                read_vertices(element, row);
            else if (element.name == "face")
                read_faces(element, row);
            else
                for (; row < element.count; ++row)
                    for (const PlyProperty& property : element.properties)
                        skip(values_, property);
        } catch (const OutOfMemory&) {
            throw; // of all its rows, not of this one
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(element.name + " " + std::to_string(row) + ": " + e.what());
        }
    }

    void read_vertices(const PlyElement& element, std::uint64_t& row) {
        if (!mesh_.positions.empty())
            throw std::runtime_error("a second list of vertices is one too many");
        std::vector<Slot> slot_of_property;
        std::array<bool, slots + 1> has{};
        for (const PlyProperty& property : element.properties) {
            slot_of_property.push_back(slot_of(property));
            has[slot_of_property.back()] = true;
        }
        if (!has[x] || !has[y] || !has[z])
            throw std::runtime_error("there is no x, y and z");
        const bool has_normals = has[nx] && has[ny] && has[nz];
        const bool has_uvs = has[u] && has[v];
        const bool has_colors = has[red] && has[green] && has[blue];
        ask_for_memory(element.count * (2 * sizeof(glm::vec3) + // positions and normals: its own, or computed ones
                                        (has_uvs ? sizeof(glm::vec2) : 0) + (has_colors ? sizeof(Rgb) : 0)),
                       "its " + std::to_string(element.count) + " vertices");
        mesh_.positions.reserve(element.count);
        mesh_.normals.reserve(has_normals ? element.count : 0);
        mesh_.uvs.reserve(has_uvs ? element.count : 0);
        mesh_.colors.reserve(has_colors ? element.count : 0);
        for (; row < element.count; ++row) {
            std::array<float, slots + 1> values{};
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (slot_of_property[i] == unused)
                    skip(values_, element.properties[i]);
                else
                    values[slot_of_property[i]] = next_number(element.properties[i], slot_of_property[i]);
            }
            mesh_.positions.push_back({values[x], values[y], values[z]});
            if (has_normals)
                mesh_.normals.push_back({values[nx], values[ny], values[nz]});
            if (has_uvs)
                mesh_.uvs.push_back({values[u], values[v]});
            if (has_colors)
                mesh_.colors.push_back({values[red], values[green], values[blue]});
        }
    }

    float next_number(const PlyProperty& property, Slot slot) {
        const float value = next_finite(property);
        if (slot != red && slot != green && slot != blue)
            return value;
        const float largest = largest_color(property.type);
        return (largest == 1 ? colors_.srgb_floats : colors_.srgb_bytes) ? srgb_to_linear(value / largest)
                                                                         : value / largest;
    }

    float next_finite(const PlyProperty& property) {
        const auto value = static_cast<float>(values_.next(property.type));
        if (!std::isfinite(value))
            throw std::runtime_error("its " + property.name + " is not a finite number");
        return value;
    }

    void read_faces(const PlyElement& element, std::uint64_t& row) {
        ask_for_memory(element.count * sizeof(glm::uvec3), "its " + std::to_string(element.count) + " faces");
        mesh_.triangles.reserve(element.count);
        for (; row < element.count; ++row)
            for (const PlyProperty& property : element.properties) {
                if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
                    read_fan(property);
                else
                    skip(values_, property);
            }
    }

    void read_fan(const PlyProperty& property) {
        const std::uint64_t count = next_length(values_, property.count_type);
        std::uint32_t first = 0;
        std::uint32_t previous = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint32_t current = next_index(property.type);
            if (i >= 2)
                mesh_.triangles.push_back({first, previous, current});
            if (i == 0)
                first = current;
            previous = current;
        }
    }

    std::uint32_t next_index(PlyType type) {
        const double index = values_.next(type);
        if (!(index >= 0) || index != std::floor(index) || index > std::numeric_limits<std::uint32_t>::max())
            throw std::runtime_error("there can be no vertex " + std::to_string(index));
        return static_cast<std::uint32_t>(index);
    }

    /// Is called at the end, as faces may stand before the vertices.
    void check_indices() const {
        for (const glm::uvec3& t : mesh_.triangles)
            for (int i = 0; i < 3; ++i)
                if (t[i] >= mesh_.positions.size())
                    throw std::runtime_error("a face refers to vertex " + std::to_string(t[i]) +
                                             ", but there are " + std::to_string(mesh_.positions.size()));
    }

    ByteWindow bytes_;
    PlyHeader header_;
    PlyValues values_;
    PlyColors colors_;
    Mesh mesh_;
};

} // namespace

Mesh read_ply(const std::filesystem::path& file, PlyColors colors) {
    std::ifstream stream = open_file(file);
    return PlyReader(stream, colors).read();
}

Mesh parse_ply(std::string_view bytes, PlyColors colors) {
    std::istringstream stream{std::string(bytes)};
    return PlyReader(stream, colors).read();
}

} // namespace tessera
