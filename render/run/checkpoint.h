#pragma once

#include "render/io/memory.h"

#include <filesystem>
#include <string>

namespace tessera {

/// Contents of a checkpoint file, from which an interrupted job continues with the same bits.
struct Checkpoint {
    std::string identity; ///< text of the job, by which it recognises its own checkpoints
    std::vector<std::byte> state;
};

/// Writes the memory to a temporary file beside `path` and then renames it. Throws std::runtime_error that names
/// the file.
void write_checkpoint(const std::filesystem::path& path, const std::string& identity, const Memory& memory);

/// Reads a checkpoint. Throws std::runtime_error that names the file if it is no checkpoint, or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Reads the identity only. Throws as read_checkpoint() does, but does not verify the checksum.
std::string read_identity(const std::filesystem::path& path);

/// Reads the state from the file directly into the memory. Throws std::runtime_error that names the file if it is
/// no checkpoint, has another size, or is damaged. The contents of the memory are undefined after damage.
void restore(const std::filesystem::path& path, const Memory& memory);

/// Returns whether the memory has the size of the checkpoint's state.
bool fits(const Checkpoint& checkpoint, const Memory& memory);

/// Copies the state into the memory. Throws std::runtime_error, and leaves the memory unchanged, unless fits().
void restore(const Checkpoint& checkpoint, const Memory& memory);

} // namespace tessera
