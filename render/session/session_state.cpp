#include "render/session/session_state.h"

#include "recon/picture/oidn.h"
#include "render/io/available_memory.h"

#include <exception>
#include <utility>

#include <fmt/core.h>

namespace tessera {

const SessionPane& SessionState::rendering(int pane) const {
    const int followed = panes[pane]->followed;
    return *panes[followed < 0 ? pane : followed];
}

void SessionState::tell() {
    try {
        if (on_publish)
            on_publish();
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex);
        messages.push_back(fmt::format("the newest picture is not shown: {}", message_of(error)));
    }
}

void SessionState::report(std::string message) {
    {
        const std::lock_guard lock(mutex);
        messages.push_back(std::move(message));
    }
    tell();
}

ReconstructionSettings SessionState::possible_reconstruction(SessionPane& pane) {
    ReconstructionSettings settings;
    {
        const std::lock_guard lock(mutex);
        settings = pane.reconstruction.settings;
    }
    const Norm norm = possible(settings.norm);
    if (norm == settings.norm)
        return settings;
    {
        const std::lock_guard lock(mutex);
        if (pane.reconstruction.settings == settings) { // not changed in between
            pane.reconstruction.settings.norm = norm;
            messages.push_back(oidn_problem() + "; guided is used instead");
        }
    }
    settings.norm = norm;
    return settings;
}

} // namespace tessera
