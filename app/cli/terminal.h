#pragma once

#include "render/load/scene_source.h"

#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>

namespace tessera {

// Exit codes, errors in user input, interrupts, progress on the terminal, and facts about the machine.

/// Exit code of the process.
enum ExitCode : int { exit_ok = 0, exit_failure = 1, exit_bad_input = 2 };

/// Unusable input from the user: reported in one message, exit code 2.
class BadInput : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// While one exists, the first SIGINT (Ctrl-C) or SIGTERM requests an orderly end. A second signal of either kind
/// ends the process.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Returns whether a signal has arrived since the latest guard was created.
bool interrupted();

/// Shows the progress of a long job on stderr: on a terminal a bar with the remaining time, otherwise a line at
/// each tenth.
class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// @param done    finished fraction, 0 to 1
    /// @param seconds elapsed wall time
    /// @param detail  such as "12 of 64 spp"
    void update(double done, double seconds, const std::string& detail);

private:
    std::string what_;
    bool terminal_;
    bool drawn_ = false;
    int tenths_ = 0;
    double drawn_at_ = -1;
};

/// Shows the progress of loading a scene on stderr if that is a terminal, after 0.3 s. Erases its line at the
/// end.
class LoadBar {
public:
    LoadBar();
    ~LoadBar();
    LoadBar(const LoadBar&) = delete;
    LoadBar& operator=(const LoadBar&) = delete;

    /// Returns the object to which the loader reports.
    LoadProgress& progress() { return progress_; }

private:
    void draw(std::stop_token stop) const;

    LoadProgress progress_;
    std::jthread thread_; // not started without a terminal
};

/// Returns the CPU time of the process, user and system, in seconds.
double process_cpu_seconds();

/// Returns the peak resident memory of the process, in bytes.
double peak_memory_bytes();

/// Returns the system's name of the processor, such as "Intel(R) Xeon(R) CPU @ 2.20GHz"; "unknown" if it has
/// none.
std::string cpu_model();

/// Returns the kind of machine, within which CPU seconds are comparable: "AMD EPYC (2 threads)".
std::string machine_kind();

/// Describes the machine: "AMD EPYC, 2 hardware threads, 8 GB". Memory is in 10^9 bytes and omitted if unknown.
std::string machine_text();

/// Returns the date in UTC, such as "2026-11-22".
std::string today();

/// Returns the version and a checksum of the program file, which distinguishes builds: "0.2.0 5f3a0c11".
const std::string& program_identity();

} // namespace tessera
