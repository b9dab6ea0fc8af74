# Functions for tests of the real window: they start the viewer with --log-actions, send mouse and key events, and take
# pictures of the screen. To be sourced with the program's path and optionally a folder for pictures, after
# virtual_display.sh unless the test starts its own display.
tessera=$(realpath "$1")
pictures=${2:+$(realpath "$2")}
work=$(mktemp -d)
log=$work/log # standard error is in $work/errors
viewer=
export XDG_CONFIG_HOME=$work/config # keeps the user's preferences untouched
cd "$work" || exit 1                # saved files and core dumps are put here
trap end EXIT

# Ends all started processes, and removes their files.
end() {
    kill $viewer ${server:-} 2>/dev/null
    wait
    cd / && rm -rf "$work"
}

need() {
    for program; do
        command -v "$program" >/dev/null || { echo "no $program"; exit 1; }
    done
}

fail() {
    {
        echo "FAILED: $*"
        cat "$work/errors"
        echo "--- end of the log:"
        grep -vE '^(control |pane . spp )' "$log" | tail -25
    } >&2
    exit 1
}

# Starts the viewer with these options.
start_viewer() {
    "$tessera" view --no-gallery --log-actions "$@" >"$log" 2>"$work/errors" &
    viewer=$!
}

is_running() { kill -0 $viewer 2>/dev/null; }

# Waits until a line of the log, from line number $2 on, matches the expression $1.
wait_for() {
    for _ in $(seq 600); do
        tail -n "+${2:-1}" "$log" 2>/dev/null | grep -qE "$1" && return
        is_running || fail "the viewer ended while waiting for: $1"
        sleep 0.1
    done
    fail "no line: $1"
}

next_line() { echo $(($(wc -l <"$log") + 1)); }

# Waits for the viewer's end after $1, with the exit code $2.
expect_end() {
    for _ in $(seq 100); do
        is_running || break
        sleep 0.1
    done
    is_running && fail "does not end: $1"
    wait $viewer
    local code=$?
    [ $code -eq "$2" ] || fail "exit code $code: $1"
}

# Presses a key, and waits for a line of the log.
press() {
    local from
    from=$(next_line)
    xdotool key "$1"
    wait_for "$2" "$from"
}

# Prints a control's last logged rectangle: x0 y0 x1 y1.
rect_of() {
    wait_for "^control $1 "
    grep -E "^control $1 " "$log" | tail -1 | cut -d ' ' -f 3-6
}

# Prints a control's middle.
place_of() { rect_of "$1" | awk '{ print int(($1 + $3) / 2), int(($2 + $4) / 2) }'; }

# Clicks on a control when its position is stable, because a new window settles within some frames.
click() {
    local place=
    until [ "$place" = "$(place_of "$1")" ]; do
        place=$(place_of "$1")
        xdotool mousemove $place
        sleep 0.2
    done
    xdotool click 1
}

# Drags with the left button, in four steps of ($3, $4) from ($1, $2).
drag() {
    xdotool mousemove "$1" "$2" mousedown 1
    for step in 1 2 3 4; do
        xdotool mousemove $(($1 + $3 * step)) $(($2 + $4 * step))
        sleep 0.05
    done
    xdotool mouseup 1
}

# Saves the screen as NAME.png.
look() {
    sleep 0.3
    import -window root "$work/$1.png" || fail "no picture of the screen"
    keep "$work/$1.png"
}

# Prints a checksum of a picture's pixels.
pixels_of() { convert "$work/$1.png" -format '%#' info:; }

# Saves the screen when nothing moves.
look_at_rest() {
    look "$1"
    for _ in $(seq 100); do
        mv "$work/$1.png" "$work/earlier.png"
        look "$1"
        [ "$(pixels_of earlier)" = "$(pixels_of "$1")" ] && return
    done
    fail "the screen does not come to rest: $1"
}

keep() { [ -z "$pictures" ] || cp "$1" "$pictures/"; }

# Prints the mean brightness of a picture or of a part of it, [0, 1].
brightness() { convert "$1" ${2:+-crop $2} -colorspace Gray -format '%[fx:mean]' info:; }

# Prints a control's rectangle as an ImageMagick geometry.
part_of() { rect_of "$1" | awk '{ printf "%dx%d+%d+%d", $3 - $1, $4 - $2, $1, $2 }'; }

# Prints the mean difference of two pictures in a part of the screen, [0, 1].
distance() {
    convert "$work/$1.png" "$work/$2.png" -crop "$3" +repage -compose difference -composite -colorspace Gray \
        -format '%[fx:mean]' info:
}

more_than() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }

# Prints the saved file whose name ends with this pattern.
saved() { ls "$work"/*$1 2>/dev/null || fail "nothing was saved: $1"; }
