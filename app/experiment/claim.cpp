#include "app/experiment/claim.h"

#include "render/io/files.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <ios>
#include <mutex>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

namespace tessera {

namespace {

namespace fs = std::filesystem;

constexpr const char* claim_suffix = ".claim";
constexpr int beats_a_silence = 6; // tolerates late or lost heartbeats

fs::path claim_path(const fs::path& file, int generation) {
    return file.string() + claim_suffix + (generation > 1 ? std::to_string(generation) : "");
}

/// Returns a claim's first line. Its length is constant, since it is overwritten while others read it.
std::string head_text(std::uint32_t beat, double silence) {
    return fmt::format("{{\"worker\":\"{}\",\"silence\":{:g},\"beat\":\"{:010}\"}}\n", worker_name(), silence,
                       beat);
}

/// Returns the first line of a claim; empty: the file does not exist or is empty.
std::string head_of(const fs::path& claim) {
    std::string line;
    std::getline(std::ifstream(claim, std::ios::binary), line);
    return line;
}

[[noreturn]] void fail(const fs::path& file, int error) {
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(error)));
}

/// Creates a file; -1: it exists. O_EXCL is atomic on NFS since version 3.
int create(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST)
        fail(path, errno);
    return descriptor;
}

/// Returns the generation of the newest claim on the file; 0: there is none.
int newest_generation(const fs::path& file) {
    int generation = 0;
    while (fs::exists(claim_path(file, generation + 1)))
        ++generation;
    return generation;
}

} // namespace

const std::string& worker_name() {
    static const std::string name = [] {
        std::array<char, 65> host{};
        ::gethostname(host.data(), host.size() - 1);
        std::string letters = host.data();
        std::erase_if(letters, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '-'; });
        return fmt::format("{}-{:08x}", letters, std::random_device()());
    }();
    return name;
}

Claim::Claim(fs::path file, int generation, int descriptor, double silence)
    : file_(std::move(file)), generation_(generation), descriptor_(descriptor), silence_(silence) {
    write_head();
    heart_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
}

Claim::~Claim() {
    heart_ = {};
    if (!is_finished_)
        give_back();
    ::close(descriptor_);
}

fs::path Claim::own_path() const {
    return claim_path(file_, generation_);
}

/// Writes the next heartbeat. The counter is shared by all claims of a process, so that a new claim on the same
/// file differs from a silent one. Ignores errors (disk full, server away): the next heartbeat may succeed.
void Claim::write_head() const {
    static std::atomic<std::uint32_t> beat = 0;
    const std::string head = head_text(++beat, silence_);
    [[maybe_unused]] const ssize_t n = ::pwrite(descriptor_, head.data(), head.size(), 0);
}

void Claim::beat(const std::stop_token& stop) const {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    const std::chrono::duration<double> pause(silence_ / beats_a_silence);
    while (!never.wait_for(lock, stop, pause, [] { return false; }) && !stop.stop_requested()) {
        write_head();
        ::fdatasync(descriptor_); // a network file system may delay the write by half a minute
    }
}

void Claim::write_text(const std::string& text) const {
    std::size_t done = 0;
    for (const std::size_t begin = head_text(0, silence_).size(); done < text.size();) {
        const ssize_t n =
            ::pwrite(descriptor_, text.data() + done, text.size() - done, static_cast<off_t>(begin + done));
        if (n <= 0)
            fail(file_, n < 0 ? errno : ENOSPC);
        done += static_cast<std::size_t>(n);
    }
    if (::fsync(descriptor_) != 0)
        fail(file_, errno);
}

void Claim::finish(const std::string& text) {
    heart_ = {};
    write_head(); // an earlier one may have failed on a full disk
    write_text(text);
    const fs::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
    std::error_code error;
    fs::rename(own_path(), file_, error);
    if (error && !fs::exists(file_)) // if it exists, a process that took over has finished first
        fail(file_, error.value());
    is_finished_ = true;
    sync_folder(folder);
    for (int older = 1; older < generation_; ++older)
        fs::remove(claim_path(file_, older), error);
}

/// Removes all generations of the claim, the newest last: while it exists, nobody can claim an older one.
void Claim::give_back() {
    struct stat mine{}, there{};
    if (::fstat(descriptor_, &mine) != 0 || ::stat(own_path().c_str(), &there) != 0 ||
        mine.st_ino != there.st_ino || fs::exists(claim_path(file_, generation_ + 1)))
        return;
    std::error_code ignored;
    for (int generation = 1; generation <= generation_; ++generation)
        fs::remove(claim_path(file_, generation), ignored);
}

std::unique_ptr<Claim> Claims::take(const fs::path& file) {
    int generation = 1;
    int descriptor = create(claim_path(file, generation));
    if (descriptor < 0) {
        generation = newest_generation(file);
        if (generation > 0 && !is_silent(claim_path(file, generation)))
            return {};
        descriptor = create(claim_path(file, ++generation));
        if (descriptor < 0)
            return {};
    }
    std::unique_ptr<Claim> claim(new Claim(file, generation, descriptor, silence_));
    sightings_.erase(claim_path(file, generation - 1));
    if (fs::exists(file)) // finished since, by a process that then removed its claim
        return {};
    return claim;
}

std::string Claims::owner_of(const fs::path& file) {
    const int generation = newest_generation(file);
    const nlohmann::json head = generation > 0 ? parse_json(head_of(claim_path(file, generation))) : nullptr;
    return head.is_object() ? head.value("worker", "") : "";
}

bool Claims::is_silent(const fs::path& claim) {
    const std::string head = head_of(claim);
    const Clock::time_point now = Clock::now();
    Sighting& seen = sightings_.try_emplace(claim, Sighting{head, now}).first->second;
    if (seen.head != head) {
        seen = {head, now};
        return false;
    }
    const nlohmann::json said = parse_json(head);
    const bool says_how_long = said.is_object() && said.contains("silence") && said["silence"].is_number();
    const double silence = says_how_long ? said["silence"].get<double>() : silence_;
    return std::chrono::duration<double>(now - seen.since).count() > silence;
}

std::string claimed_by(const std::string& name) {
    const std::size_t end = name.rfind(claim_suffix);
    if (end == name.npos)
        return "";
    const std::string generation = name.substr(end + std::strlen(claim_suffix));
    const bool is_number = std::all_of(generation.begin(), generation.end(),
                                       [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
    return is_number ? name.substr(0, end) : "";
}

Listing list(const fs::path& folder) {
    Listing listing;
    fs::directory_iterator it(folder, listing.error);
    for (; !listing.error && it != fs::directory_iterator(); it.increment(listing.error)) {
        const std::string name = it->path().filename().string();
        listing.files.insert(name);
        if (const std::string file = claimed_by(name); !file.empty())
            listing.claimed.insert(file);
    }
    if (listing.error == std::errc::no_such_file_or_directory)
        listing.error.clear();
    return listing;
}

} // namespace tessera
