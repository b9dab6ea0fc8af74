#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <zlib.h>

namespace tessera {

/// Builds files in Mitsuba's format "serialized".
class SerializedBytes {
public:
    explicit SerializedBytes(std::uint16_t version) : version_(version) {}

    template <class T>
    static void append(std::string& bytes, T value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }

    /// Appends a mesh. `body` holds its uncompressed bytes, beginning with the flags.
    SerializedBytes& mesh(const std::string& body) {
        offsets_.push_back(bytes_.size());
        append<std::uint16_t>(bytes_, 0x041C);
        append(bytes_, version_);
        std::string packed(compressBound(body.size()), '\0');
        uLongf size = packed.size();
        compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(body.data()),
                 body.size());
        bytes_ += packed.substr(0, size);
        return *this;
    }

    /// Returns the whole file, with the table of offsets at its end.
    std::string file() const {
        std::string result = bytes_;
        for (const std::uint64_t offset : offsets_)
            if (version_ == 4)
                append(result, offset);
            else
                append(result, static_cast<std::uint32_t>(offset));
        append(result, static_cast<std::uint32_t>(offsets_.size()));
        return result;
    }

    /// Returns the uncompressed bytes of the square [0, size]^2 of two triangles, with the attributes in `flags`:
    /// normals (1), UVs (2), colours (8).
    template <class Number>
    std::string square(std::uint32_t flags, double size) const {
        constexpr double corners[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const auto add = [](std::string& to, std::initializer_list<double> values) {
            for (const double value : values)
                append(to, static_cast<Number>(value));
        };
        std::string body;
        append(body, flags | (sizeof(Number) == 8 ? 0x2000u : 0x1000u));
        if (version_ == 4)
            body += std::string("square\0", 7);
        append<std::uint64_t>(body, 4);
        append<std::uint64_t>(body, 2);
        for (const auto& c : corners)
            add(body, {size * c[0], size * c[1], 0});
        for (int i = 0; flags & 1 && i < 4; ++i)
            add(body, {0, 0, -2});
        for (const auto& c : corners)
            if (flags & 2)
                add(body, {c[0], c[1]});
        for (int i = 0; flags & 8 && i < 4; ++i)
            add(body, {1, 0.5, 0.25});
        for (const std::uint32_t index : {0, 1, 2, 0, 2, 3})
            append(body, index);
        return body;
    }

private:
    std::uint16_t version_;
    std::string bytes_;
    std::vector<std::uint64_t> offsets_;
};

} // namespace tessera
