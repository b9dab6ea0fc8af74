#include "app/process_usage.h"

#include <sys/resource.h>

namespace tessera {

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

} // namespace tessera
