#!/bin/bash
# installed_library.sh BUILD SOURCE: installs the library recon in a temporary folder, builds examples/ against it, and
# compares its picture with that of `tessera reconstruct` for the same buffers.
set -eu
build=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --component recon --prefix "$work/prefix" >"$work/log"
cmake -S "$source/examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >>"$work/log"
cmake --build "$work/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
python3 - "$work" <<'P'
import array, sys
def pfm(path, width, height, value):
    rows = array.array("f", (v for y in reversed(range(height)) for x in range(width) for v in value(x, y)))
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1\n".encode() + rows.tobytes())
width, height = 40, 30
exact = lambda x, y: [0.5 + 0.01 * x, 0.3 + 0.02 * y, 1.0 + (x > 20)]
noisy = lambda x, y: [v + 0.2 * ((7 * x + 13 * y) % 5 - 2) for v in exact(x, y)]
step = lambda x, y, i, j: [b - a for a, b in zip(exact(x, y), exact(x + i, y + j))]
pfm(sys.argv[1] + "/primal.pfm", width, height, noisy)
pfm(sys.argv[1] + "/dx.pfm", width, height, lambda x, y: step(x, y, 1, 0) if x + 1 < width else [0, 0, 0])
pfm(sys.argv[1] + "/dy.pfm", width, height, lambda x, y: step(x, y, 0, 1) if y + 1 < height else [0, 0, 0])
P
cd "$work"
for norm in l2 l1 weighted; do
    build/reconstruct_buffers primal.pfm dx.pfm dy.pfm "$norm.pfm" $norm
    "$build/app/tessera" reconstruct primal.pfm dx.pfm dy.pfm --recon $norm -o "$norm.exr" >>log
    "$build/app/tessera" reconstruct "$norm.pfm" dx.pfm dy.pfm --recon none -o library.exr >>log
    "$build/app/tessera" compare library.exr "$norm.exr" --json >compared
    python3 -c "import json; error = json.load(open('compared'))['mse']; assert error < 1e-10, ('$norm', error)"
done
echo "the library makes the pictures of the program"
