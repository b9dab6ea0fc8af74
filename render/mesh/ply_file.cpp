#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/mesh/meshes.h"
#include "render/mesh/ply_format.h"
#include "render/mesh/ply_layout.h"

#include <algorithm>
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

    MeshFile read() {
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty() || element.count == 0)
                continue;
            check_count(element, values_);
            read_element(element);
        }
        check_indices();
        drop_partial_attributes();
        apply_corner_uvs();
        if (const std::size_t uncut = cut_polygons(mesh_, polygons_))
            report_.ignored.push_back("the shape of " + counted(uncut, "face") + " whose edges cross or are too many");
        if (small_faces_ > 0)
            report_.ignored.push_back(counted(small_faces_, "face") + " with fewer than 3 corners");
        for (std::string& error : repair_mesh(mesh_))
            report_.errors.push_back(std::move(error));
        mesh_.triangles.shrink_to_fit();
        return {std::move(mesh_), std::move(report_)};
    }

private:
    void read_element(const PlyElement& element) {
        std::uint64_t row = 0;
        try {
            if (element.name == "vertex")
                read_vertices(element, row);
            else if (element.name == "face")
                read_faces(element, row);
            else if (is_strips(element))
                read_strips(element, row);
            else
                skip_rows(element, row);
        } catch (const OutOfMemory&) {
            throw; // concerns the whole element, not this row
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(element.name + " " + std::to_string(row) + ": " + e.what());
        }
    }

    void skip_rows(const PlyElement& element, std::uint64_t& row) {
        report_.ignored.push_back("the element '" + element.name + "' (" + counted(element.count, "row") + ")");
        for (; row < element.count; ++row)
            for (const PlyProperty& property : element.properties)
                skip(values_, property);
    }

    /// Reports the properties of an element that have no effect.
    template <class IsUsed>
    void report_unused(const PlyElement& element, IsUsed is_used) {
        std::string names;
        for (std::size_t i = 0; i < element.properties.size(); ++i)
            if (!is_used(i))
                names += (names.empty() ? "'" : ", '") + element.properties[i].name + "'";
        if (!names.empty())
            report_.ignored.push_back(names + " of '" + element.name + "'");
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
        report_unused(element, [&](std::size_t i) { return layout.is_used(i); });
        report_.contents.push_back(counted(element.count, "position"));
        if (has_normals)
            report_.contents.emplace_back("normals");
        if (has_uvs)
            report_.contents.emplace_back("texture coordinates");
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
        for (const PlyAttribute& attribute : layout.attributes()) {
            mesh_.attributes.emplace_back(MeshAttribute{attribute.name, {}}).values.reserve(count);
            report_.contents.push_back("'" + attribute.name + "'");
        }
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
    }

    void read_faces(const PlyElement& element, std::uint64_t& row) {
        const PlyLayout layout(element, "face_");
        bool has_uvs = false;
        for (const PlyProperty& property : element.properties)
            has_uvs = has_uvs || is_corner_uvs(property);
        require_memory(element.count * (sizeof(glm::uvec3) + layout.attributes().size() * sizeof(Rgb) +
                                        (has_uvs ? 3 * sizeof(glm::vec2) : 0)),
                       "its " + std::to_string(element.count) + " faces");
        report_unused(element, [&](std::size_t i) {
            const PlyProperty& property = element.properties[i];
            return layout.is_used(i) || is_indices(property) || is_corner_uvs(property);
        });
        report_.contents.push_back(counted(element.count, "face"));
        if (has_uvs)
            report_.contents.emplace_back("texture coordinates of face corners");
        mesh_.triangles.reserve(element.count);
        const std::size_t first = add_attributes(layout, element.count);
        std::vector<float> numbers(element.properties.size());
        for (; row < element.count; ++row) {
            corners_.clear();
            face_uvs_.clear();
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (is_indices(property))
                    read_indices(property);
                else if (is_corner_uvs(property))
                    read_list(property, face_uvs_);
                else
                    read_number(property, layout.is_used(i), numbers[i]);
            }
            const std::size_t first_triangle = mesh_.triangles.size();
            add_fan();
            if (has_uvs)
                add_corner_uvs(first_triangle);
            fill_attributes(first, layout, element, numbers, mesh_.triangles.size() - first_triangle);
        }
    }

    static bool is_indices(const PlyProperty& property) {
        return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
    }
    /// Texture coordinates of the corners of a face: u and v of the first, of the second, ...
    static bool is_corner_uvs(const PlyProperty& property) {
        return property.is_list && (property.name == "texcoord" || property.name == "texcoords" ||
                                    property.name == "texture_coordinates" || property.name == "uv");
    }
    static bool is_strips(const PlyElement& element) {
        const auto is_list = [](const PlyProperty& property) { return is_indices(property); };
        return (element.name == "tristrips" || element.name == "tristrip") &&
               std::ranges::any_of(element.properties, is_list);
    }

    void read_list(const PlyProperty& property, std::vector<float>& numbers) {
        const std::uint64_t count = next_length(values_, property.count_type);
        for (std::uint64_t i = 0; i < count; ++i)
            numbers.push_back(static_cast<float>(values_.next(property.type)));
    }

    void read_indices(const PlyProperty& property) {
        const std::uint64_t count = next_length(values_, property.count_type);
        for (std::uint64_t i = 0; i < count; ++i)
            corners_.push_back(next_index(property.type));
    }

    void add_fan() {
        small_faces_ += corners_.size() < 3;
        if (corners_.size() > 3)
            polygons_.push_back({mesh_.triangles.size(), corners_.size()});
        for (std::size_t i = 2; i < corners_.size(); ++i)
            mesh_.triangles.emplace_back(corners_[0], corners_[i - 1], corners_[i]);
    }

    void add_corner_uvs(std::size_t first_triangle) {
        corner_uvs_.resize(3 * first_triangle);
        const bool fits = face_uvs_.size() == 2 * corners_.size();
        faces_without_uvs_ += !fits;
        const auto uv_of = [&](std::size_t corner) {
            const glm::vec2 uv = fits ? glm::vec2(face_uvs_[2 * corner], face_uvs_[2 * corner + 1]) : glm::vec2(0);
            const bool is_finite = std::isfinite(uv.x) && std::isfinite(uv.y);
            broken_uvs_ += !is_finite;
            return is_finite ? uv : glm::vec2(0);
        };
        for (std::size_t i = 2; i < corners_.size(); ++i)
            for (const std::size_t corner : {std::size_t{0}, i - 1, i})
                corner_uvs_.push_back(uv_of(corner));
    }

    void apply_corner_uvs() {
        if (faces_without_uvs_ > 0)
            report_.errors.push_back(counted(faces_without_uvs_, "face") +
                                     " without one texture coordinate per corner: (0, 0) is used");
        if (broken_uvs_ > 0)
            report_.errors.push_back(counted(broken_uvs_, "texture coordinate") + " not finite: (0, 0) is used");
        if (corner_uvs_.empty())
            return;
        corner_uvs_.resize(3 * mesh_.triangles.size());
        set_corner_uvs(mesh_, corner_uvs_);
    }

    /// Reads strips of triangles. An index of -1 begins a new strip.
    void read_strips(const PlyElement& element, std::uint64_t& row) {
        report_unused(element, [&](std::size_t i) { return is_indices(element.properties[i]); });
        const std::size_t first_triangle = mesh_.triangles.size();
        for (; row < element.count; ++row)
            for (const PlyProperty& property : element.properties) {
                if (is_indices(property))
                    read_strip(property);
                else
                    skip(values_, property);
            }
        report_.contents.push_back(counted(mesh_.triangles.size() - first_triangle, "triangle") + " of strips");
    }

    void read_strip(const PlyProperty& property) {
        const std::uint64_t count = next_length(values_, property.count_type);
        corners_.clear();
        for (std::uint64_t i = 0; i < count; ++i) {
            const double index = values_.next(property.type);
            const bool is_end = index == -1 || (property.type == PlyType::uint32 && index == 0xFFFFFFFF);
            if (is_end)
                corners_.clear();
            else
                corners_.push_back(checked_index(index));
            if (is_end || corners_.size() < 3)
                continue;
            glm::uvec3 t(corners_[corners_.size() - 3], corners_[corners_.size() - 2], corners_.back());
            if (corners_.size() % 2 == 0) // every second triangle of a strip runs the other way round
                std::swap(t.x, t.y);
            if (t.x != t.y && t.y != t.z && t.z != t.x) // others connect strips
                mesh_.triangles.push_back(t);
        }
    }

    std::uint32_t next_index(PlyType type) { return checked_index(values_.next(type)); }

    static std::uint32_t checked_index(double index) {
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

    /// Leaves out attributes that some faces or strips lack.
    void drop_partial_attributes() {
        std::erase_if(mesh_.attributes, [&](const MeshAttribute& attribute) {
            const bool is_partial = attribute.is_of_faces() && attribute.values.size() != mesh_.triangles.size();
            if (is_partial)
                report_.errors.push_back("'" + attribute.name + "' left out: some faces lack it");
            return is_partial;
        });
    }

    ByteWindow bytes_;
    PlyHeader header_;
    PlyValues values_;
    PlyColors colors_;
    Mesh mesh_;
    FileReport report_;
    std::vector<std::uint32_t> corners_; // of the face or strip being read
    std::vector<float> face_uvs_;        // of that face
    std::vector<PolygonFan> polygons_;
    std::vector<glm::vec2> corner_uvs_; // three per triangle, or fewer: the rest is 0; empty: none
    std::size_t small_faces_ = 0, faces_without_uvs_ = 0, broken_uvs_ = 0;
};

} // namespace

MeshFile read_ply(const std::filesystem::path& file, PlyColors colors) {
    std::ifstream stream = open_file(file);
    return PlyReader(stream, colors).read();
}

MeshFile parse_ply(std::string_view bytes, PlyColors colors) {
    std::istringstream stream{std::string(bytes)};
    return PlyReader(stream, colors).read();
}

} // namespace tessera
