#!/usr/bin/env python3
"""Error at equal CPU time of Tessera and of what users would use instead: one table.

    python3 -m venv venv && venv/bin/pip install mitsuba pyoidn numpy
    venv/bin/python tests/bench/rivals.py build/release/app/tessera SCENES_FOLDER OUT [--scenes veach-ajar,kitchen]
        [--times 5,20,60] [--size 640] [--seeds 2] [--reference-spp 8192]

Methods, one thread each: G-PR `guided`; PT as sampled, denoised by Open Image Denoise; Mitsuba 3 (llvm_ad_rgb, path,
its own roulette), denoised by Open Image Denoise with noise-free albedo and normal. All have depth 8 and the box filter.
Both programs read the same scene, without what they interpret differently (tests/mitsuba/compare.py).

Times are CPU seconds of rendering. The time of the reconstruction or the denoiser is a column of its own and comes on
top. Loading and compilation of kernels are not counted. References are two independent path-traced pictures, one by
Mitsuba and one by Tessera's PT; relMSE is the mean of (I - r1)(I - r2) / (r^2 + eps), in which their noise cancels
but for the denominator. PSNR and FLIP (if flip_evaluator is installed) are of sRGB pictures and contain the noise of the
references. References need thousands of samples: with 256 in "Veach, Ajar" their noise is most of every figure. Mitsuba's
llvm variant needs LLVM 16 or newer (DRJIT_LIBLLVM_PATH).

Exit code 77: a library is missing.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

try:
    import drjit as dr
    import mitsuba as mi
    import numpy as np
    import pyoidn
except ImportError as error:
    print(f"skipped: {error} (pip install mitsuba pyoidn numpy)")
    sys.exit(77)
try:
    from flip_evaluator import evaluate as flip
except ImportError:
    flip = None

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "mitsuba"))
mi.set_variant("llvm_ad_rgb")
dr.set_thread_count(1)
from compare import find_common_ground


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def prepared(folder, name, width, out):
    """Writes a scene that both programs read alike. Returns its file."""
    path = folder / name / "scene.xml"
    root = ElementTree.parse(path).getroot()
    find_common_ground(root, path.parent.resolve(), width)
    for depth in root.iter("integer"):
        if depth.get("name") == "rr_depth":
            depth.set("value", "5")  # Mitsuba's default
    file = out / f"{name}.xml"
    file.write_text(ElementTree.tostring(root, "unicode"))
    return file


def read(file, layer=""):
    dr.set_thread_count(2)  # Mitsuba reads no EXR file with a single thread: it waits for a worker
    bitmap = mi.Bitmap(str(file))
    dr.set_thread_count(1)
    names = [channel.name for channel in bitmap.struct_()]
    wanted = [f"{layer}.{c}" if layer else c for c in "RGB"]
    return np.array(bitmap, dtype=np.float32)[..., [names.index(n) for n in wanted]]


class Tessera:
    def __init__(self, program, scene, size, out):
        self.program, self.scene, self.size, self.out = program, scene, size, out

    def render(self, *options):
        """Returns the picture and the statistics."""
        picture, stats = self.out / "picture.exr", self.out / "stats.json"
        subprocess.run([self.program, "render", self.scene, "--threads", "1", "--max-depth", "8", "--size", self.size,
                        "--stats", stats, "-o", picture, *map(str, options)],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return read(picture), json.loads(stats.read_text())

    def timed(self, method, recon, seconds, seed):
        picture, stats = self.render("-m", method, "--recon", recon, "--time", seconds, "--clock", "cpu", "--seed", seed)
        seconds = stats["seconds"]
        return picture, stats["spp"], seconds["render"]["cpu"], sum(r["cpu"] for r in seconds["reconstruct"])


class Mitsuba:
    def __init__(self, scene):
        self.scene = mi.load_file(str(scene))
        features = mi.load_dict({"type": "aov", "aovs": "albedo:albedo,normal:sh_normal"})
        guide = np.array(mi.render(self.scene, integrator=features, spp=64), dtype=np.float32)
        self.albedo, self.normal = guide[..., -6:-3].copy(), guide[..., -3:].copy()
        self.render(1, 0)  # compiles the kernels
        self.seconds_per_sample = self.render(4, 1)[1] / 4

    def render(self, spp, seed):
        begin = cpu_seconds()
        image = mi.render(self.scene, spp=spp, seed=seed)
        dr.eval(image)
        dr.sync_thread()
        return np.array(image, dtype=np.float32)[..., :3], cpu_seconds() - begin

    def timed(self, seconds, seed):
        spp = max(1, round(seconds / self.seconds_per_sample))
        image, used = self.render(spp, 100 + seed)
        begin = cpu_seconds()
        image = np.asarray(pyoidn.denoise(np.ascontiguousarray(image), albedo=self.albedo, normal=self.normal, hdr=True))
        return image, spp, used, cpu_seconds() - begin

    def reference(self, spp):
        """The mean of several renders, as one of many samples takes too much memory."""
        chunk = 64
        images = [self.render(min(chunk, spp), 10_000 + i)[0].astype(np.float64) for i in range(max(1, spp // chunk))]
        return np.mean(images, axis=0)


def srgb(image):
    image = np.clip(image, 0, 1)
    return np.where(image <= 0.0031308, 12.92 * image, 1.055 * image ** (1 / 2.4) - 0.055)


def errors(image, one, other):
    reference = (one + other) / 2
    found = {}
    for epsilon in (0.01, 0.001):
        error = ((image - one) * (image - other) / (reference ** 2 + epsilon)).mean(-1)
        found[f"relMSE {epsilon}"] = error.mean()
        found[f"trimmed {epsilon}"] = np.sort(error, axis=None)[: -max(1, error.size // 1000)].mean()
    found["PSNR"] = -10 * np.log10(((srgb(image) - srgb(reference)) ** 2).mean())
    if flip:
        found["FLIP"] = flip(srgb(reference).astype(np.float32), srgb(image).astype(np.float32), "LDR")[1]
    return found


def cached(file, make):
    if not file.exists():
        np.save(file, make())
    return np.load(file).astype(np.float64)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--scenes", default="veach-ajar,kitchen")
    parser.add_argument("--times", default="5,20,60")
    parser.add_argument("--size", type=int, default=640, help="width in pixels")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--reference-spp", type=int, default=8192)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("TESSERA_OIDN", str(Path(pyoidn.__file__).parent))
    rows = []
    for name in options.scenes.split(","):
        scene = prepared(options.folder, name, options.size, options.out)
        rival = Mitsuba(scene)
        height, width = rival.albedo.shape[:2]
        ours = Tessera(options.program, scene, f"{width}x{height}", options.out)
        key = f"{name}-{width}x{height}-{options.reference_spp}"
        one = cached(options.out / f"{key}-mitsuba.npy", lambda: rival.reference(options.reference_spp))
        other = cached(options.out / f"{key}-tessera.npy",
                       lambda: ours.render("-m", "pt", "--recon", "none", "--spp", options.reference_spp,
                                           "--seed", 999_983, "--path-guiding", "off")[0])
        print(f"{name}: mean of Tessera's reference / Mitsuba's {other.mean() / one.mean():.4f}", flush=True)
        for seconds in map(float, options.times.split(",")):
            methods = {"Tessera G-PR, guided": lambda seed: ours.timed("gpr", "guided", seconds, seed),
                       "Tessera PT + OIDN": lambda seed: ours.timed("pt", "oidn", seconds, seed),
                       "Mitsuba 3 + OIDN": lambda seed: rival.timed(seconds, seed)}
            for method, run in methods.items():
                found = [run(seed + 1) for seed in range(options.seeds)]
                mean = {k: float(np.mean([errors(f[0], one, other)[k] for f in found]))
                        for k in errors(found[0][0], one, other)}
                row = {"scene": name, "seconds": seconds, "method": method, "spp": float(np.mean([f[1] for f in found])),
                       "render s": float(np.mean([f[2] for f in found])),
                       "denoise s": float(np.mean([f[3] for f in found])), **mean}
                rows.append(row)
                print("  " + ", ".join(f"{k} {v:.4g}" if isinstance(v, float) else str(v) for k, v in row.items()),
                      flush=True)
    (options.out / "rivals.json").write_text(json.dumps({"mitsuba": mi.__version__, "pyoidn": pyoidn.__version__ if
                                                         hasattr(pyoidn, "__version__") else "", "rows": rows}, indent=1))
    print_table(rows)


def print_table(rows):
    times = sorted({r["seconds"] for r in rows})
    print("\n| relMSE / PSNR / FLIP | " + " | ".join(f"{t:g} s" for t in times) + " |")
    print("|---|" + "---|" * len(times))
    for scene in dict.fromkeys(r["scene"] for r in rows):
        for method in dict.fromkeys(r["method"] for r in rows):
            cells = []
            for t in times:
                r = next(r for r in rows if (r["scene"], r["method"], r["seconds"]) == (scene, method, t))
                cells.append(f"{r['relMSE 0.01']:.4f} / {r['PSNR']:.1f} / {r.get('FLIP', float('nan')):.3f} ({r['spp']:.0f})")
            print(f"| {scene}: {method} | " + " | ".join(cells) + " |")


main()
