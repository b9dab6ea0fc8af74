#!/bin/bash
# Starts the real viewer in a window under a virtual display, drives it with synthetic mouse and keys, and looks at
# what it says it did (--log-actions) and at what the screen shows.
#   window_test.sh PATH_OF_TESSERA [FOLDER_FOR_PICTURES]
set -u

tessera=$(realpath "$1")
pictures=${2:-}
assets=$(realpath "$(dirname "$0")/../../assets")

if [ -z "${TESSERA_WINDOW_TEST_INSIDE:-}" ]; then
    for program in xvfb-run xdotool import convert; do
        command -v $program >/dev/null || { echo "no $program"; exit 1; }
    done
    TESSERA_WINDOW_TEST_INSIDE=1 exec xvfb-run -a -s "-screen 0 1280x800x24" "$0" "$tessera" $pictures
fi

work=$(mktemp -d)
log=$work/log
export XDG_CONFIG_HOME=$work/config # remembers nothing of the user's, and leaves nothing there
trap 'kill $viewer 2>/dev/null; rm -rf "$work"' EXIT

fail() {
    echo "FAILED: $*"
    echo "--- end of the log:"
    grep -v '^control ' "$log" | tail -25
    exit 1
}

# Waits until a line of the log, from line number $2 on, matches the expression $1.
wait_for() {
    for _ in $(seq 300); do
        tail -n "+${2:-1}" "$log" 2>/dev/null | grep -qE "$1" && return
        kill -0 $viewer 2>/dev/null || fail "the viewer ended while waiting for: $1"
        sleep 0.1
    done
    fail "no line: $1"
}

next_line() { echo $(($(wc -l <"$log") + 1)); }

# The middle of a control, as last logged.
place_of() {
    wait_for "^control $1 "
    grep -E "^control $1 " "$log" | tail -1 | awk '{ print int(($3 + $5) / 2), int(($4 + $6) / 2) }'
}

click() {
    read -r x y <<<"$(place_of "$1")"
    xdotool mousemove "$x" "$y"
    sleep 0.2
    xdotool click 1
}

# Mean brightness, 0 to 1, of a picture (of a part, WxH+X+Y).
brightness() { convert "$1" ${2:+-crop $2} -colorspace Gray -format '%[fx:mean]' info:; }
more_than() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }

keep() { [ -z "$pictures" ] || cp "$1" "$pictures/"; }

"$tessera" view --log-actions >"$log" 2>"$work/errors" &
viewer=$!

wait_for '^time window '
wait_for '^time picture '
wait_for '^pane 0 method pt$'
wait_for '^pane 1 method gpr$'
wait_for '^pane 1 spp ([2-9]|[1-9][0-9]+)$'
grep '^time ' "$log"

# The picture is there.
import -window root "$work/start.png" || fail "no picture of the screen"
keep "$work/start.png"
line=$(grep -E '^control pane1.picture ' "$log" | tail -1)
read -r _ _ x0 y0 x1 y1 <<<"$line"
more_than "$(brightness "$work/start.png" "$((x1 - x0))x$((y1 - y0))+$x0+$y0")" 0.05 || fail "the picture is black"

# The method control.
from=$(next_line)
click pane0.method
wait_for '^control pane0.method/gpr ' "$from"
click pane0.method/gpr
wait_for '^pane 0 method gpr$' "$from"
wait_for '^pane 0 generation ' "$from"

# A slider.
from=$(next_line)
click tile
wait_for '^pane 1 tile [0-9]+$' "$from"

# A shortcut, a character, and the help page.
from=$(next_line)
xdotool key space
wait_for '^paused on$' "$from"
xdotool key space
wait_for '^paused off$' "$from"
xdotool key question
wait_for '^help on$' "$from"
sleep 0.3
import -window root "$work/help.png" && keep "$work/help.png"
xdotool key Escape
wait_for '^help off$' "$from"

# The camera, with mouse and keys.
read -r x y <<<"$(place_of pane1.picture)"
from=$(next_line)
xdotool mousemove "$x" "$y" mousedown 1
for step in 1 2 3 4; do
    xdotool mousemove $((x + 15 * step)) $((y + 4 * step))
    sleep 0.05
done
xdotool mouseup 1
wait_for '^camera ' "$from"
sleep 0.3
from=$(next_line)
xdotool keydown w sleep 0.3 keyup w
wait_for '^camera ' "$from"
sleep 0.3
from=$(next_line)
xdotool key Home
wait_for '^camera ' "$from"
sleep 0.5
import -window root "$work/end.png" && keep "$work/end.png"

# Panes: a wipe's line is dragged, a key held, the grid changed.
from=$(next_line)
xdotool mousemove "$x" "$y" click 1
sleep 0.3
xdotool key v
wait_for '^pane 1 comparison wipe$' "$from"
sleep 0.3
xdotool mousemove "$x" "$y" mousedown 1
for step in 1 2 3 4; do
    xdotool mousemove $((x + 20 * step)) "$y"
    sleep 0.05
