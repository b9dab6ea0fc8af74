#pragma once

#include <functional>

namespace tessera {

/// Xlib ends the process when the connection to its server breaks, under the threads that still render. Makes that
/// end a quiet one, with a message and the exit code display_lost, where the windows are those of X. To be called
/// once there is a display.
void watch_display();

/// While one lives, a lost display calls `last` first, if it is noticed by the thread that made this one. Calls to
/// Xlib come from the thread that draws, now and then from another that wakes it.
class LastCall {
public:
    explicit LastCall(const std::function<void()>& last);
    ~LastCall();
    LastCall(const LastCall&) = delete;
    LastCall& operator=(const LastCall&) = delete;
};

} // namespace tessera
