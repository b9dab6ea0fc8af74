#include "ui/gl/gui.h"
#include "ui/state/actions.h"
#include "ui/viewer/viewer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

constexpr float longest_step = 0.1f; // maximum camera motion of a held key per frame, seconds

/// Whether a list of choices, a menu or a modal dialog is open.
bool has_open_list() {
    return ImGui::IsPopupOpen(static_cast<const char*>(nullptr), ImGuiPopupFlags_AnyPopup);
}

/// Moves the selection of the open drop-down list or menu by typed arrow keys. Enter accepts it and Escape closes
/// the list.
void step_in_list(const std::vector<Shortcut>& typed) {
    constexpr std::pair<Key, ListStep> steps[] = {{Key::left, ListStep::left},  {Key::right, ListStep::right},
                                                  {Key::up, ListStep::up},      {Key::down, ListStep::down},
                                                  {Key::enter, ListStep::take}, {Key::escape, ListStep::close}};
    for (const Shortcut& shortcut : typed)
        for (const auto& [key, step] : steps)
            if (shortcut == Shortcut{key})
                send_list_step(step);
}

/// Moves the command palette's selection by typed arrow keys, and accepts it by Enter.
void steer_palette(const std::vector<Shortcut>& typed, Layout& layout) {
    for (const Shortcut& shortcut : typed) {
        layout.palette_steps += (shortcut == Shortcut{Key::down}) - (shortcut == Shortcut{Key::up});
        layout.palette_takes = layout.palette_takes || shortcut == Shortcut{Key::enter};
    }
}

} // namespace

void Viewer::read_keyboard() {
    const ImGuiIO& io = ImGui::GetIO();
    std::vector<Shortcut> typed = keyboard_.take();
    // A list, a menu or a dialog blocks all shortcuts except Ctrl+Q, and Esc in the file dialog.
    const bool in_list = has_open_list() && !state_.layout.choosing;
    if (in_list)
        step_in_list(typed);
    if (in_list || state_.layout.choosing)
        std::erase_if(typed, [&](const Shortcut& s) {
            return s != Shortcut{Key::q, true} && (in_list || s != Shortcut{Key::escape});
        });
    state_.wishes.redraw |= list_steps_pending();
    if (state_.layout.show_palette)
        steer_palette(typed, state_.layout);
    const bool is_typing = io.WantTextInput || state_.layout.show_palette;
    run_shortcuts(typed, is_typing, state_);
    const bool is_blocked = is_typing || in_list || state_.layout.choosing;
    state_.layout.flicker = !is_blocked && keyboard_.is_down(Key::b);
    flying_ = !is_blocked && fly_with_keys(keyboard_, std::min(io.DeltaTime, longest_step), state_);
}

} // namespace tessera
