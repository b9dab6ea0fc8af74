#include "ui/viewer_state.h"

#include <algorithm>

namespace tessera {

namespace {
constexpr std::size_t most_messages = 500;
} // namespace

glm::ivec2 ViewerState::request_size() const {
    const glm::ivec2 film = scene ? scene->size() : glm::ivec2(16, 9);
    glm::ivec2 smallest = panes.empty() ? glm::ivec2(1) : panes.front().canvas_size;
    for (const PaneState& pane : panes)
        smallest = glm::ivec2(std::min(smallest.x, pane.canvas_size.x), std::min(smallest.y, pane.canvas_size.y));
    return render_size(size, film, smallest);
}

void ViewerState::add_message(Message::Kind kind, std::string text) {
    if (messages.size() >= most_messages)
        messages.erase(messages.begin());
    messages.push_back({kind, std::move(text)});
    show_messages = show_messages || kind == Message::Kind::error;
}

void ViewerState::share_settings() {
    if (!linked)
        return;
    const PaneSettings shared = active().settings;
    for (PaneState& pane : panes) {
        const Method method = pane.settings.render.method;
        pane.settings.render = shared.render;
        pane.settings.render.method = method;
        pane.settings.reconstruction = shared.reconstruction;
    }
}

} // namespace tessera
