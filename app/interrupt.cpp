#include "app/interrupt.h"

#include <atomic>
#include <csignal>

namespace tessera {

namespace {

std::atomic<bool> seen = false;

} // namespace

InterruptGuard::InterruptGuard() {
    seen = false;
    std::signal(SIGINT, [](int) {
        seen = true;
        std::signal(SIGINT, SIG_DFL);
    });
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
}

bool interrupted() {
    return seen;
}

} // namespace tessera
