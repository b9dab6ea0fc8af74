#include "render/run/checkpoint.h"

#include "render/io/files.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace tessera {

namespace {

/// Head of a checkpoint file; identity and state follow. Layout and byte order are those of the writing program.
struct CheckpointHeader {
    char magic[8] = {'T', 'S', 'S', 'R', 'C', 'K', 'P', '1'};
    std::uint64_t identity_bytes = 0;
    std::uint64_t state_bytes = 0;
    std::uint64_t checksum = 0; ///< of identity and state
};

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

void write(std::ofstream& out, std::span<const std::byte> bytes) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& identity, const Memory& memory) {
    CheckpointHeader header;
    header.identity_bytes = identity.size();
    std::uint32_t sum = checksum(bytes_of(identity));
    for (std::span<const std::byte> piece : memory) {
        header.state_bytes += piece.size();
        sum = checksum(piece, sum);
    }
    header.checksum = sum;
    TemporaryFile temporary(path);
    std::ofstream out(temporary.path(), std::ios::binary);
    write(out, std::as_bytes(std::span(&header, 1)));
    write(out, bytes_of(identity));
    for (std::span<const std::byte> piece : memory)
        write(out, piece);
    out.close();
    if (!out)
        throw std::runtime_error(path.string() + ": cannot be written");
    temporary.commit();
}

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* why) {
    throw std::runtime_error(path.string() + ": " + why);
}

/// A checkpoint file that was read up to its state.
struct OpenedCheckpoint {
    CheckpointHeader header;
    std::string identity;
    std::ifstream rest;
};

OpenedCheckpoint open_checkpoint(const std::filesystem::path& path) {
    OpenedCheckpoint opened;
    CheckpointHeader& header = opened.header;
    opened.rest.open(path, std::ios::binary);
    if (!opened.rest || !opened.rest.read(reinterpret_cast<char*>(&header), sizeof header) ||
        std::memcmp(header.magic, CheckpointHeader().magic, sizeof header.magic) != 0)
        fail(path, "is not a checkpoint");
    // Sizes of a damaged file could demand any amount of memory.
    const std::uint64_t rest = std::filesystem::file_size(path) - sizeof header;
    if (header.identity_bytes > rest || header.state_bytes != rest - header.identity_bytes)
        fail(path, "is damaged: its length differs from the one in its header");
    opened.identity.resize(header.identity_bytes);
    opened.rest.read(opened.identity.data(), static_cast<std::streamsize>(header.identity_bytes));
    return opened;
}

/// Reads the state into memory of the same size, and verifies the checksum.
void read_state(OpenedCheckpoint& opened, const std::filesystem::path& path, const Memory& memory) {
    std::uint32_t sum = checksum(bytes_of(opened.identity));
    for (std::span<std::byte> piece : memory) {
        opened.rest.read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(piece.size()));
        sum = checksum(piece, sum);
    }
    if (!opened.rest || sum != opened.header.checksum)
        fail(path, "is damaged");
}

std::uint64_t size_of(const Memory& memory) {
    std::uint64_t size = 0;
    for (std::span<std::byte> piece : memory)
        size += piece.size();
    return size;
}

} // namespace

Checkpoint read_checkpoint(const std::filesystem::path& path) {
    OpenedCheckpoint opened = open_checkpoint(path);
    Checkpoint checkpoint{opened.identity, std::vector<std::byte>(opened.header.state_bytes)};
    read_state(opened, path, {std::span(checkpoint.state)});
    return checkpoint;
}

std::string read_identity(const std::filesystem::path& path) {
    return open_checkpoint(path).identity;
}

void restore(const std::filesystem::path& path, const Memory& memory) {
    OpenedCheckpoint opened = open_checkpoint(path);
    if (opened.header.state_bytes != size_of(memory))
        fail(path, "is of another version of the program, or another size");
    read_state(opened, path, memory);
}

bool fits(const Checkpoint& checkpoint, const Memory& memory) {
    return size_of(memory) == checkpoint.state.size();
}

void restore(const Checkpoint& checkpoint, const Memory& memory) {
    if (!fits(checkpoint, memory))
        throw std::runtime_error("the checkpoint is of another size");
    auto next = checkpoint.state.begin();
    for (std::span<std::byte> piece : memory) {
        std::copy_n(next, piece.size(), piece.begin());
        next += static_cast<std::ptrdiff_t>(piece.size());
    }
}

} // namespace tessera
