#!/bin/bash
# Tests the files that the real viewer reads, under a virtual display: scenes that change and break, scripts,
# and files that cannot be read or written.
#   window_files_test.sh PATH_OF_TESSERA [FOLDER_FOR_PICTURES]
set -u

source "$(dirname "$0")/virtual_display.sh"
assets=$(realpath "$(dirname "$0")/../../../assets")
source "$(dirname "$0")/real_window.sh"
need xdotool import convert

# --- a scene file: reloaded, broken and repaired; it names the window and the saved camera ---

scene=$work/box.xml
cp "$assets/cornell-box.xml" "$scene"
start_viewer "$scene"
wait_for '^scenes shown 1$'
wait_for '^time picture '
xdotool search --name "^Tessera - $scene\$" >/dev/null || fail "the window is not named after the scene"
xdotool mousemove 300 300
from=$(next_line)
xdotool keydown w sleep 0.3 keyup w
wait_for '^camera ' "$from"
sleep 0.3
from=$(next_line)
press F5 '^scenes shown 2$'
wait_for '^pane 1 generation ' "$from"
tail -n "+$from" "$log" | grep -q '^camera ' && fail "the camera has moved by itself"
sed -i 's/<scene/<scone/' "$scene"
press F5 '^messages 1$'
look broken
sed -i 's/<scone/<scene/' "$scene"
from=$(next_line)
press F5 '^scenes shown 3$'
wait_for '^messages 0$' "$from"

# --- files dropped on the window: a reference, a scene with a blank in its name, and another type of file ---

drop() { "$(dirname "$assets")/tests/ui/window/drop_files.py" "$window" "$@" || fail "cannot be dropped: $*"; }
window=$(xdotool search --name "^Tessera - $scene\$")
"$tessera" render "$scene" --size 64x48 --spp 4 -o "$work/reference.exr" >"$work/made" 2>&1 || fail "$(cat "$work/made")"
from=$(next_line)
drop "$work/reference.exr"
wait_for '^reference reference.exr$' "$from"
cp "$assets/cornell-box.xml" "$work/an other.xml"
drop "$work/an other.xml"
wait_for '^scenes shown 4$' "$from"
xdotool search --name "^Tessera - $work/an other.xml\$" >/dev/null || fail "another scene is open"
from=$(next_line)
drop "$work/made"
wait_for '^messages ' "$from"
drop "$scene"
wait_for '^scenes shown 5$' "$from"
press k '^messages '
grep -q to_world "$work/box-camera.json" || fail "no camera was saved"
xdotool key ctrl+q
expect_end "ctrl+q" 0

# --- screenshots, in a window and without a display ---

"$tessera" view --screenshot "$work/own.png" --spp 4 || fail "no screenshot"
more_than "$(brightness "$work/own.png")" 0.05 || fail "the screenshot is black"
timeout 120 "$tessera" view --screenshot "$work/usual.png" --size 64x48 || fail "without --spp a screenshot has no end"
env -u DISPLAY "$tessera" view --screenshot "$work/none.png" --spp 2 || fail "no screenshot without a display"
more_than "$(brightness "$work/none.png")" 0.05 || fail "the screenshot without a display is black"
keep "$work/own.png"
keep "$work/none.png"

# --- scripts, in a window and without a display ---

cat >"$work/steps.txt" <<EOF
wait scene
set panes 4
wait spp 2
click pane0.picture
key V
drag pane0.picture@0.5,0.5 pane0.picture@0.2,0.5
frames 5 "four panes"
screenshot "$work/script.png"
quit
EOF
"$tessera" view --script "$work/steps.txt" --size 64x48 >"$work/out" || fail "the script ends with exit code $?"
grep -q '^frames four panes: 5, median ' "$work/out" || fail "no frame times"
more_than "$(brightness "$work/script.png")" 0.05 || fail "the script's picture is black"
keep "$work/script.png"
rm "$work/script.png"
env -u DISPLAY "$tessera" view --script "$work/steps.txt" --size 64x48 >/dev/null || fail "no script without a display"
[ -e "$work/script.png" ] || fail "no picture by a script without a display"
# a drag begins at the press, so it moves the end of the legend, not the camera
cat >"$work/steps.txt" <<EOF
wait scene
set active 1
set buffer primal_variance
wait spp 2
drag pane0.legend@0.95,0.8 pane0.legend@0.6,0.8
wait seconds 0.3
quit
EOF
"$tessera" view --script "$work/steps.txt" --size 64x48 --log-actions >"$work/out" || fail "the drag ends with exit code $?"
[ "$(grep '^camera ' "$work/out" | tail -n 1)" = 'camera 0 1 5.2 toward 0 0 -1' ] || fail "the drag of a legend moves the camera"
printf 'wait scene\nclick nowhere\n' >"$work/steps.txt"
"$tessera" view --script "$work/steps.txt" 2>"$work/errors"
[ $? -eq 2 ] || fail "a failing script does not end with exit code 2"
grep -q 'steps.txt:2: unknown control' "$work/errors" || fail "no message names file and line"

# --- bad input: exit code 2, a message, no file ---

"$tessera" view "$work/absent.xml" --screenshot "$work/absent.png" 2>"$work/errors"
[ $? -eq 2 ] || fail "an absent scene does not end with exit code 2"
grep -q absent.xml "$work/errors" || fail "no message names the absent scene"
[ ! -e "$work/absent.png" ] || fail "a picture without a scene is written"
"$tessera" view --screenshot "$work/no/such/folder.png" --spp 1 2>"$work/errors"
[ $? -eq 2 ] || fail "an unwritable picture does not end with exit code 2"

# --- without a command: opens the viewer, or without a display lists the commands ---

env -u DISPLAY -u WAYLAND_DISPLAY "$tessera" 2>"$work/errors"
[ $? -eq 2 ] || fail "without a display and a command it does not end with exit code 2"
grep -q "no command was given" "$work/errors" || fail "no message names the commands"
"$tessera" &
viewer=$!
window=
for _ in $(seq 300); do
    window=$(xdotool search --name '^Tessera') && break
    is_running || fail "without a command no viewer opens"
    sleep 0.1
done
[ -n "$window" ] || fail "without a command no window opens"
for _ in $(seq 20); do # until the window has the keyboard focus
    is_running || break
    xdotool key ctrl+q
    sleep 0.5
done
expect_end "ctrl+q" 0
echo "passed"
