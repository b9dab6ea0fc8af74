#include "render/io/byte_stream.h"

#include "render/io/memory.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include <zlib.h>

namespace tessera {

ByteWindow::ByteWindow(std::istream& stream) : stream_(stream) {
    const std::streamoff begin = stream.tellg();
    stream.seekg(0, std::ios::end);
    const std::streamoff end = stream.tellg();
    stream.seekg(begin);
    if (begin < 0 || end < begin || !stream)
        throw std::runtime_error("the file cannot be read");
    unread_ = static_cast<std::uint64_t>(end - begin);
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(capacity, unread_)));
}

bool ByteWindow::refill(std::size_t count) {
    if (unread_ == 0)
        return false;
    std::copy(bytes_.begin(), bytes_.end(), buffer_.begin());
    const std::size_t kept = bytes_.size();
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - kept, unread_));
    if (!stream_.read(buffer_.data() + kept, static_cast<std::streamsize>(wanted)))
        throw std::runtime_error("the file cannot be read");
    unread_ -= wanted;
    bytes_ = {buffer_.data(), kept + wanted};
    return bytes_.size() >= count;
}

struct ZlibReader::State {
    explicit State(std::istream& source) : compressed(source) {
        if (inflateInit(&zlib) != Z_OK)
            throw std::runtime_error("zlib cannot be initialised");
    }
    ~State() { inflateEnd(&zlib); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    void refill() {
        compressed.read(input.data(), static_cast<std::streamsize>(input.size()));
        zlib.next_in = reinterpret_cast<Bytef*>(input.data());
        zlib.avail_in = static_cast<uInt>(compressed.gcount());
        if (zlib.avail_in == 0)
            throw std::runtime_error("the file ends too early");
    }

    std::istream& compressed;
    std::array<char, 1 << 16> input;
    z_stream zlib{};
};

ZlibReader::ZlibReader(std::istream& compressed) : state_(std::make_unique<State>(compressed)) {}
ZlibReader::~ZlibReader() = default;

void ZlibReader::read(void* bytes, std::size_t size) {
    z_stream& zlib = state_->zlib;
    zlib.next_out = static_cast<Bytef*>(bytes);
    while (size > 0) {
        const auto chunk = static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
        zlib.avail_out = chunk;
        if (zlib.avail_in == 0)
            state_->refill();
        const int result = inflate(&zlib, Z_NO_FLUSH);
        size -= chunk - zlib.avail_out;
        if (result == Z_STREAM_END && size > 0)
            throw std::runtime_error("the compressed data end too early");
        if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
            throw std::runtime_error("the compressed data are broken");
    }
}

std::uint32_t checksum(std::span<const std::byte> bytes, std::uint32_t before) {
    if (bytes.empty())
        return before; // for a null pointer, zlib returns the initial checksum
    return static_cast<std::uint32_t>(
        crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

} // namespace tessera
