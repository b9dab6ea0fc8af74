#include "app/interrupt.h"

#include <atomic>
#include <csignal>

namespace tessera {

namespace {

std::atomic<bool> seen = false;

} // namespace

InterruptGuard::InterruptGuard() {
    seen = false;
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int again) {
            seen = true;
            std::signal(again, SIG_DFL);
        });
}

InterruptGuard::~InterruptGuard() {
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, SIG_DFL);
}

bool interrupted() {
    return seen;
}

} // namespace tessera
