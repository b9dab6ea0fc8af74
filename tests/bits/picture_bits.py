#!/usr/bin/env python3
"""Prints checksums of small pictures by all four methods, of the stability scenes and of the given scenes. Two programs
with equal lists render the same bits.

    tests/bits/picture_bits.py build/release/app/tessera [FOLDER/scene.xml ...] > bits.txt

The checksum covers the pixel blocks of all layers, but not the header, which contains times and versions."""
import argparse
import hashlib
import pathlib
import struct
import subprocess
import sys
import tempfile

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"
METHODS = ["pt", "pr", "gpt", "gpr"]


def pixel_blocks(file):
    """Returns the bytes of a single-part EXR file that follow its header and its offset table."""
    data = file.read_bytes()
    at, rows, lines_a_block = 8, 0, {0: 1, 1: 1, 2: 1, 3: 16, 4: 32}
    compression = 0
    while data[at]:
        name, at = data[at : data.index(0, at)], data.index(0, at) + 1
        at = data.index(0, at) + 1  # skips its type
        size = struct.unpack_from("<i", data, at)[0]
        if name == b"compression":
            compression = data[at + 4]
        if name == b"dataWindow":
            window = struct.unpack_from("<4i", data, at + 4)
            rows = window[3] - window[1] + 1
        at += 4 + size
    blocks = -(-rows // lines_a_block[compression])
    return data[at + 1 + 8 * blocks :]


def render(program, scene, method, spp, size, extra, file):
    command = [program, "render", str(scene), "-m", method, "--spp", str(spp), "--size", size, "--buffers", "--threads",
               "2", "-o", str(file)] + extra
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode:
        sys.exit(f"{' '.join(command)}\n{run.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    jobs = [(s, 3, "32x24", []) for s in sorted((ASSETS / "stability").glob("*.xml"))]
    jobs += [(s, 4, "160x90", extra) for s in arguments.scenes
             for extra in ([], ["--recon", "l1,mixed,weighted,uniform"], ["--shift", "replay-reconnection"],
                           ["--shift", "replay"], ["--pattern", "rooks", "--roulette", "absolute"],
                           ["--roulette-depth", "1"])]
    with tempfile.TemporaryDirectory() as folder:
        for scene, spp, size, extra in jobs:
            for method in METHODS:
                file = pathlib.Path(folder) / "picture.exr"
                render(arguments.program, scene, method, spp, size, extra, file)
                digest = hashlib.sha256(pixel_blocks(file)).hexdigest()[:16]
                print(digest, method, f"{scene.parent.name}/{scene.name}", *extra, flush=True)


if __name__ == "__main__":
    main()
