#include "ui/viewer_state.h"

#include <algorithm>

namespace tessera {

namespace {
constexpr std::size_t most_messages = 2000;

bool has_error(const std::vector<Message>& messages) {
    return std::any_of(messages.begin(), messages.end(),
                       [](const Message& m) { return m.kind == Message::Kind::error; });
}

} // namespace

glm::ivec2 ViewerState::request_size() const {
    const glm::ivec2 film = scene ? scene->size() : glm::ivec2(16, 9);
    glm::ivec2 smallest = panes.empty() ? glm::ivec2(1) : panes.front().canvas_size;
    for (const PaneState& pane : panes)
        smallest = glm::ivec2(std::min(smallest.x, pane.canvas_size.x), std::min(smallest.y, pane.canvas_size.y));
    return render_size(size, film, smallest);
}

void ViewerState::add_message(Message::Kind kind, std::string text, Message::Origin origin) {
    if (messages.size() >= most_messages)
        messages.erase(messages.begin());
    messages.push_back({kind, std::move(text), origin});
    if (kind == Message::Kind::error)
        show_messages = scroll_to_newest = true;
}

void ViewerState::drop_messages(Message::Origin origin) {
    const bool errors_before = has_error(messages);
    std::erase_if(messages, [&](const Message& m) { return m.origin == origin; });
    if (errors_before && !has_error(messages))
        show_messages = false;
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
