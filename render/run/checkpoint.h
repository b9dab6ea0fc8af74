#pragma once

#include "render/io/memory.h"

#include <filesystem>
#include <string>

namespace tessera {

/// What a checkpoint file holds: from it a long job goes on as if it had never ended.
struct Checkpoint {
    std::string identity; ///< of the job, in its own words: it decides whether it can go on from here
    std::vector<std::byte> state;
};

/// Writes the memory to a temporary name beside `path` that is then renamed. Throws std::runtime_error that names
/// the file.
void write_checkpoint(const std::filesystem::path& path, const std::string& identity, const Memory& memory);

/// Reads a checkpoint. Throws std::runtime_error that names the file where it is none, or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// The identity alone. Throws as read_checkpoint does, but does not look at the state.
std::string read_identity(const std::filesystem::path& path);

/// Fills the memory from the file, of which nothing else is held in memory. Throws std::runtime_error that names
/// the file where it is no checkpoint, or of another size; or damaged: then the memory holds anything.
void restore(const std::filesystem::path& path, const Memory& memory);

/// Whether the memory has the size that it had when the checkpoint was written.
bool fits(const Checkpoint& checkpoint, const Memory& memory);

/// Fills the memory, which must have the sizes that it had when the checkpoint was written. Throws
/// std::runtime_error where it has not, and has then written nothing.
void restore(const Checkpoint& checkpoint, const Memory& memory);

} // namespace tessera
