#!/usr/bin/env python3
"""Compares noise and cost of two programs that should render the same means. They take turns, seed by seed.

    venv/bin/python tests/bench/before_after.py [--seeds N] [--size WxH] [--reference FOLDER] BEFORE AFTER SCENE...
        [-- OPTIONS OF render]

Columns, for each scene:
  before, after  variance across seeds over the squared mean, averaged over the pixels
  ratio, trim    after / before; of all pixels, and without the worst 1 %
  CPU s          of render and reconstruction, before and after
  var x t        ratio of variance x CPU time; the change is an improvement if it is below 1
  mean           ratio of the pictures' means; differs from 1 if the change is biased

No reference is needed. For changes that may be biased, --reference names a folder of references, NAME.exr, made by
`tessera reference`. Then relMSE without the references' noise replaces the variance. "trim" is then relMSE with that noise,
without the worst 0.01 % of the pixels. Requires `pip install mitsuba numpy` to read EXR files.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from two_programs import make_parser, parse, scene_name

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
    """Renders a picture with one seed. Returns its RGB pixels, and the CPU seconds of render and reconstruction."""
    stats = picture.with_suffix(".json")
    call(program, "render", scene, "--threads", "1", "--seed", seed, "-o", picture, "--stats", stats, *options)
    seconds = json.loads(stats.read_text())["seconds"]
    plain = dict(mi.Bitmap(str(picture)).split())["<root>"]
    bitmap = plain.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    cpu = seconds["render"]["cpu"] + sum(r["cpu"] for r in seconds["reconstruct"])
    return np.array(bitmap).astype(float), cpu


def noise(pictures):
    """Returns the variance across pictures over the squared mean plus 0.01, averaged over all pixels, and over all but
    the worst 1 %."""
    stack = np.array(pictures)
    values = stack.var(axis=0, ddof=1).sum(-1) / ((stack.mean(axis=0) ** 2).sum(-1) + 0.01)
    return values.mean(), np.sort(values.ravel())[: int(values.size * 0.99)].mean()


def error(program, picture, reference):
    """Returns relMSE without the reference's noise, and trimmed relMSE, which contains it."""
    errors = json.loads(call(program, "compare", picture, reference, "--json"))
    return errors["relmse_floor_free"], errors["relmse_trimmed"]


def main():
    parser = make_parser(__doc__)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--size")
    parser.add_argument("--reference", type=Path, metavar="FOLDER")
    given, options = parse(parser)
    if given.size:
        options += ["--size", given.size]
    mi.set_variant("scalar_rgb")
    print(f"{'scene':22s}{'before':>9s}{'after':>9s}{'ratio':>7s}{'trim':>7s}{'CPU s':>8s}{'':>8s}{'var x t':>8s}{'mean':>8s}")
    for scene in given.scenes:
        pictures, seconds, errors = ([], []), ([], []), ([], [])
        for seed in range(1, given.seeds + 1):
            for i, program in enumerate(given.programs):
                with tempfile.TemporaryDirectory() as folder:
                    picture = Path(folder) / "picture.exr"
                    pixels, cpu = render(program, scene, seed, options, picture)
                    pictures[i].append(pixels)
                    seconds[i].append(cpu)
                    if given.reference:  # the same program computes both errors
                        reference = given.reference / f"{scene_name(scene)}.exr"
                        errors[i].append(error(given.programs[1], picture, reference))
        before, after = [np.mean(e, axis=0) for e in errors] if given.reference else map(noise, pictures)
        (ratio, trimmed), cpu = np.divide(after, before), np.sum(seconds[1]) / np.sum(seconds[0])
        print(
            f"{scene_name(scene):22s}{before[0]:9.5f}{after[0]:9.5f}{ratio:7.2f}{trimmed:7.2f}"
            f"{np.mean(seconds[0]):8.3f}{np.mean(seconds[1]):8.3f}{ratio * cpu:8.2f}"
            f"{np.mean(pictures[1]) / np.mean(pictures[0]):8.4f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
