#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// What is finished of a long job, in a file of one line for each piece: whatever ends the program, what was
/// recorded is there the next time. A last line that was torn, and lines that are not the journal's, do not count.
class Journal {
public:
    /// Reads the file, or begins one. Throws std::runtime_error that names it where it cannot be written.
    explicit Journal(std::filesystem::path file);

    /// What was last recorded under this key, which says all that it depends on; null: nothing was.
    nlohmann::json find(const nlohmann::json& key) const;
    /// Is on the disk when this returns. Throws std::runtime_error that names the file.
    void record(const nlohmann::json& key, const nlohmann::json& value);

private:
    std::filesystem::path file_;
    std::unordered_map<std::string, std::string> entries_; // values by their keys, both as text
};

} // namespace tessera
