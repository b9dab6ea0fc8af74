#!/bin/bash
# Tests slow motion, errors against a reference, charts, and settings files in the real viewer, under a virtual display.
# The panes stop at a few samples, so that pictures are bit-identical.
#   window_insides_test.sh PATH_OF_TESSERA [FOLDER_FOR_PICTURES]
set -u

source "$(dirname "$0")/virtual_display.sh"
scene=$(realpath "$(dirname "$0")/../../../assets/cornell-box.xml")
source "$(dirname "$0")/real_window.sh"
need xdotool import convert

spp=8
all_samples() { # waits for both panes; $1: first line of the log to read
    wait_for "^pane 0 spp $spp\$" "$1"
    wait_for "^pane 1 spp $spp\$" "$1"
}

# Check that two pictures of the screen are equal in the right pane, or that they differ.
same() { [ "$(distance "$1" "$2" "$picture")" = 0 ] || fail "the pictures differ: $1, $2"; }
differ() { more_than "$(distance "$1" "$2" "$picture")" "$3" || fail "the pictures do not differ: $1, $2"; }

# Prints the fraction of saturated pixels in a control's part of a picture. Lines of charts are saturated.
colourful() {
    convert "$work/$1.png" ${2:+-crop "$(part_of "$2")"} -colorspace HSL -channel G -separate -threshold 40% \
        -format '%[fx:mean]' info:
}

# Opens a file of the current folder in the dialog of this key.
choose() {
    press "$1" "^control file/$2 "
    click "file/$2"
    click file.open
}

"$tessera" reference "$scene" --size 64x48 --spp 16 -o "$work/reference.exr" >"$work/made" 2>&1 ||
    fail "$(cat "$work/made")"
start_viewer "$scene" --size 64x48 --spp $spp
all_samples 1
picture=$(part_of pane1.picture)
xdotool mousemove $(place_of pane0.picture)
look_at_rest rest

# --- the slow motion: it plays, steps by key, and restores the picture ---

from=$(next_line)
press j '^slow motion on$'
wait_for '^slow motion at tile .* path [2-9]' "$from"
xdotool key greater # stops the playback
look_at_rest slow
differ rest slow 0.05
path=$(grep '^slow motion at ' "$log" | tail -1 | grep -o '[0-9]*$')
press greater "^slow motion at tile .* path $((path + 1))\$"
look_at_rest step
differ slow step 0.0005
more_than "$(distance slow step "$(part_of slow.progress)")" 0 || fail "the panel of the slow motion does not change"
press less "^slow motion at tile .* path $path\$"
look_at_rest back
same slow back
press j '^slow motion off$'
look_at_rest ended
same rest ended

# --- errors are shown only with a reference ---

press 7 '^pane 1 buffer relMSE$'
look_at_rest unknown
grep -q '^control pane1.legend ' "$log" && fail "there are errors without a reference"
from=$(next_line)
choose ctrl+r reference.exr
wait_for '^control pane1.legend ' "$from"
look_at_rest errors
differ unknown errors 0.02
more_than "$(brightness "$work/errors.png" "$picture")" 0.1 || fail "all errors are zero"

# --- charts: drawn, and saved with the same errors as tessera compare prints ---

press h '^charts on$'
wait_for '^control charts.figures1 '
from=$(next_line)
xdotool key r # restarts, for more than one point
all_samples "$from"
look_at_rest charts
more_than "$(colourful charts charts.error)" 0.001 || fail "there are no lines in the chart"
press z '^messages '
csv=$(saved -charts.csv) || exit 1
svg=$(saved -charts.svg) || exit 1
png=$(saved -charts.png) || exit 1
keep "$png"
mv "$png" "$work/charts-saved.png"
more_than "$(colourful charts-saved)" 0.001 || fail "there are no lines in the saved chart"
grep -q '<polyline' "$svg" && tail -1 "$svg" | grep -q '</svg>' || fail "the saved chart is not a complete SVG"
press ctrl+e '^messages '
exr=$(saved -gpr.exr) || exit 1
"$tessera" compare "$exr" "$work/reference.exr" >"$work/compared" || fail "the saved files cannot be compared"
error_in_chart() { # prints the error of pane number $1 at the last sample
    awk -F, -v pane="$1" -v spp=$spp '
        NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
        $column["pane"] == pane && $column["spp"] == spp { error = $column["relMSE"] }
        /^$/ { exit }
        END { print error }' "$csv"
}
echo "relMSE in the chart: PT $(error_in_chart 1), G-PR $(error_in_chart 2)"
awk -v chart="$(error_in_chart 2)" '/floor-free/ { off = chart / $3 - 1 } END { exit !(off != "" && off ^ 2 < 1e-6) }' \
    "$work/compared" || fail "the chart has another error than: $(cat "$work/compared")"
more_than "$(error_in_chart 1)" "$(error_in_chart 2)" || fail "PT has no larger error than G-PR"
press h '^charts off$'

# --- a reference rendered in the background: written and opened ---

press ctrl+m '^control reference.make '
click reference.spp
xdotool key ctrl+a
xdotool type 32
from=$(next_line)
click reference.make
wait_for '^reference .*-64x48-.*\.exr$' "$from"
click reference.close
made=$(saved -64x48-d*.exr) || exit 1
"$tessera" compare "$made" "$work/reference.exr" >"$work/compared" || fail "the rendered reference cannot be compared"
awk '/floor-free/ { seen = $3 < 0.01 } END { exit !seen }' "$work/compared" ||
    fail "the rendered reference is another picture: $(cat "$work/compared")"

# --- settings: saved, changed, and restored ---

press 2 '^pane 1 buffer primal$' # incremental reconstructions are not bit-identical, so the primal image is compared
press plus '^exposure 0.5$'
press ctrl+p '^messages '
settings=$(saved -settings.json) || exit 1
sleep 6 # until toasts have disappeared
look_at_rest settings
press 0 '^exposure 0$'
press m '^pane 1 method pt$'
press ctrl+4 '^panes 4$'
look_at_rest changed
differ settings changed 0.01
from=$(next_line)
choose ctrl+l "${settings##*/}"
wait_for '^panes 2$' "$from"
wait_for '^exposure 0.5$' "$from"
wait_for '^pane 1 method gpr$' "$from"
wait_for "^pane 1 spp $spp\$" "$from"
sleep 6
look_at_rest loaded
same settings loaded

xdotool key ctrl+q
expect_end "ctrl+q" 0
echo passed
