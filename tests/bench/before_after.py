#!/usr/bin/env python3
"""What a change does to noise and cost, where it does nothing to means: two programs take turns, seed by seed.

    venv/bin/python tests/bench/before_after.py [--seeds N] [--size WxH] [--reference FOLDER] BEFORE AFTER SCENE...
        [-- OPTIONS OF render]

For each scene: the variance from seed to seed over the squared mean, before and after; the ratio of these, also without
the worst hundredth of the pixels; CPU seconds of render and reconstruction; the ratio of variance times CPU seconds,
below 1 where the change pays; and the ratio of the pictures' means, which says whether it is biased. There is no
reference, and so nothing to wait for. For changes that may be biased, --reference names a folder of files of `tessera
reference`, NAME.exr: relMSE to these, without their noise, takes the place of the variance (trimmed: with it, without
the worst ten-thousandth of the pixels). Wants `pip install mitsuba numpy`, to read EXR files.
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


def call(*command):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done.stdout


def render(program, scene, seed, options, picture):
    """Renders the picture of one seed. Returns the pixels of its plain RGB, and its CPU seconds."""
    stats = picture.with_suffix(".json")
    call(program, "render", scene, "--threads", "1", "--seed", seed, "-o", picture, "--stats", stats, *options)
    seconds = json.loads(stats.read_text())["seconds"]
    plain = dict(mi.Bitmap(str(picture)).split())["<root>"]
    bitmap = plain.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    cpu = seconds["render"]["cpu"] + sum(r["cpu"] for r in seconds["reconstruct"])
    return np.array(bitmap).astype(float), cpu


def noise(pictures):
    """The variance from picture to picture over the squared mean (of dark pixels, over a hundredth), the mean over
    pixels; and without the worst hundredth of them."""
    stack = np.array(pictures)
    values = stack.var(axis=0, ddof=1).sum(-1) / ((stack.mean(axis=0) ** 2).sum(-1) + 0.01)
    return values.mean(), np.sort(values.ravel())[: int(values.size * 0.99)].mean()


def error(program, picture, reference):
    """relMSE without the reference's noise, and with it, but without the worst pixels."""
    errors = json.loads(call(program, "compare", picture, reference, "--json"))
    return errors["relmse_floor_free"], errors["relmse_trimmed"]


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--size")
    parser.add_argument("--reference", type=Path, metavar="FOLDER")
    given, options = parse(parser)
    if given.size:
        options += ["--size", given.size]
    mi.set_variant("scalar_rgb")
    print(f"{'scene':22s}{'before':>9s}{'after':>9s}{'ratio':>7s}{'trim':>7s}{'CPU s':>8s}{'':>8s}{'pays':>7s}{'mean':>8s}")
    for scene in given.scenes:
        pictures, seconds, errors = ([], []), ([], []), ([], [])
        for seed in range(1, given.seeds + 1):
            for i, program in enumerate(given.programs):
                with tempfile.TemporaryDirectory() as folder:
                    picture = Path(folder) / "picture.exr"
                    pixels, cpu = render(program, scene, seed, options, picture)
                    pictures[i].append(pixels)
                    seconds[i].append(cpu)
                    if given.reference:  # by one program, so that both are judged alike
                        reference = given.reference / f"{name_of(scene)}.exr"
                        errors[i].append(error(given.programs[1], picture, reference))
        before, after = [np.mean(e, axis=0) for e in errors] if given.reference else map(noise, pictures)
        (ratio, trimmed), cpu = np.divide(after, before), np.sum(seconds[1]) / np.sum(seconds[0])
        print(
            f"{name_of(scene):22s}{before[0]:9.5f}{after[0]:9.5f}{ratio:7.2f}{trimmed:7.2f}"
            f"{np.mean(seconds[0]):8.3f}{np.mean(seconds[1]):8.3f}{ratio * cpu:7.2f}"
            f"{np.mean(pictures[1]) / np.mean(pictures[0]):8.4f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
