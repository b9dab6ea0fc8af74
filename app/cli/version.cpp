#include "app/cli/version.h"

namespace tessera {

std::string version_text() {
    const std::string commit = TESSERA_COMMIT;
    return TESSERA_VERSION + (commit.empty() ? "" : " (commit " + commit + ")");
}

} // namespace tessera
