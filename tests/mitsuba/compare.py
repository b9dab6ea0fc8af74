#!/usr/bin/env python3
"""Renders scenes with Mitsuba 3 and with Tessera's path tracer, and tests whether both mean the same image.

    python3 -m venv venv && venv/bin/pip install mitsuba numpy
    venv/bin/python tests/mitsuba/compare.py build/test/app/tessera [--scenes FOLDER] [names ...]

Exit code 0: all agree, 1: some do not, 77: there is no Mitsuba here.
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

sys.dont_write_bytecode = True  # nothing is left in the source folder
from resources import make_resources
from statistics_of_images import judge

HERE = Path(__file__).resolve().parent
RUNS = 8  # independent seeds on each side


@dataclass
class Case:
    name: str
    ours: Path  # the scene file for Tessera
    theirs: str  # the scene for Mitsuba, XML
    folder: Path  # where its files are
    real: bool = False  # not written for this comparison: may hold what one of the two cannot read


def own_cases(folder: Path) -> list[Case]:
    """Scenes of the test with their files, in a folder made for the run."""
    make_resources(mi, folder)
    stage = (HERE / "scenes" / "stage.xml").read_text()
    inside = re.search(r"<scene[^>]*>(.*)</scene>", stage, re.DOTALL).group(1)
    cases = []
    for path in sorted((HERE / "scenes").glob("*.xml")):
        if path.name == "stage.xml":
            continue
        # The stage is put in for both: includes are not what is compared here.
        text = re.sub(r'<include filename="stage.xml"\s*/>', lambda _: inside, path.read_text())
        (folder / path.name).write_text(text)
        cases.append(Case(path.stem, folder / path.name, text, folder))
    return cases


def real_cases(folder: Path, width: int, scratch: Path) -> list[Case]:
    """Each scene.xml below a folder, small and not too deep, brought to what both programs can read."""
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
    """Sets integrator, sampler and film, and takes away what Mitsuba 3 no longer knows."""
    size = small_size(root, width)
    for parent in list(root.iter()):
        for child in list(parent):
            # The index outside of metals is 1 in Mitsuba 3.
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
            element.set("value", "bilinear")  # mipmaps are gone
        elif element.tag == "float" and name == "gamma" and element.get("value") in ("1", "1.0"):
            element.tag = "boolean"
            element.set("name", "raw")
            element.set("value", "true")
        elif element.get("type") == "mask" and element.get("id") == "Blinds":
            # Kitchen: two sheets 0.00027 apart; Mitsuba's single precision steps over the second (by 0.0003 there), and
            # sees through one where there are two: the picture gets 2.8 % brighter.
            element.find("rgb").set("value", "1")
        elif element.get("type") == "roughdiffuse":
            replace(element, "bsdf", "diffuse", keep=("reflectance",))
        elif element.get("type") == "sunsky":  # not the same model as ours
            replace(element, "emitter", "constant", keep=())


def replace(element: ElementTree.Element, tag: str, kind: str, keep: tuple) -> None:
    """Makes another plugin of one, with only these parameters of its own."""
    assert element.tag == tag
    element.set("type", kind)
    for child in list(element):
        if child.get("name") not in keep:
            element.remove(child)


def small_size(root: ElementTree.Element, width: int) -> tuple:
    """Of an image with the proportions of the scene's film."""
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
                   "--recon", "none", "-o", str(output)]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(result.stderr.strip().splitlines()[-1] if result.stderr else "no message")
        bitmap = mi.Bitmap(str(output)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        images.append(np.array(bitmap, dtype=np.float64))
    return np.stack(images)


def notes_of(case: Case, program: str) -> list[str]:
    """What Tessera did not take as it stands, without what this comparison settles itself."""
    result = subprocess.run([program, "info", str(case.ours)], capture_output=True, text=True)
    settled = ("the reconstruction filter", "the integrator")
    _, _, notes = result.stdout.partition("ignored, replaced or approximated:")
    return [
        re.sub(r"^.*?:\d+:\d+: ", "", line.strip())
        for line in notes.splitlines()
        if line.strip() and not any(words in line for words in settled)
    ]


def compare(case: Case, options, scratch: Path) -> bool | None:
    """Whether the two agree; none for a real scene that one of them cannot read."""
    try:
        notes = notes_of(case, options.tessera)
        ours = render_ours(case, options.tessera, options.spp, scratch)
        theirs = render_theirs(case, options.spp)
    except Exception as error:  # Mitsuba throws RuntimeError for most things, and others for some
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
    parser.add_argument("--scenes", type=Path, help="a folder of folders with a scene.xml, compared too")
    parser.add_argument("--width", type=int, default=64, help="of the images of those, in pixels")
    parser.add_argument("--spp", type=int, default=64, help=f"samples a pixel of each of the {RUNS} runs")
    parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba")
    parser.add_argument("--keep", help="a folder for the mean images, one .npz a scene")
    return parser.parse_intermixed_args()


def main() -> int:
    options = parse_options()
    try:
        mi.set_variant(options.variant)
    except ImportError as error:
        print(f"skipped: {error}")
        return 77
    mi.set_log_level(mi.LogLevel.Error)
    print(f"Mitsuba {mi.__version__}, {RUNS} runs of {options.spp} samples a pixel on each side")
    print(f"{'scene':24} {'off by % (r, g, b)':>20}  noise  largest |z|     mean z^2")
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
        print("not: " + ", ".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
