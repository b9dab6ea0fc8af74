#include "app/journal.h"

#include "render/load/json_text.h"
#include "render/load/temporary_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera {

namespace {

using nlohmann::json;

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Adds to the file's end; on the disk when this returns.
void append(const std::filesystem::path& file, const std::string& text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const bool written = descriptor >= 0 &&
                         ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                         ::fsync(descriptor) == 0;
    const std::string reason = std::strerror(errno);
    if (descriptor >= 0)
        ::close(descriptor);
    if (!written)
        throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

} // namespace

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
    const std::string text = text_of(file_);
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        const json line = json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                      text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        if (line.is_object() && line.contains("key") && line.contains("value"))
            entries_[to_text(line["key"])] = to_text(line["value"]);
    }
    append(file_, begin < text.size() ? "\n" : "");                            // the torn line ends here
    write_through_folder(file_.has_parent_path() ? file_.parent_path() : "."); // in which it may be new
}

json Journal::find(const json& key) const {
    const auto found = entries_.find(to_text(key));
    return found == entries_.end() ? json() : json::parse(found->second);
}

void Journal::record(const json& key, const json& value) {
    append(file_, to_text(json{{"key", key}, {"value", value}}) + "\n");
    entries_[to_text(key)] = to_text(value);
}

} // namespace tessera
