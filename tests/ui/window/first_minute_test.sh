#!/bin/bash
# Plays the first minute of a new user in the real window with mouse and keys. Checks each step and prints its seconds.
# Uses the built-in scene and a scene on which methods fail.
#   first_minute_test.sh PATH_OF_TESSERA [FOLDER_FOR_PICTURES]
set -u

if [ -z "${TESSERA_WINDOW_TEST_INSIDE:-}" ]; then
    TESSERA_WINDOW_TEST_INSIDE=1 exec xvfb-run -a -s "-screen 0 1600x900x24 -noreset" "$0" "$@"
fi
water=$(realpath "$(dirname "$0")/../../../assets/stability/water.xml")
source "$(dirname "$0")/real_window.sh"
need xdotool import convert

begin() {
    from=$(next_line)
    began=$(date +%s.%N)
}

# Prints the time of the last step.
done_with() { printf '%-44s %6.2f s\n' "$1" "$(awk -v b="$began" -v e="$(date +%s.%N)" 'BEGIN { print e - b }')"; }

# Waits until a pane shows its last request. With $2 = " coarsely", a preview is sufficient.
picture_in() {
    local asked
    asked=$(grep -E "^pane $1 generation " "$log" | tail -1 | grep -o '[0-9]*$')
    wait_for "^pane $1 shows $asked${2:+($2)?}\$"
}

# Checks that a control's part of the screen is not black.
shows() { more_than "$(brightness "$work/$1.png" "$(part_of "$2")")" 0.03 || fail "$2 is black: $1"; }
changed() { more_than "$(distance "$1" "$2" "$(part_of "$3")")" 0.002 || fail "$3 looks the same: $1, $2"; }

# Checks that a panel opened in this step has restarted no render.
restarts_nothing() {
    tail -n "+$from" "$log" | grep -E '^pane [0-9] generation ' && fail "$1 restarted the panes"
    return 0
}

# $1: prefix of the pictures' names; $2: options and scene.
minute() {
    local name=$1
    shift
    echo "$name"
    rm -rf "$log" "$XDG_CONFIG_HOME" # of the previous viewer
    began=$(date +%s.%N)
    from=1
    start_viewer "$@"
    wait_for '^time window '
    done_with "window"
    wait_for '^time picture '
    wait_for '^pane 1 generation '
    picture_in 1 " coarsely"
    done_with "preview"
    picture_in 1
    done_with "  and the first pass"
    look "$name-start"
    shows "$name-start" pane1.picture

    begin
    xdotool key ctrl+4
    wait_for '^panes 4$' "$from"
    wait_for '^pane 3 generation ' "$from"
    for pane in 0 1 2 3; do picture_in $pane " coarsely"; done
    done_with "four panes, a preview in each"
    for pane in 0 1 2 3; do picture_in $pane; done
    done_with "  and the first passes"
    look "$name-four"
    for pane in 0 1 2 3; do shows "$name-four" pane$pane.picture; done

    begin
    read -r x0 y0 x1 y1 <<<"$(rect_of tile)"
    drag $(((x0 + x1) / 2)) $(((y0 + y1) / 2)) 8 0
    wait_for '^pane 3 tile [0-9]+$' "$from"
    done_with "tile size dragged"
    picture_in 3 " coarsely"
    done_with "  and the next preview"

    begin
    xdotool key i
    wait_for '^inspector on$' "$from"
    xdotool mousemove $(place_of pane3.picture) click 1
    wait_for '^control inspector.direction ' "$from"
    wait_for '^inspection ' "$from"
    done_with "a pixel clicked, its paths drawn"
    look "$name-inspector"
    changed "$name-four" "$name-inspector" pane3.picture
    restarts_nothing "the inspector"
    xdotool key Escape

    begin
    xdotool key h
    wait_for '^charts on$' "$from"
    wait_for '^control charts' "$from"
    done_with "charts"
    look "$name-charts"
    restarts_nothing "charts"

    begin
    xdotool key shift+g
    wait_for '^pane 1 norm l1$' "$from"
    for pane in 0 1 2 3; do picture_in $pane; done
    done_with "L1, weighted and guided side by side"
    look "$name-norms"
    shows "$name-norms" pane3.picture

    begin
    xdotool key ctrl+shift+s
    wait_for '^messages ' "$from"
    done_with "picture saved"
    png=$(saved -reconstruction.png) || exit 1
    more_than "$(brightness "$png")" 0.03 || fail "the saved picture is black"
    rm -f "$png"
    xdotool key ctrl+q
    expect_end "ctrl+q" 0
}

minute box
minute water "$water"
echo passed
