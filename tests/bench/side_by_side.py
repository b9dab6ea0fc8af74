#!/usr/bin/env python3
"""Compares the render time of two programs that should render the same pictures. Both run at once on one CPU, so that
other work on the machine slows both by the same factor.

    tests/bench/side_by_side.py [--rounds N] [--cpu N] BEFORE AFTER SCENE... [-- OPTIONS OF render]

For each scene, prints each program's CPU seconds of render, their ratio, the ratio of each round, and whether the
pictures are identical files."""

import filecmp
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from two_programs import make_parser, parse, scene_name


def render_both(programs, scene, options, cpu, folder):
    """Returns the CPU seconds of each program's render."""
    runs = []
    for number, program in enumerate(programs):
        command = ["taskset", "-c", str(cpu), program, "render", scene, "--threads", "1", "--recon", "none", "-o",
                   folder / f"{number}.exr", "--stats", folder / f"{number}.json", *options]
        runs.append(
            subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        )
    messages = [run.communicate()[1] for run in runs]
    for run, message in zip(runs, messages):
        if run.returncode != 0:
            sys.exit(message)
    stats = [json.loads((folder / f"{number}.json").read_text()) for number in range(len(programs))]
    return [s["seconds"]["render"]["cpu"] for s in stats]


def main():
    parser = make_parser(__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--cpu", type=int, default=0)
    given, options = parse(parser)
    print(f"{'scene':22s}{'before':>9s}{'after':>9s}{'ratio':>8s}  rounds")
    for scene in given.scenes:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            rounds = [render_both(given.programs, scene, options, given.cpu, folder) for _ in range(given.rounds)]
            same = filecmp.cmp(folder / "0.exr", folder / "1.exr", shallow=False)
        before, after = (sum(seconds) for seconds in zip(*rounds))
        ratios = " ".join(f"{b / a:.3f}" for a, b in rounds)
        print(f"{scene_name(scene):22s}{before:9.3f}{after:9.3f}{after / before:8.3f}  {ratios}  "
              f"{'same picture' if same else 'DIFFERENT PICTURE'}", flush=True)


if __name__ == "__main__":
    main()
