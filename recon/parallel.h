#pragma once

#include <functional>

namespace tessera {

/// Runs body(i) for every i in [0, count), in any order and on any threads; returns when all are done.
/// The result must not depend on the order: whoever passes one in decides on the threads.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;

/// The ParallelFor of the calling thread alone.
inline void serial_for(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i)
        body(i);
}

} // namespace tessera
