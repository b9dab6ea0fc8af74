#pragma once

#include <string>

namespace tessera {

/// CPU time of the whole process, user and system, in seconds (getrusage).
double process_cpu_seconds();

/// The largest resident memory so far, in bytes.
double peak_memory_bytes();

/// "Intel(R) Xeon(R) CPU @ 2.20GHz": what the system calls its processor; "unknown" where it does not say.
std::string cpu_model();

/// "AMD EPYC, 2 hardware threads, 8 GB": that, and what there is of it, memory in 10^9 bytes (left out where the
/// system does not say).
std::string machine_text();

/// "2026-11-22", in UTC.
std::string today();

/// "0.1.0 5f3a0c11": the program's version, and a checksum of its file, so that two builds are told apart.
const std::string& program_identity();

} // namespace tessera
