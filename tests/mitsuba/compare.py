#!/usr/bin/env python3
"""Renders scenes with Mitsuba 3 and with Tessera's path tracer, and tests whether both images have the same mean.

    python3 -m venv venv && venv/bin/pip install mitsuba numpy
    venv/bin/python tests/mitsuba/compare.py build/test/app/tessera [--scenes FOLDER] [names ...]

Exit code 0: all images agree, 1: some do not, 77: Mitsuba is not installed.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

try:
    import mitsuba as mi
    import numpy as np
except ImportError as error:
    print(f"skipped: {error} (pip install mitsuba numpy)")
    sys.exit(77)

sys.dont_write_bytecode = True  # writes no files into the source folder
from resources import make_resources
from statistics_of_images import judge

HERE = Path(__file__).resolve().parent
RUNS = 8  # independent seeds on each side


@dataclass
class Case:
    name: str
    ours: Path  # the scene file for Tessera
    theirs: str  # the scene for Mitsuba, XML
    folder: Path  # of the files that the scene refers to
    real: bool = False  # not written for this comparison; one of the two programs may not be able to read it


def own_cases(folder: Path) -> list[Case]:
    """Returns the scenes in tests/mitsuba/scenes, written to `folder` with the files that they need."""
    make_resources(mi, folder)
    stage = (HERE / "scenes" / "stage.xml").read_text()
    inside = re.search(r"<scene[^>]*>(.*)</scene>", stage, re.DOTALL).group(1)
    cases = []
    for path in sorted((HERE / "scenes").glob("*.xml")):
        if path.name == "stage.xml":
            continue
        # The stage is pasted into both, as this test does not compare includes.
        text = re.sub(r'<include filename="stage.xml"\s*/>', lambda _: inside, path.read_text())
        (folder / path.name).write_text(text)
        cases.append(Case(path.stem, folder / path.name, text, folder))
    return cases


def real_cases(folder: Path, width: int, scratch: Path) -> list[Case]:
    """Returns the scenes FOLDER/*/scene.xml, with a small film, depth 8, and only features that both programs have."""
    cases = []
    for path in sorted(folder.glob("*/scene.xml")):
        root = ElementTree.parse(path).getroot()
        find_common_ground(root, path.parent, width)
        text = ElementTree.tostring(root, "unicode")
        ours = scratch / f"{path.parent.name}.xml"
        ours.write_text(text)
        cases.append(Case(path.parent.name, ours, text, path.parent, real=True))
    return cases


def find_common_ground(root: ElementTree.Element, folder: Path, width: int) -> None:
    """Sets integrator, sampler and film, and replaces what Mitsuba 3 does not support."""
    size = small_size(root, width)
    for parent in list(root.iter()):
        for child in list(parent):
            # Mitsuba 3 has no extEta for metals: it is 1.
            if child.tag in ("integrator", "sampler", "film") or child.get("name") in ("extEta", "ext_eta"):
                parent.remove(child)
    old = root.get("version", "").startswith("0")
    integrator = ElementTree.Element("integrator", type="path")
    ElementTree.SubElement(integrator, "integer", name="maxDepth" if old else "max_depth", value="8")
    ElementTree.SubElement(integrator, "integer", name="rrDepth" if old else "rr_depth", value="64")
    root.insert(0, integrator)
    film = ElementTree.SubElement(root.find("sensor"), "film", type="hdrfilm")
    for name, value in zip(("width", "height"), size):
        ElementTree.SubElement(film, "integer", name=name, value=str(value))
    ElementTree.SubElement(film, "rfilter", type="box")
    for element in root.iter():
        name = element.get("name")
        if element.tag == "string" and name == "filename":
            element.set("value", str((folder / element.get("value")).resolve()))
        elif element.tag == "string" and name in ("filterType", "filter_type"):
            element.set("value", "bilinear")  # Mitsuba 3 has no mipmaps
        elif element.tag == "float" and name == "gamma" and element.get("value") in ("1", "1.0"):
            element.tag = "boolean"
            element.set("name", "raw")
            element.set("value", "true")
        elif element.get("type") == "mask" and element.get("id") == "Blinds":
            # Kitchen: two sheets lie 0.00027 apart. Mitsuba's ray offset in single precision, about 0.0003 there, skips
            # the second one.
            element.find("rgb").set("value", "1")
        elif element.get("type") == "roughdiffuse":
            replace(element, "bsdf", "diffuse", keep=("reflectance",))
        elif element.get("type") == "sunsky":  # Tessera has another model
            replace(element, "emitter", "constant", keep=())


def replace(element: ElementTree.Element, tag: str, kind: str, keep: tuple) -> None:
    """Replaces a plugin by another one, which keeps only the parameters named in `keep`."""
    assert element.tag == tag
    element.set("type", kind)
    for child in list(element):
        if child.get("name") not in keep:
            element.remove(child)


