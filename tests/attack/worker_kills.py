#!/usr/bin/env python3
"""Tests that workers of one folder, killed many times, give the results of one worker that is not.

    tests/attack/worker_kills.py PROGRAM SCENE [--trials 50] [--workers 4] [--seed 1]

Runs a sweep of 48x27 pixels in one process. In each trial, several workers run the same sweep in a new folder, with the
references. Random workers are killed (SIGKILL) at random moments and replaced; then all run to their end. Prints a tally.
Exit code 1: a row differs in more than times, the number of job files is wrong, other files are left, or a worker failed.
"""

import argparse
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TIMES = {"cpu_seconds", "cpu_seconds_deviation", "reconstruction_cpu_seconds", "wall_seconds", "megasamples_per_wall_second",
         "efficiency"}


def command(given, folder):
    return [given.program, "sweep", given.scene, "-m", "pt,gpr", "--vary", "tile=2,3,4", "--seeds", "4", "--size", "48x27",
            "--spp", "16", "--reference-spp", "256", "--threads", "1", "--silence", "1", "--reference", folder / "refs",
            "-o", folder / "out"]


def rows(folder):
    """Returns the results in sweep.json without times."""
    def timeless(row):
        return {key: value for key, value in row.items() if key not in TIMES}
    results = json.loads((folder / "out/sweep.json").read_text())["results"]
    return [timeless(row) | {"runs": [timeless(run) for run in row["runs"]]} for row in results]


def left_over(folder):
    """Returns the names of files that should not exist, and the number of job files if it is wrong."""
    jobs = [f.name for f in (folder / "out/jobs").iterdir()]
    finished = [name for name in jobs if name.endswith(".jsonl")]
    others = [name for name in jobs if not name.endswith(".jsonl") and not name.startswith("report-")]
    others += [f.name for f in (folder / "refs").iterdir() if f.suffix != ".exr"]
    return others if len(finished) == 4 * 4 else others + [f"{len(finished)} jobs"]


def trial(given, folder, rng, whole):
    """Returns a problem, or an empty string, and the number of kills."""
    def start():
        return subprocess.Popen(command(given, folder), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    workers = [start() for _ in range(given.workers)]
    kills = 0
    for _ in range(rng.randrange(1, 12)):
        time.sleep(rng.uniform(0, 0.3))
        victim = rng.randrange(len(workers))
        kills += workers[victim].poll() is None
        workers[victim].kill()
        workers[victim].communicate()
        workers[victim] = start()
    for worker in workers:
        _, message = worker.communicate()
        if worker.returncode != 0:
            return f"code {worker.returncode}: {message.decode()}", kills
    if rows(folder) != whole:
        return "different rows", kills
    left = left_over(folder)
    return f"files left: {left}" if left else "", kills


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--trials", type=int, default=50)
    parser.add_argument("--workers", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = random.Random(given.seed)
    all_kills = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(command(given, Path(folder)), check=True, capture_output=True)
        whole = rows(Path(folder))
    for i in range(given.trials):
        with tempfile.TemporaryDirectory() as folder:
            problem, kills = trial(given, Path(folder), rng, whole)
        all_kills += kills
        if problem:
            wrong += 1
            print(f"trial {i + 1}: {problem}")
    print(f"{given.trials} trials, {all_kills} kills: {wrong or 'none'} failed")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
