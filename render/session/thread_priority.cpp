#include "render/session/thread_priority.h"

#include <algorithm>
#include <cerrno>

#include <sys/resource.h>

namespace tessera {

namespace {

/// Later by so many of the system's steps.
void give_way(int steps) {
    constexpr int last = 19;
    errno = 0;
    const int now = getpriority(PRIO_PROCESS, 0); // on Linux: of the calling thread
    if (errno == 0)
        setpriority(PRIO_PROCESS, 0, std::min(now + steps, last));
}

} // namespace

void work_in_background() {
    give_way(10);
}

void work_behind_others() {
    give_way(15);
}

} // namespace tessera
