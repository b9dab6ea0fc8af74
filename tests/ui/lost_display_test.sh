#!/bin/bash
# Ends the viewer from outside while it renders: by taking its display away, and by signals. It must end by itself, with
# a message where something went wrong, and have its layout remembered.
#   lost_display_test.sh PATH_OF_TESSERA
set -u

tessera=$(realpath "$1")
command -v Xvfb >/dev/null || { echo "no Xvfb"; exit 1; }
work=$(mktemp -d)
log=$work/log
viewer= server=
ulimit -c unlimited
cd "$work" # a core would lie here
trap 'kill $viewer $server 2>/dev/null; rm -rf "$work"' EXIT

fail() {
    echo "FAILED: $*"
    cat "$work/errors"
    grep -v '^control ' "$log" | tail -5
    exit 1
}

wait_for() { # a line of the log
    for _ in $(seq 300); do
        grep -qE "$1" "$log" && return
        kill -0 $viewer 2>/dev/null || fail "the viewer ended while waiting for: $1"
        sleep 0.1
    done
    fail "no line: $1"
}

start() { # a server, and the viewer on it, which renders
    rm -rf "$work/config" "$work/display"
    mkfifo "$work/display"
    Xvfb -displayfd 3 -screen 0 1024x768x24 3>"$work/display" 2>/dev/null &
    server=$!
    read -r number <"$work/display"
    DISPLAY=:$number XDG_CONFIG_HOME=$work/config "$tessera" view --log-actions --size 160x90 "$@" >"$log" 2>"$work/errors" &
    viewer=$!
    wait_for '^pane 1 spp ([2-9]|[1-9][0-9]+)$'
}

# Waits for the viewer's end; its exit code.
ended() {
    for _ in $(seq 100); do
        kill -0 $viewer 2>/dev/null || break
        sleep 0.1
    done
    kill -0 $viewer 2>/dev/null && fail "does not end: $1"
    wait $viewer
}

remembered() { grep -q '"window"' "$work/config/tessera/viewer.json" || fail "the layout is not remembered: $1"; }

start
rm "$work/config/tessera/viewer.json" 2>/dev/null # written when a scene is shown, too
kill -9 $server
ended "no display"
code=$?
[ $code -eq 3 ] || fail "exit code $code without a display"
grep -q 'display is lost' "$work/errors" || fail "no message of the lost display"
remembered "no display"

for signal in INT TERM; do
    start
    rm "$work/config/tessera/viewer.json" 2>/dev/null
    kill -$signal $viewer
    ended $signal
    code=$?
    [ $code -eq 0 ] || fail "exit code $code after $signal"
    remembered $signal
    kill $server
done

echo 'wait seconds 60' >"$work/steps.txt"
start --script "$work/steps.txt"
kill -TERM $viewer
ended "TERM and a script"
code=$?
[ $code -eq 130 ] || fail "exit code $code of a script that was cut short"

ls "$work" | grep -q '^core' && fail "a core"
echo passed
