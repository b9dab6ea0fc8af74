#include "app/journal.h"

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
            entries_[line["key"].dump()] = line["value"].dump();
    }
    append(file_, begin < text.size() ? "\n" : ""); // the torn line ends here
}

json Journal::find(const json& key) const {
    const auto found = entries_.find(key.dump());
    return found == entries_.end() ? json() : json::parse(found->second);
}

void Journal::record(const json& key, const json& value) {
    append(file_,
           json{{"key", key}, {"value", value}}.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
    entries_[key.dump()] = value.dump();
}

} // namespace tessera