done
xdotool mouseup 1
wait_for '^wipe 0\.[6-9]' "$from"
sleep 0.3
import -window root "$work/wipe.png" && keep "$work/wipe.png"
xdotool keydown b
wait_for '^flicker on$' "$from"
xdotool keyup b
wait_for '^flicker off$' "$from"
xdotool key v
from=$(next_line)
xdotool key ctrl+4
wait_for '^panes 4$' "$from"
wait_for '^pane 3 spp [1-9]' "$from"
sleep 0.3
import -window root "$work/four.png" && keep "$work/four.png"
xdotool key ctrl+2
wait_for '^panes 2$' "$from"

# While paused, nothing is drawn and no processor used, once the pass that was under way has ended.
from=$(next_line)
xdotool key space
wait_for '^paused on$' "$from"
used=100
for attempt in 1 2 3 4 5 6 7 8 9 10; do
    before=$(awk '{ print $14 + $15 }' /proc/$viewer/stat)
    sleep 2
    after=$(awk '{ print $14 + $15 }' /proc/$viewer/stat)
    used=$((after - before))
    [ "$used" -lt 30 ] && break
done
echo "processor time while paused: $used hundredths in 2 seconds (attempt $attempt)"
[ "$used" -lt 30 ] || fail "busy while paused"

xdotool key ctrl+q
for _ in $(seq 100); do
    kill -0 $viewer 2>/dev/null || break
    sleep 0.1
done
kill -0 $viewer 2>/dev/null && fail "does not quit"
wait $viewer
code=$?
[ $code -eq 0 ] || fail "exit code $code: $(cat "$work/errors")"

# A scene file: reloaded, broken and mended; the window is named after it, and the camera saved beside it.
scene=$work/box.xml
cp "$assets/cornell-box.xml" "$scene"
"$tessera" view "$scene" --log-actions >"$log" 2>"$work/errors" &
viewer=$!
wait_for '^scenes shown 1$'
wait_for '^time picture '
xdotool search --name "^Tessera - $scene\$" >/dev/null || fail "the window is not named after the scene"
xdotool mousemove 300 300
from=$(next_line)
xdotool keydown w sleep 0.3 keyup w
wait_for '^camera ' "$from"
sleep 0.3
from=$(next_line)
xdotool key F5
wait_for '^scenes shown 2$' "$from"
wait_for '^pane 1 generation ' "$from"
tail -n "+$from" "$log" | grep -q '^camera ' && fail "the camera has moved by itself"
sed -i 's/<scene/<scone/' "$scene"
from=$(next_line)
xdotool key F5
wait_for '^messages 1$' "$from"
sleep 0.3
import -window root "$work/broken.png" && keep "$work/broken.png"
sed -i 's/<scone/<scene/' "$scene"
from=$(next_line)
xdotool key F5
wait_for '^scenes shown 3$' "$from"
wait_for '^messages 0$' "$from"
xdotool key k
wait_for '^messages 1$' "$from"
grep -q to_world "$work/box-camera.json" || fail "no camera was saved"
xdotool key ctrl+q
wait $viewer || fail "exit code $?: $(cat "$work/errors")"

# The program's own picture, in a window and without any display.
"$tessera" view --screenshot "$work/own.png" --spp 4 || fail "no screenshot"
more_than "$(brightness "$work/own.png")" 0.05 || fail "the screenshot is black"
env -u DISPLAY "$tessera" view --screenshot "$work/none.png" --spp 2 || fail "no screenshot without a display"
more_than "$(brightness "$work/none.png")" 0.05 || fail "the screenshot without a display is black"
keep "$work/own.png"
keep "$work/none.png"

# Scripts, in a window and without any display.
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
printf 'wait scene\nclick nowhere\n' >"$work/steps.txt"
"$tessera" view --script "$work/steps.txt" 2>"$work/errors"
[ $? -eq 2 ] || fail "a script that goes wrong does not end with exit code 2"
grep -q 'steps.txt:2: no control' "$work/errors" || fail "no message names file and line"

# Bad input: exit code 2, a message, no file.
"$tessera" view "$work/absent.xml" --screenshot "$work/absent.png" 2>"$work/errors"
[ $? -eq 2 ] || fail "an absent scene does not end with exit code 2"
grep -q absent.xml "$work/errors" || fail "no message names the absent scene"
[ ! -e "$work/absent.png" ] || fail "a picture of nothing"
"$tessera" view --screenshot "$work/no/such/folder.png" --spp 1 2>"$work/errors"
[ $? -eq 2 ] || fail "an unwritable picture does not end with exit code 2"
echo "passed"
