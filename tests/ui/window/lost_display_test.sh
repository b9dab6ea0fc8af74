#!/bin/bash
# Ends the viewer while it renders, by killing its display server and by signals. It must exit by itself, report a lost
# display, and store its layout.
#   lost_display_test.sh PATH_OF_TESSERA
set -u
source "$(dirname "$0")/real_window.sh"
need Xvfb
server=
ulimit -c unlimited

start() { # starts a display server, and a viewer that renders on it
    rm -rf "$work/config" "$work/display"
    mkfifo "$work/display"
    Xvfb -displayfd 3 -screen 0 1024x768x24 3>"$work/display" 2>/dev/null &
    server=$!
    read -r number <"$work/display"
    DISPLAY=:$number start_viewer --size 160x90 "$@"
    wait_for '^pane 1 spp ([2-9]|[1-9][0-9]+)$'
}

remembered() { grep -q '"window"' "$work/config/tessera/viewer.json" || fail "the layout is not stored: $1"; }

start
rm "$work/config/tessera/viewer.json" 2>/dev/null # also written when a scene is shown
kill -9 $server
expect_end "no display" 3
grep -q 'display is lost' "$work/errors" || fail "no message of the lost display"
remembered "no display"

for signal in INT TERM; do
    start
    rm "$work/config/tessera/viewer.json" 2>/dev/null
    kill -$signal $viewer
    expect_end $signal 0
    remembered $signal
    kill $server
done

echo 'wait seconds 60' >"$work/steps.txt"
start --script "$work/steps.txt"
kill -TERM $viewer
expect_end "TERM and a script" 130

ls "$work" | grep -q '^core' && fail "a core dump"
echo passed