def small_size(root: ElementTree.Element, width: int) -> tuple:
    """Returns the size of an image of this width with the aspect ratio of the scene's film."""
    variables = {d.get("name"): d.get("value") for d in root.iter("default")}
    film = {
        p.get("name"): int(re.sub(r"\$(\w+)", lambda m: variables[m.group(1)], p.get("value")))
        for p in root.find("sensor/film").iter("integer")
    }
    return (width, max(1, round(width * film["height"] / film["width"])))


def render_theirs(case: Case, spp: int) -> np.ndarray:
    mi.file_resolver().prepend(str(case.folder))
    scene = mi.load_string(case.theirs)
    images = [np.array(mi.render(scene, spp=spp, seed=1000 + run), dtype=np.float64) for run in range(RUNS)]
    return np.stack(images)[..., :3]


def render_ours(case: Case, program: str, spp: int, scratch: Path) -> np.ndarray:
    images = []
    for run in range(RUNS):
        output = scratch / "ours.exr"
        command = [program, "render", str(case.ours), "-m", "pt", "--spp", str(spp), "--seed", str(run),
                   "--filter", "scene", "--recon", "none", "-o", str(output)]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(result.stderr.strip().splitlines()[-1] if result.stderr else "no message")
        bitmap = mi.Bitmap(str(output)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        images.append(np.array(bitmap, dtype=np.float64))
    return np.stack(images)


def notes_of(case: Case, program: str) -> list[str]:
    """Returns the features that Tessera ignored, replaced or approximated, except those that this comparison sets."""
    result = subprocess.run([program, "info", str(case.ours)], capture_output=True, text=True)
    settled = ("the integrator",)
    _, _, notes = result.stdout.partition("ignored, replaced or approximated:")
    return [
        re.sub(r"^.*?:\d+:\d+: ", "", line.strip())
        for line in notes.splitlines()
        if line.strip() and not any(words in line for words in settled)
    ]


def compare(case: Case, options, scratch: Path) -> bool | None:
    """Returns whether the two images agree, or None for a real scene that one program cannot read."""
    try:
        notes = notes_of(case, options.tessera)
        ours = render_ours(case, options.tessera, options.spp, scratch)
        theirs = render_theirs(case, options.spp)
    except Exception as error:  # Mitsuba throws RuntimeError for most errors, and other types for some
        outcome = "skipped" if case.real else "FAILS"
        print(f"{case.name:24} {outcome}: {' '.join(str(error).split())[-160:]}", flush=True)
        return None if case.real else False
    if options.keep:
        np.savez(Path(options.keep) / f"{case.name}.npz", ours=ours.mean(0), theirs=theirs.mean(0))
    verdict = judge(ours, theirs)
    means = " ".join(f"{100 * r:+6.2f}" for r in verdict.relative)
    print(
        f"{case.name:24} {means}  {100 * verdict.noise.max():5.2f}"
        f"  {verdict.largest:6.2f} {verdict.limit:5.2f}  {verdict.mean_square:6.2f} {verdict.square_limit:5.2f}"
        f"  {'ok' if verdict.passes else 'FAILS'}" + "".join(f"\n    {note}" for note in notes[:3]),
        flush=True,
    )
    return verdict.passes


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tessera", help="the program")
    parser.add_argument("names", nargs="*", help="only scenes whose names contain one of these")
    parser.add_argument("--scenes", type=Path, help="also compare the scenes FOLDER/*/scene.xml")
    parser.add_argument("--width", type=int, default=64, help="width of the images of these scenes, in pixels")
    parser.add_argument("--spp", type=int, default=64, help=f"samples per pixel of each of the {RUNS} runs")
    parser.add_argument("--variant", default="scalar_rgb", help="variant of Mitsuba")
    parser.add_argument("--keep", help="folder for the mean images, one .npz per scene")
    return parser.parse_intermixed_args()


def main() -> int:
    options = parse_options()
    try:
        mi.set_variant(options.variant)
    except ImportError as error:
        print(f"skipped: {error}")
        return 77
    mi.set_log_level(mi.LogLevel.Error)
    print(f"Mitsuba {mi.__version__}, {RUNS} runs of {options.spp} samples per pixel for each program")
    print(f"{'scene':24} {'diff. % (r, g, b)':>20}  noise  largest |z|     mean z^2")
    with tempfile.TemporaryDirectory() as scratch:
        cases = own_cases(Path(scratch))
        if options.scenes and options.scenes.is_dir():
            cases += real_cases(options.scenes, options.width, Path(scratch))
        if options.names:
            cases = [c for c in cases if any(name in c.name for name in options.names)]
        outcomes = {c.name: compare(c, options, Path(scratch)) for c in cases}
    failed = [name for name, agrees in outcomes.items() if agrees is False]
    skipped = sum(agrees is None for agrees in outcomes.values())
    print(f"{sum(agrees is True for agrees in outcomes.values())} of {len(cases)} agree, {skipped} skipped, "
          f"{sum(os.times()[:4]):.0f} CPU seconds")
    if failed:
        print("failed: " + ", ".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
