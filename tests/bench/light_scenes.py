#!/usr/bin/env python3
"""Measures errors of PT and G-PR on small scenes with several kinds of lights.

light_scenes.py FOLDER PROGRAM [PROGRAM...]

Prints the mean relMSE of three seeds at 16 samples per pixel for each program, and the ratio of the last to the first.
The scenes are written to FOLDER. References that are missing there are rendered by the last program (PT, 4096 samples
per pixel).
"""

import json
import subprocess
import sys
from pathlib import Path

HEAD = """<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="4"/></integrator>
<sensor type="perspective"><float name="fov" value="45"/>
<transform name="to_world"><lookat origin="0,2,6" target="0,0.7,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="160"/><integer name="height" value="90"/></film></sensor>
<bsdf type="twosided" id="w"><bsdf type="diffuse"><rgb name="reflectance" value="0.7"/></bsdf></bsdf>
<shape type="cube"><transform name="to_world"><scale x="0.6" y="0.8" z="0.6"/><rotate y="1" angle="30"/>
<translate x="-1" y="0.8" z="-0.5"/></transform><ref id="w"/></shape>
<shape type="sphere"><point name="center" x="1" y="0.7" z="0.3"/><float name="radius" value="0.7"/><ref id="w"/></shape>
"""


def shape(kind, steps, rest='<ref id="w"/>'):
    return f'<shape type="{kind}"><transform name="to_world">{steps}</transform>{rest}</shape>\n'


def floor(size):
    return shape("rectangle", f'<rotate x="1" angle="-90"/><scale value="{size}"/>')


def lamp(size, place, radiance):
    emitter = f'<emitter type="area"><rgb name="radiance" value="{radiance}"/></emitter>'
    return shape(
        "rectangle", f'<rotate x="1" angle="90"/><scale value="{size}"/><translate value="{place}"/>', emitter
    )


def spot(intensity, origin, target):
    return (
        f'<emitter type="spot"><rgb name="intensity" value="{intensity}"/><float name="cutoff_angle" value="25"/>'
        f'<transform name="to_world"><lookat origin="{origin}" target="{target}" up="0,0,1"/></transform></emitter>\n'
    )


def point(x, y, z, intensity):
    return (
        f'<emitter type="point"><point name="position" x="{x}" y="{y}" z="{z}"/>'
        f'<rgb name="intensity" value="{intensity}"/></emitter>\n'
    )


def sky(radiance):
    return f'<emitter type="constant"><rgb name="radiance" value="{radiance}"/></emitter>\n'


ROOM = shape("cube", '<scale value="8"/><translate y="7.99"/>')
SUN = (
    '<emitter type="directional"><vector name="direction" x="0.3" y="-1" z="-0.2"/>'
    '<rgb name="irradiance" value="0.5"/></emitter>'
)
GRID = range(-18, 19, 6)
SCENES = {
    "sky and two spots": floor(30) + sky(0.1) + spot(60, "-3,5,2", "-1,0,0") + spot(60, "3,5,2", "1,0,0"),
    "sky and a lamp": floor(50) + sky(0.05) + lamp(0.3, "0,4,0", 60),
    "sun and two lamps": floor(20) + SUN + lamp(0.2, "-1.5,3,1", 60) + lamp(0.2, "1.5,3,1", 30),
    "a strong lamp in a box": ROOM
    + lamp(0.3, "0,4,0", 20)
    + shape("cube", '<translate x="5" y="3" z="-5"/>')
    + point(5, 3, -5, 2000),
    "a lamp in a closed room": ROOM + sky(5) + lamp(0.3, "0,5,0", 30),
    "49 points": floor(40) + "".join(point(x, 2.5, z, 3) for x in GRID for z in GRID),
    "a small lamp and a far one": floor(30) + lamp(0.1, "0,2.5,0.5", 40) + lamp(5, "0,25,-20", 50),
    "five spots": floor(20) + "".join(spot(20 * (i + 1), f"{x},5,1", f"{x},0,0") for i, x in enumerate(range(-4, 5, 2))),
}


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def error(program, scene, method, reference, picture):
    total = 0
    for seed in (1, 2, 3):
        norm = "none" if method == "pt" else "weighted"
        run(program, "render", scene, "-m", method, "--spp", 16, "--seed", seed, "--recon", norm, "-o", picture)
        total += json.loads(run(program, "compare", picture, reference, "--json"))["relmse"] / 3
    return total


def main():
    folder, programs = Path(sys.argv[1]), sys.argv[2:]
    folder.mkdir(parents=True, exist_ok=True)
    for name, body in SCENES.items():
        scene = folder / f"{name.replace(' ', '-')}.xml"
        reference = scene.with_suffix(".ref.exr")
        scene.write_text(HEAD + body + "</scene>\n")
        if not reference.exists():
            run(programs[-1], "reference", scene, "-m", "pt", "--spp", 4096, "-o", reference)
        for method in ("pt", "gpr"):
            errors = [error(p, scene, method, reference, folder / "picture.exr") for p in programs]
            print(f"{name:27s} {method:3s}", *(f"{e:.5f}" for e in errors), f"{errors[-1] / errors[0]:.3f}", flush=True)


if __name__ == "__main__":
    main()
