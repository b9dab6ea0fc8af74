#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// Keys that the viewer knows. Letters and digits follow each other.
// clang-format off
enum class Key : std::uint8_t {
    none,
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    digit0, digit1, digit2, digit3, digit4, digit5, digit6, digit7, digit8, digit9,
    left, right, up, down, home, space, tab, escape, shift,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,
    count
};
// clang-format on

/// The letter's or digit's key (either case); Key::none for others.
Key key_of_character(char character);

/// What a key is called: by the letter or digit printed on it, which the system tells in UTF-8 (null: it does not
/// know), else by its place on an American keyboard. With Alt of either side, no key is meant: on many keyboards
/// that one makes brackets of digits.
Key key_named(const char* printed, Key place, bool alt);

/// What calls an action: a key with its modifiers, or a character however the keyboard makes it ('?'). What was
/// typed may be both: a key, and the character that it has made.
struct Shortcut {
    Key key = Key::none;
    bool ctrl = false;
    bool shift = false;
    char character = 0;

    bool operator==(const Shortcut&) const = default;
};

/// "Ctrl+Q", "F1", "?", "Space".
std::string to_string(const Shortcut& shortcut);

/// The shortcut of that name; also "Up" or "Ctrl+Shift+K", and a character that is neither letter nor digit.
/// Nothing: there is none.
std::optional<Shortcut> shortcut_named(const std::string& name);

/// What was typed since the last frame, and what is held. Own bookkeeping, not Dear ImGui's: its older versions
/// lose a key that goes down and up between two frames, which happens when the processors are busy.
class Keyboard {
public:
    /// A key went down. `physical` is the place on an American keyboard, `named` what is printed on it.
    void press(Key physical, Key named, bool ctrl, bool shift);
    void release(Key physical);
    /// A character came, that of the key which went down just before, if one did.
    void type(char character);
    void release_all() { down_.reset(); }

    /// Held now. By place, so that W A S D lie alike on all keyboards.
    bool is_down(Key physical) const { return down_[static_cast<std::size_t>(physical)]; }

    /// What was pressed and typed since the last take, in order.
    std::vector<Shortcut> take();

private:
    std::bitset<static_cast<std::size_t>(Key::count)> down_;
    std::vector<Shortcut> typed_;
    bool awaits_character_ = false; // the last of these may have made one
};

} // namespace tessera
