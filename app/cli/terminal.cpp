#include "app/cli/terminal.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <initializer_list>
#include <mutex>

#include <fmt/core.h>
#include <unistd.h>

namespace tessera {

namespace {

std::atomic<bool> seen = false;

void reset() {
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard() {
    seen = false;
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int) {
            seen = true;
            reset(); // of either kind, the second one ends the process
        });
}

InterruptGuard::~InterruptGuard() {
    reset();
}

bool interrupted() {
    return seen;
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

} // namespace tessera
