#!/bin/bash
# Starts the real viewer under a virtual display, drives it with synthetic mouse and keys, and checks its log
# (--log-actions), the screen, and the files that it writes.
#   window_test.sh PATH_OF_TESSERA [FOLDER_FOR_PICTURES]
set -u

source "$(dirname "$0")/virtual_display.sh"
source "$(dirname "$0")/real_window.sh"
need xdotool xprop import convert

shows_a_picture() {
    more_than "$(brightness "$work/$1.png" "$(part_of pane1.picture)")" 0.05 || fail "the picture is black: $1"
}

# --- start ---

start_viewer --size 200x150
wait_for '^time window '
wait_for '^time picture '
wait_for '^pane 0 method pt$'
wait_for '^pane 1 method gpr$'
wait_for '^pane 1 spp ([2-9]|[1-9][0-9]+)$'
grep '^time ' "$log"
look start
shows_a_picture start

# --- the method, a slider, keys ---

from=$(next_line)
click pane0.method
wait_for '^control pane0.method/gpr ' "$from"
click pane0.method/gpr
wait_for '^pane 0 method gpr$' "$from"

# an open list receives the keys
from=$(next_line)
click pane0.method
wait_for '^control pane0.method/gpr ' "$from"
sleep 0.5
xdotool key Up sleep 0.3 key Return
wait_for '^pane 0 method gpt$' "$from"
click pane0.method
xdotool sleep 0.3 key Down sleep 0.3 key Escape
sleep 0.5
tail -n "+$from" "$log" | grep -qE '^camera ' && fail "an arrow key in an open list moves the camera"
tail -n "+$from" "$log" | grep -qE '^pane 0 method gpr$' && fail "Esc accepts the selected item"
from=$(next_line)
click pane0.method
wait_for '^control pane0.method/gpr ' "$from"
click pane0.method/gpr
wait_for '^pane 0 method gpr$' "$from"
wait_for '^pane 0 generation ' "$from"
wait_for '^pane 0 spp [1-9]' "$from"
look method
more_than "$(distance start method "$(part_of pane0.method)")" 0.003 || fail "the method's name does not change"

from=$(next_line)
click tile
wait_for '^pane 1 tile [0-9]+$' "$from"

press space '^paused on$'
press space '^paused off$'
press question '^help on$'
look help
press Escape '^help off$'

# --- the camera, with mouse and keys ---

picture=$(part_of pane1.picture)
read -r x y <<<"$(place_of pane1.picture)"
few_errors='^pane 1 spp ([4-9]|[1-9][0-9]+)$'
wait_for "$few_errors"
look before
from=$(next_line)
drag "$x" "$y" 30 4
wait_for '^camera ' "$from"
wait_for "$few_errors" "$from"
look orbit
moved=$(distance before orbit "$picture")
from=$(next_line)
xdotool keydown w sleep 0.3 keyup w
wait_for '^camera ' "$from"
sleep 0.3
from=$(next_line)
xdotool key Home
wait_for '^camera ' "$from"
wait_for "$few_errors" "$from"
look home
noise=$(distance before home "$picture")
echo "distance of pictures: $moved after an orbit, $noise when back"
more_than "$moved" "$(awk -v n="$noise" 'BEGIN { print 2 * n }')" || fail "the picture does not follow the camera"

# --- panes: dragging a wipe's line, holding a key, changing the number of panes ---

from=$(next_line)
xdotool mousemove "$x" "$y" click 1
sleep 0.3
press v '^pane 1 comparison wipe$'
sleep 0.3
drag "$x" "$y" 20 0
wait_for '^wipe 0\.[6-9]' "$from"
look wipe
xdotool keydown b
wait_for '^flicker on$' "$from"
xdotool keyup b
wait_for '^flicker off$' "$from"
press v '^pane 1 comparison off$'
from=$(next_line)
press ctrl+4 '^panes 4$'
wait_for '^pane 3 spp [1-9]' "$from"
look four
press ctrl+2 '^panes 2$'

# --- the path inspector: a click on a pixel shows its tables ---

press i '^inspector on$'
from=$(next_line)
xdotool mousemove "$x" $((y - 100)) click 1
wait_for '^inspected pane 1 pixel ' "$from"
wait_for '^control vertices.title ' "$from"
wait_for '^control shifts.row0 ' "$from"
look inspect
more_than "$(distance home inspect "$(part_of vertices.title)")" 0.003 || fail "no table is visible"
press i '^inspector off$'

# --- saving: the view as PNG, the pane as EXR with its layers ---

press ctrl+shift+s '^messages 1$' # "Saved ..."
png=$(saved -gpr-reconstruction.png) || exit 1
more_than "$(brightness "$png")" 0.05 || fail "the saved view is black"
keep "$png"
press ctrl+e '^messages 2$'
exr=$(saved -gpr.exr) || exit 1
"$tessera" compare "$exr" "$exr" >"$work/compared" 2>&1 || fail "the saved EXR cannot be read: $(cat "$work/compared")"
for layer in primal dx albedo first_hit_normal first_hit_depth; do
    grep -aq "$layer.R" "$exr" || fail "the saved EXR has no layer $layer"
done
xdotool key F2 # opens the messages
look save
xdotool key F2

# --- while paused, after the pass under way, the viewer draws nothing and uses no processor time ---

press space '^paused on$'
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
press space '^paused off$'

# --- a window of one pixel, a minimised window, and a restored one ---

window=$(xdotool search --name '^Tessera') || fail "no window"
read -r width height <<<"$(xdotool getwindowgeometry --shell "$window" | awk -F= '/^(WIDTH|HEIGHT)=/ { printf "%s ", $2 }')"
resize() {
    from=$(next_line)
    xdotool windowsize "$window" "$1" "$2"
    wait_for '^control pane1.picture ' "$from"
}
resize 1 1
look tiny
more_than 0.01 "$(brightness "$work/tiny.png")" || fail "the window has not shrunk"
resize "$width" "$height"
wait_for '^pane 1 spp [1-9]' "$from"
look resized
shows_a_picture resized

# Minimises and restores the window as a window manager does [ICCCM, 4.1.3.1 and 4.1.4].
from=$(next_line)
xprop -id "$window" -f WM_STATE 32i -set WM_STATE 3
xdotool windowunmap --sync "$window"
look minimised
more_than 0.01 "$(brightness "$work/minimised.png")" || fail "the minimised window is visible"
wait_for '^pane 1 spp ' "$from" # rendering continues
from=$(next_line)
xdotool windowmap --sync "$window"
xprop -id "$window" -f WM_STATE 32i -set WM_STATE 1
wait_for '^pane 1 spp ' "$from"
look restored
shows_a_picture restored
press t '^statistics on$' # keys work

# --- quit ---

xdotool key ctrl+q
expect_end "ctrl+q" 0
look quit
more_than 0.01 "$(brightness "$work/quit.png")" || fail "the screen is not empty"
echo passed
