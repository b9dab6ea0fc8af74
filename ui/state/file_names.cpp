#include "ui/state/file_names.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <set>
#include <system_error>
#include <tuple>

namespace tessera {

std::filesystem::path unused_name(const std::filesystem::path& stem, const std::string& ending,
                                  const std::function<bool(const std::filesystem::path&)>& is_taken) {
    std::error_code ignored; // an unreadable folder causes an error when the file is written
    const auto exists = [&](const std::filesystem::path& file) { // includes dangling links
        return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
    };
    std::filesystem::path file = stem.string() + ending;
    for (int n = 2; (is_taken && is_taken(file)) || exists(file); ++n)
        file = stem.string() + "-" + std::to_string(n) + ending;
    return file;
}

std::filesystem::path dated_file(const std::string& ending, const std::filesystem::path& wanted) {
    static std::set<std::filesystem::path> returned;
    const std::time_t now = std::time(nullptr);
    char stem[32];
    std::strftime(stem, sizeof stem, "tessera-%Y%m%d-%H%M%S", std::localtime(&now));
    std::error_code ignored; // a deleted current folder causes an error when the file is written
    const std::filesystem::path folder = wanted.empty() ? std::filesystem::current_path(ignored) : wanted;
    const auto is_returned = [](const std::filesystem::path& file) { return returned.contains(file); };
    return *returned.insert(unused_name(folder / stem, ending, is_returned)).first;
}

namespace {

namespace fs = std::filesystem;

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool is_same_letter(char a, char b) {
    return lower(a) == lower(b);
}

bool is_same_text(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same_letter);
}

} // namespace

bool has_extension(const fs::path& file, std::string_view extension) {
    return is_same_text(file.extension().string(), extension);
}

std::vector<FileEntry> list_folder(const fs::path& folder, std::string_view extension, std::string& error) {
    std::vector<FileEntry> entries;
    std::error_code code, ignored;
    fs::directory_iterator it(folder, code);
    for (; !code && it != fs::directory_iterator(); it.increment(code)) {
        const bool is_folder = it->is_directory(ignored);
        if (is_folder || has_extension(it->path(), extension))
            entries.push_back({it->path().filename().string(), is_folder});
    }
    error = code ? folder.string() + ": " + code.message() : "";
    std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
        return std::tuple(!a.is_folder, a.name) < std::tuple(!b.is_folder, b.name);
    });
    return entries;
}

TypedPath typed_path(const std::string& whole) {
    std::error_code ignored; // a deleted current folder has no name
    // An absolute path after a folder ("/tmp//home/x.xml", "/tmp/~/x.xml") replaces the folder.
    const std::size_t start = std::max(whole.rfind("//") + 1, whole.rfind("/~/") + 1);
    const std::string text = whole.substr(start);
    const std::size_t slash = text.rfind('/');
    if (slash == std::string::npos)
        return {fs::current_path(ignored), text};
    fs::path folder = text.substr(0, slash + 1);
    const char* home = std::getenv("HOME");
    if (home && text.rfind("~/", 0) == 0)
        folder = fs::path(home) / text.substr(2, slash - 1);
    return {fs::absolute(folder, ignored).lexically_normal(), text.substr(slash + 1)};
}

fs::path typed_file(const std::string& text) {
    const TypedPath typed = typed_path(text);
    return typed.folder / typed.beginning;
}

std::vector<FileEntry> beginning_with(const std::vector<FileEntry>& entries, const std::string& beginning) {
    std::vector<FileEntry> found;
    std::copy_if(entries.begin(), entries.end(), std::back_inserter(found), [&](const FileEntry& entry) {
        const bool is_hidden = entry.name[0] == '.' && (beginning.empty() || beginning[0] != '.');
        return !is_hidden && is_same_text(std::string_view(entry.name).substr(0, beginning.size()), beginning);
    });
    return found;
}

std::string common_beginning(const std::vector<FileEntry>& entries) {
    if (entries.empty())
        return "";
    std::string common = entries.front().name;
    for (const FileEntry& entry : entries) {
        const auto end = std::mismatch(common.begin(), common.end(), entry.name.begin(), entry.name.end()).first;
        common.erase(end, common.end());
    }
    return entries.size() == 1 && entries.front().is_folder ? common + "/" : common;
}

std::string short_path(const std::string& file) {
    std::error_code error; // the current folder may be deleted
    const fs::path path = fs::path(file).lexically_relative(fs::current_path(error));
    return error || path.empty() || *path.begin() == ".." ? file : path.string();
}

} // namespace tessera
