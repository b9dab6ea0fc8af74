#include "render/session/thread_priority.h"

#include <algorithm>
#include <cerrno>

#include <sys/resource.h>

namespace tessera {

void work_in_background() {
    constexpr int steps = 10, last = 19;
    errno = 0;
    const int now = getpriority(PRIO_PROCESS, 0); // on Linux: of the calling thread
    if (errno == 0)
        setpriority(PRIO_PROCESS, 0, std::min(now + steps, last));
}

} // namespace tessera
