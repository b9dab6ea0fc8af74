#!/usr/bin/env python3
"""Tests that a reference that is killed many times ends with the same bits as one that is not.

    tests/attack/kills.py PROGRAM SCENE [--kills 100] [--spp 4000] [--seed 1]

Renders a reference of 48x27 pixels, with a checkpoint after each pass. Then renders it again, and kills the process
(SIGKILL) at random moments until there are --kills kills. A picture that is finished before is checked and started again.
Prints a tally. Exit code 1: bits differ, a run failed, or files other than the picture are left.
"""

import argparse
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path


def reference_command(given, picture):
    return [given.program, "reference", given.scene, "--size", "48x27", "--spp", given.spp, "--checkpoint", "0", "-o", picture]


def has_same_bits(program, picture, other):
    """Returns whether two pictures have the same pixels. Their headers differ, as they contain times."""
    done = subprocess.run([program, "compare", picture, other, "--json"], capture_output=True, text=True)
    return done.returncode == 0 and json.loads(done.stdout)["mse"] == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--spp", default="4000")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = random.Random(given.seed)
    with tempfile.TemporaryDirectory() as folder:
        whole, torn = Path(folder) / "whole.exr", Path(folder) / "torn" / "torn.exr"
        torn.parent.mkdir()
        start = time.monotonic()
        subprocess.run(reference_command(given, whole), check=True, capture_output=True)
        seconds = time.monotonic() - start
        kills = finished = 0
        while kills < given.kills:
            run = subprocess.Popen(reference_command(given, torn), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            try:
                _, message = run.communicate(timeout=rng.uniform(0, 0.3 * seconds))
            except subprocess.TimeoutExpired:
                run.kill()
                run.communicate()
                kills += 1
                continue
            if run.returncode != 0 or not has_same_bits(given.program, torn, whole):
                sys.exit(f"after {kills} kills: code {run.returncode}, or different bits\n{message.decode()}")
            finished += 1
            torn.unlink()
        subprocess.run(reference_command(given, torn), check=True, capture_output=True)
        left = [f.name for f in torn.parent.iterdir() if f.name != torn.name]
        same = has_same_bits(given.program, torn, whole)
    print(f"{kills} kills, {finished + 1} pictures, the last {'the same' if same else 'DIFFERENT'}; left: {left or 'nothing'}")
    sys.exit(not same or bool(left))


if __name__ == "__main__":
    main()
