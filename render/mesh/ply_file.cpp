#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/mesh/meshes.h"
#include "render/mesh/ply_format.h"
#include "render/mesh/ply_layout.h"

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

/// Returns the smallest number of bytes that a row of the element can take.
std::size_t min_row_bytes(const PlyElement& element, bool is_text) {
    if (is_text)
        return 2 * element.properties.size(); // each takes a digit, and a space or line end
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties)
        size += size_of(property.is_list ? property.count_type : property.type);
    return size;
}

/// Throws std::runtime_error if the rest of the file cannot hold the declared rows. Call it before allocating.
void check_count(const PlyElement& element, const PlyValues& values) {
    const std::uint64_t available = values.left() + 1; // the last text line may lack its line end
    if (element.count > available / min_row_bytes(element, values.is_text()))
        throw std::runtime_error("the header declares " + std::to_string(element.count) + " rows of '" +
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

/// Returns the value of full intensity: 1 for floats, the largest value for integers.
float full_intensity(PlyType type) {
    if (type == PlyType::float32 || type == PlyType::float64)
        return 1;
    const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    return std::exp2(8 * static_cast<float>(size_of(type)) - (is_signed ? 1 : 0)) - 1;
}

/// Takes the header, which must fit into the window's capacity.
PlyHeader take_header(ByteWindow& bytes) {
    bytes.fill(ByteWindow::capacity);
    PlyHeader header = parse_ply_header(bytes.bytes());
    bytes.take(header.size);
    return header;
}

class PlyReader {
    using Slot = PlyLayout::Slot;

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
        check_attributes();
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
            throw; // concerns the whole element, not this row
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(element.name + " " + std::to_string(row) + ": " + e.what());
        }
    }

    void read_vertices(const PlyElement& element, std::uint64_t& row) {
        if (!mesh_.positions.empty())
            throw std::runtime_error("there is a second list of vertices");
        const PlyLayout layout(element, "vertex_");
        if (!layout.has({Slot::x, Slot::y, Slot::z}))
            throw std::runtime_error("x, y or z is missing");
        const bool has_normals = layout.has({Slot::nx, Slot::ny, Slot::nz});
        const bool has_uvs = layout.has({Slot::u, Slot::v});
        require_memory(element.count *
                           (2 * sizeof(glm::vec3) + // positions, and given or computed normals
                            (has_uvs ? sizeof(glm::vec2) : 0) + layout.attributes().size() * sizeof(Rgb)),
                       "its " + std::to_string(element.count) + " vertices");
        mesh_.positions.reserve(element.count);
        mesh_.normals.reserve(has_normals ? element.count : 0);
        mesh_.uvs.reserve(has_uvs ? element.count : 0);
        const std::size_t first = add_attributes(layout, element.count);
        std::vector<float> numbers(element.properties.size());
        const auto number = [&](Slot slot) { return numbers[*layout.place(slot)]; };
        for (; row < element.count; ++row) {
            for (std::size_t i = 0; i < numbers.size(); ++i)
                read_number(element.properties[i], layout.is_used(i), numbers[i]);
            mesh_.positions.push_back({number(Slot::x), number(Slot::y), number(Slot::z)});
            if (has_normals)
                mesh_.normals.push_back({number(Slot::nx), number(Slot::ny), number(Slot::nz)});
            if (has_uvs)
                mesh_.uvs.push_back({number(Slot::u), number(Slot::v)});
            fill_attributes(first, layout, element, numbers, 1);
        }
    }

    /// Reserves the attributes of a layout. Returns the index of the first.
    std::size_t add_attributes(const PlyLayout& layout, std::size_t count) {
        const std::size_t first = mesh_.attributes.size();
        for (const PlyAttribute& attribute : layout.attributes())
            mesh_.attributes.emplace_back(MeshAttribute{attribute.name, {}}).values.reserve(count);
        return first;
    }

    void fill_attributes(std::size_t first, const PlyLayout& layout, const PlyElement& element,
                         const std::vector<float>& numbers, std::size_t count) {
        for (const PlyAttribute& attribute : layout.attributes()) {
            glm::vec3 value;
            for (int i = 0; i < 3; ++i) {
                const std::size_t property = attribute.properties[i];
                value[i] = attribute.is_color ? decoded(numbers[property], element.properties[property].type)
                                              : numbers[property];
            }
            std::vector<glm::vec3>& values = mesh_.attributes[first++].values;
            values.insert(values.end(), count, value);
        }
    }

    float decoded(float color, PlyType type) const {
        const float largest = full_intensity(type);
        const bool is_srgb = largest == 1 ? colors_.srgb_floats : colors_.srgb_bytes;
        return is_srgb ? srgb_to_linear(color / largest) : color / largest;
    }

    void read_number(const PlyProperty& property, bool is_used, float& number) {
        if (!is_used)
            return skip(values_, property);
        number = static_cast<float>(values_.next(property.type));
        if (!std::isfinite(number))
            throw std::runtime_error("its " + property.name + " is not a finite number");
    }

    void read_faces(const PlyElement& element, std::uint64_t& row) {
        const PlyLayout layout(element, "face_");
        require_memory(element.count * (sizeof(glm::uvec3) + layout.attributes().size() * sizeof(Rgb)),
                       "its " + std::to_string(element.count) + " faces");
        mesh_.triangles.reserve(element.count);
        const std::size_t first = add_attributes(layout, element.count);
        std::vector<float> numbers(element.properties.size());
        for (; row < element.count; ++row) {
            const std::size_t first_triangle = mesh_.triangles.size();
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
                    read_fan(property);
                else
                    read_number(property, layout.is_used(i), numbers[i]);
            }
            fill_attributes(first, layout, element, numbers, mesh_.triangles.size() - first_triangle);
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
            throw std::runtime_error(std::to_string(index) + " is not a vertex index");
        return static_cast<std::uint32_t>(index);
    }

    /// Checks indices at the end, because faces may precede the vertices.
    void check_indices() const {
        for (const glm::uvec3& t : mesh_.triangles)
            for (int i = 0; i < 3; ++i)
                if (t[i] >= mesh_.positions.size())
                    throw std::runtime_error("a face refers to vertex " + std::to_string(t[i]) +
                                             ", but there are " + std::to_string(mesh_.positions.size()));
    }

    /// Checks that attributes cover all faces, which may be in several elements.
    void check_attributes() const {
        for (const MeshAttribute& attribute : mesh_.attributes)
            if (attribute.is_of_faces() && attribute.values.size() != mesh_.triangles.size())
                throw std::runtime_error("not all faces have the attribute '" + attribute.name + "'");
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
