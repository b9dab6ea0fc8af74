// How processes that share a folder, on one machine or on many, divide work among them: by files that only one of
// them can make. No clock of one host is compared with that of another, and no process is asked for by its number.
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

/// This process among all that share a folder: its host's name and eight digits by chance.
const std::string& worker_name();

/// A file that this process alone is to make, for as long as this lives. Beside it, under the name
/// FILE.claim, stands who makes it, and a count that rises while it is alive.
class Claim {
public:
    /// Gives the file back, if it was not made: another may claim it.
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

    const std::filesystem::path& file() const { return file_; }

    /// Makes the file: the claim, with the text as its further lines, takes the file's name once it is on the
    /// disk. Throws std::runtime_error that names the file where it cannot be written.
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
    int generation_; ///< 1; each that takes over from one that is silent has the next, so that only one of them
                     ///< can
    int descriptor_; ///< of the claim; it stays that of this very file, whoever takes its name
    double silence_;
    bool is_finished_ = false;
    std::jthread heart_;
};

/// What a process knows of the claims of all.
class Claims {
public:
    /// @param silence  seconds without a sign of life after which others may take over what this process has
    ///                 claimed, and it what others have that do not say how long
    explicit Claims(double silence) : silence_(silence) {}

    /// Claims a file. Empty: it is there, or another process makes it, which is believed to live until its claim
    /// has been the same for so long on this process's own clock. Throws std::runtime_error that names the file
    /// where no claim can be made.
    /// Claims spare work; that nothing is lost or counted twice does not rest on them: two that believe to have
    /// the same claim make the same file.
    std::unique_ptr<Claim> take(const std::filesystem::path& file);

    /// Who has claimed the file, as worker_name() has it; empty: nobody, or it cannot be told yet.
    static std::string owner_of(const std::filesystem::path& file);

private:
    using Clock = std::chrono::steady_clock;
    struct Sighting {
        std::string head; ///< of the claim
        Clock::time_point since;
    };

    bool is_silent(const std::filesystem::path& claim);

    double silence_;
    std::map<std::filesystem::path, Sighting> sightings_;
};

/// FILE of "FILE.claim" and "FILE.claim2": what is claimed by it; empty: it is no claim's name.
std::string claimed_by(const std::string& name);

/// What a folder of files that are claimed holds.
struct Listing {
    std::unordered_set<std::string> files;   ///< the names of all, claims too
    std::unordered_set<std::string> claimed; ///< of claims, the names of what is claimed
    std::error_code error;                   ///< why the names may not be all; a folder that is not there has none
};
Listing list(const std::filesystem::path& folder);

} // namespace tessera
