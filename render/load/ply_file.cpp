#include "render/load/mesh_files.h"
#include "render/load/ply_header.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

namespace tessera {

namespace {

/// The values after the header, one after another.
class PlyValues {
public:
    PlyValues(std::string_view bytes, PlyFormat format) : bytes_(bytes), format_(format) {}

    std::size_t left() const { return bytes_.size(); }
    bool is_text() const { return format_ == PlyFormat::ascii; }

    double next(PlyType type) {
        if (is_text())
            return next_word();
        switch (type) {
        case PlyType::int8:
            return next_binary<std::int8_t>();
        case PlyType::uint8:
            return next_binary<std::uint8_t>();
        case PlyType::int16:
            return next_binary<std::int16_t>();
        case PlyType::uint16:
            return next_binary<std::uint16_t>();
        case PlyType::int32:
            return next_binary<std::int32_t>();
        case PlyType::uint32:
            return next_binary<std::uint32_t>();
        case PlyType::float32:
            return static_cast<double>(next_binary<float>());
        case PlyType::float64:
            break;
        }
        return next_binary<double>();
    }

private:
    template <class T>
    T next_binary() {
        if (bytes_.size() < sizeof(T))
            throw std::runtime_error("the file ends too early");
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), bytes_.data(), sizeof(T));
        bytes_.remove_prefix(sizeof(T));
        const bool is_native =
            (format_ == PlyFormat::little_endian) == (std::endian::native == std::endian::little);
        if (!is_native)
            for (std::size_t i = 0; i < sizeof(T) / 2; ++i)
                std::swap(raw[i], raw[sizeof(T) - 1 - i]);
        return std::bit_cast<T>(raw);
    }

    double next_word() {
        const std::size_t begin = bytes_.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos)
            throw std::runtime_error("the file ends too early");
        bytes_.remove_prefix(begin);
        const std::string_view word = bytes_.substr(0, bytes_.find_first_of(" \t\r\n"));
        bytes_.remove_prefix(word.size());
        double value = 0;
        const char* const end = word.data() + word.size();
        const auto [read, error] = std::from_chars(word.data() + (word.front() == '+' ? 1 : 0), end, value);
        if (read != end || error == std::errc::invalid_argument)
            throw std::runtime_error("'" + std::string(word.substr(0, 40)) + "' is not a number");
        return value;
    }

    std::string_view bytes_;
    PlyFormat format_;
};

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
    const std::size_t available = values.left() + 1; // the last line of a text may have no end
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
enum Slot { x, y, z, nx, ny, nz, u, v, slots, unused = slots };

Slot slot_of(const PlyProperty& property) {
    struct Name {
        std::string_view name;
        Slot slot;
    };
    static constexpr Name names[] = {{"x", x}, {"y", y}, {"z", z}, {"nx", nx}, {"ny", ny},       {"nz", nz},
                                     {"u", u}, {"v", v}, {"s", u}, {"t", v},   {"texture_u", u}, {"texture_v", v}};
    for (const Name& known : names)
        if (!property.is_list && known.name == property.name)
            return known.slot;
    return unused;
}

class PlyReader {
public:
    explicit PlyReader(std::string_view bytes)
        : header_(parse_ply_header(bytes)), values_(bytes.substr(header_.size), header_.format) {}

    Mesh read() {
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty() || element.count == 0)
                continue;
            check_count(element, values_);
            read_element(element);
        }
        check_indices();
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
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(element.name + " " + std::to_string(row) + ": " + e.what());
        }
    }

    void read_vertices(const PlyElement& element, std::uint64_t& row) {
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
        mesh_.positions.reserve(element.count);
        for (; row < element.count; ++row) {
            std::array<float, slots + 1> values{};
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (slot_of_property[i] == unused)
                    skip(values_, element.properties[i]);
                else
                    values[slot_of_property[i]] = next_finite(element.properties[i]);
            }
            mesh_.positions.push_back({values[x], values[y], values[z]});
            if (has_normals)
                mesh_.normals.push_back({values[nx], values[ny], values[nz]});
            if (has_uvs)
                mesh_.uvs.push_back({values[u], values[v]});
        }
    }

    float next_finite(const PlyProperty& property) {
        const auto value = static_cast<float>(values_.next(property.type));
        if (!std::isfinite(value))
            throw std::runtime_error("its " + property.name + " is not a finite number");
        return value;
    }

    void read_faces(const PlyElement& element, std::uint64_t& row) {
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

    /// At the end, as faces may stand before the vertices.
    void check_indices() const {
        for (const glm::uvec3& t : mesh_.triangles)
            for (int i = 0; i < 3; ++i)
                if (t[i] >= mesh_.positions.size())
                    throw std::runtime_error("a face refers to vertex " + std::to_string(t[i]) +
                                             ", but there are " + std::to_string(mesh_.positions.size()));
    }

    PlyHeader header_;
    PlyValues values_;
    Mesh mesh_;
};

} // namespace

Mesh parse_ply(std::string_view bytes) {
    return PlyReader(bytes).read();
}

} // namespace tessera
