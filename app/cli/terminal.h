#pragma once

#include "render/load/scene_source.h"

#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>

namespace tessera {

// What the program and whoever started it tell each other: exit codes, bad input, interrupts and progress.

/// What the process returns to the shell.
enum ExitCode : int { exit_ok = 0, exit_failure = 1, exit_bad_input = 2 };

/// Something that the user gave cannot be used: reported in one message, exit code 2.
class BadInput : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// While one lives, Ctrl-C (SIGINT) or SIGTERM ask for an end in good order; a second one, of either
/// kind, ends the process.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Whether the latest guard has seen either.
bool interrupted();

/// Tells on standard error how far a long job is: a bar with the time left on a terminal, else a plain line at
/// each tenth.
class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// @param done    share of the work done, 0 to 1
    /// @param seconds wall time it took
    /// @param detail  such as "12 of 64 spp"
    void update(double done, double seconds, const std::string& detail);

private:
    std::string what_;
    bool terminal_;
    bool drawn_ = false;
    int tenths_ = 0;
    double drawn_at_ = -1;
};

/// Tells on standard error, where that is a terminal, how far a scene is loaded, once that has taken a moment.
/// Leaves no trace when it ends.
class LoadBar {
public:
    LoadBar();
    ~LoadBar();
    LoadBar(const LoadBar&) = delete;
    LoadBar& operator=(const LoadBar&) = delete;

    /// What the loader writes to.
    LoadProgress& progress() { return progress_; }

private:
    void draw(std::stop_token stop) const;

    LoadProgress progress_;
    std::jthread thread_; // not where there is no terminal
};

/// CPU time of the whole process, user and system, in seconds (getrusage).
double process_cpu_seconds();

/// The largest resident memory so far, in bytes.
double peak_memory_bytes();

/// What the system calls its processor, such as "Intel(R) Xeon(R) CPU @ 2.20GHz"; "unknown" where it does not say.
std::string cpu_model();

/// Machines of which CPU seconds can be compared: processor and hardware threads, "AMD EPYC (2 threads)".
std::string machine_kind();

/// The processor and what there is of it, "AMD EPYC, 2 hardware threads, 8 GB": memory in 10^9 bytes (left out
/// where the system does not say).
std::string machine_text();

/// The date in UTC, such as "2026-11-22".
std::string today();

/// The program's version and a checksum of its file, so that two builds are told apart: "0.1.0 5f3a0c11".
const std::string& program_identity();

} // namespace tessera
