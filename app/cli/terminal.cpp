#include "app/cli/terminal.h"

#include "render/io/memory.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tessera {

namespace {

std::atomic<bool> signal_seen = false;

void restore_handlers() {
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard() {
    signal_seen = false;
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int) {
            signal_seen = true;
            restore_handlers(); // a second signal ends the process
        });
}

InterruptGuard::~InterruptGuard() {
    restore_handlers();
}

bool interrupted() {
    return signal_seen;
}

Progress::Progress(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (drawn_)
        fmt::print(stderr, "\n");
}

void Progress::update(double done, double seconds, const std::string& detail) {
    done = std::clamp(done, 0.0, 1.0);
    const std::string left = done > 0 && done < 1 ? fmt::format(", {:.0f} s left", seconds / done - seconds) : "";
    if (!terminal_) {
        const int tenths = static_cast<int>(done * 10);
        if (tenths == tenths_)
            return;
        tenths_ = tenths;
        fmt::print(stderr, "{}: {:3.0f} %, {}{}\n", what_, 100 * done, detail, left);
        return;
    }
    if (drawn_ && done < 1 && seconds - drawn_at_ < 0.1)
        return;
    constexpr int width = 30;
    const int filled = static_cast<int>(done * width);
    fmt::print(stderr, "\r{} [{:#>{}}{:.>{}}] {:3.0f} %, {}{}   ", what_, "", filled, "", width - filled,
               100 * done, detail, left);
    std::fflush(stderr);
    drawn_ = true;
    drawn_at_ = seconds;
}

LoadBar::LoadBar() {
    if (isatty(STDERR_FILENO))
        thread_ = std::jthread([this](std::stop_token stop) { draw(std::move(stop)); });
}

LoadBar::~LoadBar() = default;

void LoadBar::draw(std::stop_token stop) const {
    std::mutex mutex;
    std::condition_variable_any ended;
    std::unique_lock lock(mutex);
    const auto pause = [&](int ms) {
        ended.wait_for(lock, stop, std::chrono::milliseconds(ms), [] { return false; });
        return !stop.stop_requested();
    };
    if (!pause(300))
        return;
    do {
        fmt::print(stderr, "\rloading: {} ...\033[K", to_string(progress_.state()));
        std::fflush(stderr);
    } while (pause(100));
    fmt::print(stderr, "\r\033[K");
}

namespace {

double seconds(timeval t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

rusage usage() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    return u;
}

} // namespace

double process_cpu_seconds() {
    const rusage u = usage();
    return seconds(u.ru_utime) + seconds(u.ru_stime);
}

double peak_memory_bytes() {
    return 1024.0 * static_cast<double>(usage().ru_maxrss);
}

std::string cpu_model() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const std::size_t colon = line.find(": "); line.rfind("model name", 0) == 0 && colon != line.npos)
            return line.substr(colon + 2);
    return "unknown";
}

std::string machine_kind() {
    return fmt::format("{} ({} threads)", cpu_model(), std::thread::hardware_concurrency());
}

std::string machine_text() {
    std::string text = fmt::format("{}, {} hardware threads", cpu_model(), std::thread::hardware_concurrency());
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (pages > 0 && page > 0)
        text += fmt::format(", {:.0f} GB", static_cast<double>(pages) * static_cast<double>(page) * 1e-9);
    return text;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday);
}

const std::string& program_identity() {
    static const std::string identity = [] {
        std::ifstream in("/proc/self/exe", std::ios::binary);
        const std::string program{std::istreambuf_iterator<char>(in), {}};
        return fmt::format("{} {:08x}", TESSERA_VERSION,
                           checksum(std::as_bytes(std::span(program.data(), program.size()))));
    }();
    return identity;
}

} // namespace tessera
