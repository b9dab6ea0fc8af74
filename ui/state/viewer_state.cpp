#include "ui/state/viewer_state.h"

#include "render/scene/scene.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr std::size_t most_messages = 2000;

bool has_error(const std::vector<Message>& messages) {
    return std::any_of(messages.begin(), messages.end(),
                       [](const Message& m) { return m.kind == Message::Kind::error; });
}

} // namespace

void SaveWishes::add(SaveKind kind, std::string file) {
    std::optional<std::string>& wish = files_[static_cast<std::size_t>(kind)];
    if (!wish || !file.empty())
        wish = std::move(file);
}

bool SaveWishes::has_any() const {
    return std::ranges::any_of(files_, [](const auto& wish) { return wish.has_value(); });
}

std::optional<std::string> SaveWishes::take(SaveKind kind) {
    return std::exchange(files_[static_cast<std::size_t>(kind)], std::nullopt);
}

glm::ivec2 ViewerState::fitting_size() const {
    const glm::ivec2 film = sensor_size();
    glm::ivec2 smallest = panes.empty() ? glm::ivec2(1) : active().canvas_size;
    for (int i = 0; i < static_cast<int>(panes.size()); ++i) {
        if (is_on_show(i))
            smallest = glm::min(smallest, panes[i].canvas_size);
    }
    return render_size(rendering.size, film, smallest);
}

void ViewerState::inspect(const SampleChoice& sample) {
    set_inspector(true);
    inspector.choose(sample);
}

void ViewerState::inspect(glm::ivec2 pixel, int pass, std::uint64_t seed) {
    active().settings.render.seed = seed;
    share_settings();
    inspect({active().slot, pixel, pass});
}

void ViewerState::add_message(Message::Kind kind, std::string text, Message::Origin origin) {
    if (messages.size() >= most_messages)
        messages.erase(messages.begin());
    messages.push_back({kind, std::move(text), origin});
    wishes.redraw = true;
    if (kind == Message::Kind::error)
        layout.show_messages = wishes.scroll_to_newest = true;
}

void ViewerState::tell(std::string text) {
    layout.toast = {text, 0};
    add_message(Message::Kind::note, std::move(text));
}

void ViewerState::add_invalid(const std::string& whose, const Counters& counters, int slot,
                              const PassOrigin& origin) {
    if (counters.first_invalid.list().empty())
        return;
    add_message(Message::Kind::note, whose + ": " + invalid_text(counters, origin.settings.seed),
                Message::Origin::scene);
    if (origin.scene != scene) // another scene is loaded: the samples would keep the old one in memory
        return;
    const auto kept = std::make_shared<const PassOrigin>(origin);
    for (const InvalidSample& refused : counters.first_invalid.list())
        messages.back().samples.push_back({slot, {refused.x, refused.y}, refused.pass, kept});
}

void ViewerState::drop_messages(Message::Origin origin) {
    const bool errors_before = has_error(messages);
    std::erase_if(messages, [&](const Message& m) { return m.origin == origin; });
    if (errors_before && !has_error(messages))
        layout.show_messages = false;
}

} // namespace tessera
