#!/usr/bin/env python3
"""What a change does to noise and cost, where it does nothing to means: two programs take turns, seed by seed.

    venv/bin/python tests/bench/before_after.py [--seeds N] [--size WxH] BEFORE AFTER SCENE... [-- OPTIONS OF render]

For each scene: the variance from seed to seed over the squared mean, before and after; the ratio of these, also without
the worst hundredth of the pixels; CPU seconds of render and reconstruction; the ratio of variance times CPU seconds,
below 1 where the change pays; and the ratio of the pictures' means, which says whether it is biased. There is no
reference, and so nothing to wait for. Wants `pip install mitsuba numpy`, to read EXR files.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from two_programs import name_of, parse, parser_of

try:
    import mitsuba as mi
    import numpy as np
except ImportError as error:
    sys.exit(f"{error} (pip install mitsuba numpy)")


def render(program, scene, seed, options, folder):
    """The picture of one seed, and its CPU seconds."""
    picture, stats = folder / "picture.exr", folder / "stats.json"
    command = [program, "render", scene, "--threads", "1", "--seed", str(seed), "-o", picture, "--stats", stats]
    done = subprocess.run([*map(str, command), *options], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    seconds = json.loads(stats.read_text())["seconds"]
    bitmap = mi.Bitmap(str(picture)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    cpu = seconds["render"]["cpu"] + sum(r["cpu"] for r in seconds["reconstruct"])
    return np.array(bitmap).astype(float), cpu


def noise(pictures):
    """Each pixel's variance from picture to picture over its squared mean (of dark ones, over a hundredth)."""
    stack = np.array(pictures)
    return stack.var(axis=0, ddof=1).sum(-1) / ((stack.mean(axis=0) ** 2).sum(-1) + 0.01)


def without_worst(values):
    return np.sort(values.ravel())[: int(values.size * 0.99)].mean()


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--size")
    given, options = parse(parser)
    if given.size:
        options += ["--size", given.size]
    mi.set_variant("scalar_rgb")
    print(f"{'scene':22s}{'before':>9s}{'after':>9s}{'ratio':>7s}{'99 %':>7s}{'CPU s':>8s}{'':>8s}{'pays':>7s}{'mean':>8s}")
    for scene in given.scenes:
        runs = ([], [])
        for seed in range(1, given.seeds + 1):
            for run, program in zip(runs, given.programs):
                with tempfile.TemporaryDirectory() as folder:
                    run.append(render(program, scene, seed, options, Path(folder)))
        (a, b), (s, t) = ([[r[i] for r in run] for run in runs] for i in (0, 1))
        before, after = noise(a), noise(b)
        ratio, cpu = after.mean() / before.mean(), np.sum(t) / np.sum(s)
        print(
            f"{name_of(scene):22s}{before.mean():9.5f}{after.mean():9.5f}{ratio:7.2f}"
            f"{without_worst(after) / without_worst(before):7.2f}{np.mean(s):8.3f}{np.mean(t):8.3f}{ratio * cpu:7.2f}"
            f"{np.mean(b) / np.mean(a):8.4f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
