#!/usr/bin/env python3
"""Measures the cost of dividing a sweep among workers: CPU seconds of eight workers over those of one.

    tests/bench/workers.py PROGRAM SCENE [--workers 8] [--rounds 3] [--spp 256]

Runs a sweep of 64 single-threaded jobs of 160x90 pixels, by one worker and by several in turn, each time in a new folder.
References are rendered before. Prints the CPU seconds of both (user and system, with loading and reports) and their ratio;
in brackets, the same for rendering alone.
"""

import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path


def sweep(given, folder, workers):
    """Returns the CPU seconds of all processes, and the sum of those that the jobs report for rendering."""
    command = [given.program, "sweep", given.scene, "-m", "gpr", "--vary", "tile=2,4,6,8", "--seeds", "16", "--size", "160x90",
               "--spp", str(given.spp), "--reference-spp", "64", "--threads", "1", "--reference", folder / "refs", "-o",
               folder / f"out-{workers}-{os.times().elapsed}"]
    before = os.times()
    started = [subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for _ in range(workers)]
    assert all(process.wait() == 0 for process in started)
    after = os.times()
    rows = json.loads((command[-1] / "sweep.json").read_text())["results"]
    measured = sum(run["cpu_seconds"] for row in rows for run in row["runs"])
    return after.children_user + after.children_system - before.children_user - before.children_system, measured


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--workers", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--spp", type=int, default=256)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        spp, given.spp = given.spp, 1
        sweep(given, folder, 1)  # renders the references
        given.spp = spp
        for _ in range(given.rounds):
            one, measured_by_one = sweep(given, folder, 1)
            many, measured_by_many = sweep(given, folder, given.workers)
            print(f"one worker {one:.2f} CPU s (rendering {measured_by_one:.2f}), {given.workers} workers {many:.2f} "
                  f"({measured_by_many:.2f}): {many / one:.3f} ({measured_by_many / measured_by_one:.3f})", flush=True)


if __name__ == "__main__":
    main()
