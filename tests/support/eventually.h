#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace tessera::test {

/// Waits until it holds, for up to two minutes: other tests run beside, on machines that others use as well.
inline bool eventually(const std::function<bool()>& holds) {
    using namespace std::chrono;
    for (const auto end = steady_clock::now() + minutes(2); steady_clock::now() < end;) {
        if (holds())
            return true;
        std::this_thread::sleep_for(milliseconds(5));
    }
    return false;
}

} // namespace tessera::test
