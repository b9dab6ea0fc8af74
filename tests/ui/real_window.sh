# What the tests of the real window share: the viewer in a process of its own, and what it says of itself
# (--log-actions), mouse and keys for it, and pictures of its screen. To be sourced, with the path of the program and
# perhaps a folder for the pictures.
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
    "$tessera" view --log-actions "$@" >"$log" 2>"$work/errors" &
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

# The screen as it is now, kept as NAME.png.
look() {
    sleep 0.3
    import -window root "$work/$1.png" || fail "no picture of the screen"
    keep "$work/$1.png"
}

keep() { [ -z "$pictures" ] || cp "$1" "$pictures/"; }

# Mean brightness, 0 to 1, of a picture, or of a part of it.
brightness() { convert "$1" ${2:+-crop $2} -colorspace Gray -format '%[fx:mean]' info:; }

more_than() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }
