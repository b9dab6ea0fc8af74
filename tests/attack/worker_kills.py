#!/usr/bin/env python3
"""Workers that are killed again and again find in one folder what one that is left alone finds.

    tests/attack/worker_kills.py PROGRAM SCENE [--trials 50] [--workers 4] [--seed 1]

Sweeps the scene in 48x27 pixels by samples; then, in each trial, several workers do so in a new folder (references, too),
of which one after the other is killed (SIGKILL) at moments chosen by chance, and another started in its place; at last all
are left to end. Prints a tally; exit code 1: a row differs in anything but times, a job has two files or none, files other
than jobs and reports are left, or a worker failed.
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
    """What sweep.json has, but for times."""
    def timeless(row):
        return {key: value for key, value in row.items() if key not in TIMES}
    results = json.loads((folder / "out/sweep.json").read_text())["results"]
    return [timeless(row) | {"runs": [timeless(run) for run in row["runs"]]} for row in results]


def left_over(folder):
    """Files that should not be there."""
    jobs = [f.name for f in (folder / "out/jobs").iterdir()]
    finished = [name for name in jobs if name.endswith(".jsonl")]
    others = [name for name in jobs if not name.endswith(".jsonl") and not name.startswith("report-")]
    others += [f.name for f in (folder / "refs").iterdir() if f.suffix != ".exr"]
    return others if len(finished) == 4 * 4 else others + [f"{len(finished)} jobs"]


def trial(given, folder, chance, whole):
    """Returns what is wrong, or nothing, and the number of kills."""
    def start():
        return subprocess.Popen(command(given, folder), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    workers = [start() for _ in range(given.workers)]
    kills = 0
    for _ in range(chance.randrange(1, 12)):
        time.sleep(chance.uniform(0, 0.3))
        victim = chance.randrange(len(workers))
        kills += workers[victim].poll() is None
        workers[victim].kill()
        workers[victim].communicate()
        workers[victim] = start()
    for worker in workers:
        _, told = worker.communicate()
        if worker.returncode != 0:
            return f"code {worker.returncode}: {told.decode()}", kills
    if rows(folder) != whole:
        return "other rows", kills
    left = left_over(folder)
    return f"left: {left}" if left else "", kills


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--trials", type=int, default=50)
    parser.add_argument("--workers", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    chance = random.Random(given.seed)
    all_kills = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(command(given, Path(folder)), check=True, capture_output=True)
        whole = rows(Path(folder))
    for i in range(given.trials):
        with tempfile.TemporaryDirectory() as folder:
            problem, kills = trial(given, Path(folder), chance, whole)
        all_kills += kills
        if problem:
            wrong += 1
            print(f"trial {i + 1}: {problem}")
    print(f"{given.trials} trials, {all_kills} kills: {wrong or 'none'} went wrong")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
