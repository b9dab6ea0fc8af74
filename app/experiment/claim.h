// Claims divide work among processes that share a folder, on one machine or on several. A claim is a file that
// only one process can create. The protocol compares no clocks of different hosts and uses no process ids.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <unordered_set>

namespace tessera {

/// Returns the name of this process among all that share a folder: the host's name and eight random hex digits.
const std::string& worker_name();

/// The exclusive right of this process to make a file, for the lifetime of the object. The file FILE.claim beside
/// it holds the owner's name and a counter, the heartbeat, which rises while the process lives.
class Claim {
public:
    /// Removes the claim if the file was not made, so that another process can claim it.
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

    const std::filesystem::path& file() const { return file_; }

    /// Makes the file: appends the text to the claim file, syncs it to disk, and renames it to the file's name.
    /// Throws std::runtime_error that names the file if it cannot be written.
    void finish(const std::string& text);

private:
    friend class Claims;
    Claim(std::filesystem::path file, int generation, int descriptor, double silence);

    std::filesystem::path own_path() const;
    void write_head() const;
    void beat(const std::stop_token& stop) const;
    void write_text(const std::string& text) const;
    void give_back();

    std::filesystem::path file_;
    /// 1 for the first claim on a file. A process that takes over a silent claim creates the next generation, so
    /// that only one process can take over.
    int generation_;
    int descriptor_; ///< of the claim file; stays valid if another process replaces the file of that name
    double silence_;
    bool is_finished_ = false;
    std::jthread heart_;
};

/// The claims that this process makes, and its observations of the claims of other processes.
class Claims {
public:
    /// @param silence  seconds without a heartbeat after which another process may take over a claim of this
    ///                 process; also the limit for claims that do not state their own
    explicit Claims(double silence) : silence_(silence) {}

    /// Claims a file. Returns null if the file exists or another process holds a live claim on it. A claim counts
    /// as live until its heartbeat has not changed for its `silence`, by this process's own clock. Throws
    /// std::runtime_error that names the file if no claim can be created. Claims only save work; correctness does
    /// not depend on them. If two processes hold the same claim, both make the same file.
    std::unique_ptr<Claim> take(const std::filesystem::path& file);

    /// Returns the worker_name() of the file's owner; empty: no claim, or its first line is not written yet.
    static std::string owner_of(const std::filesystem::path& file);

private:
    using Clock = std::chrono::steady_clock;
    struct Sighting {
        std::string head; ///< first line of the claim file, with the heartbeat
        Clock::time_point since;
    };

    bool is_silent(const std::filesystem::path& claim);

    double silence_;
    std::map<std::filesystem::path, Sighting> sightings_;
};

/// Returns FILE for a claim's name "FILE.claim" or "FILE.claim2"; empty for any other name.
std::string claimed_by(const std::string& name);

/// Contents of a folder with claims.
struct Listing {
    std::unordered_set<std::string> files;   ///< names of all files, including claim files
    std::unordered_set<std::string> claimed; ///< names of the files on which there are claims
    std::error_code error; ///< set if the list may be incomplete; not set if the folder does not exist
};
Listing list(const std::filesystem::path& folder);

} // namespace tessera
