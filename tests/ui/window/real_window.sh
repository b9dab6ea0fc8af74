# What the tests of the real window share: the viewer in a process of its own, and what it says of itself
# (--log-actions), mouse and keys for it, and pictures of its screen. To be sourced, with the path of the program and
# perhaps a folder for the pictures; after virtual_display.sh, unless the test has a display of its own.
tessera=$(realpath "$1")
pictures=${2:+$(realpath "$2")}
work=$(mktemp -d)
log=$work/log # and its errors in $work/errors
viewer=
export XDG_CONFIG_HOME=$work/config # remembers nothing of the user's, and leaves nothing there
cd "$work" || exit 1                # what is saved lies here, and a core would
trap end EXIT

# Everything that was started, and what it has left.
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

# Presses a key, and waits for the line that it is to bring.
press() {
    local from
    from=$(next_line)
    xdotool key "$1"
    wait_for "$2" "$from"
}

# Where a control lies, as last logged: x0 y0 x1 y1.
rect_of() {
    wait_for "^control $1 "
    grep -E "^control $1 " "$log" | tail -1 | cut -d ' ' -f 3-6
}

# Its middle.
place_of() { rect_of "$1" | awk '{ print int(($1 + $3) / 2), int(($2 + $4) / 2) }'; }

# Clicks on a control, once it stays where it is: a new window settles within some frames.
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

# The screen as it is now, kept as NAME.png.
look() {
    sleep 0.3
    import -window root "$work/$1.png" || fail "no picture of the screen"
    keep "$work/$1.png"
}

# A sum of a picture's pixels: alike pictures have the same.
pixels_of() { convert "$work/$1.png" -format '%#' info:; }

# The screen once nothing moves on it any more.
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

# Mean brightness, 0 to 1, of a picture, or of a part of it.
brightness() { convert "$1" ${2:+-crop $2} -colorspace Gray -format '%[fx:mean]' info:; }

# A control's part of the screen, for convert.
part_of() { rect_of "$1" | awk '{ printf "%dx%d+%d+%d", $3 - $1, $4 - $2, $1, $2 }'; }

# Mean distance, 0 to 1, of two pictures of the screen in a part of it.
distance() {
    convert "$work/$1.png" "$work/$2.png" -crop "$3" +repage -compose difference -composite -colorspace Gray \
        -format '%[fx:mean]' info:
}

more_than() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }

# The file whose name ends so, or as this pattern.
saved() { ls "$work"/*$1 2>/dev/null || fail "nothing was saved: $1"; }
