#pragma once

namespace tessera {

/// CPU time of the whole process, user and system, in seconds (getrusage).
double process_cpu_seconds();

/// The largest resident memory so far, in bytes.
double peak_memory_bytes();

} // namespace tessera
