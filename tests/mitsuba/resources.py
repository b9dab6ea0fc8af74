"""Makes the bitmaps and meshes of the scenes, from formulas."""
import struct
import zlib
from pathlib import Path

import numpy as np


def make_resources(mi, folder: Path) -> None:
    y, x = np.mgrid[0:24, 0:32]
    u, v = (x + 0.5) / 32, (y + 0.5) / 24
    colors = np.stack([0.15 + 0.7 * u, 0.2 + 0.6 * v * (1 - u), 0.8 - 0.6 * v], -1)
    colors[(x // 4 + y // 4) % 3 == 0] *= 0.4
    grey = 0.15 + 0.7 * (0.5 + 0.5 * np.sin(7 * u) * np.cos(5 * v))
    # Heights are periodic, so that a repeated bitmap has no step at its edge.
    wave = 2 * np.pi
    height = 0.5 + 0.25 * np.sin(2 * wave * u) + 0.25 * np.cos(wave * (u + 2 * v))
    slope_u = 0.35 * np.cos(2 * wave * u)
    slope_v = 0.3 * np.sin(wave * (u + 2 * v))
    normals = np.stack([-slope_u, -slope_v, np.ones_like(u)], -1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    write_png(mi, folder / "colors.png", colors)
    write_png(mi, folder / "grey.png", grey)
    write_png(mi, folder / "bump.png", height)
    write_png(mi, folder / "normals.png", 0.5 + 0.5 * normals)
    mi.Bitmap((2 * colors**2).astype(np.float32)).write(str(folder / "colors.exr"))
    mi.Bitmap(sky().astype(np.float32)).write(str(folder / "sky.exr"))

    mesh = Waves(14)
    mesh.write_obj(folder / "waves.obj")
    mesh.write_ply(folder / "waves.ply", normals=True)
    mesh.write_ply(folder / "flat.ply", normals=False)
    mesh.write_serialized(folder / "waves.serialized")
    mesh.write_attributes(folder / "attributes.ply")


def write_png(mi, path: Path, values: np.ndarray) -> None:
    if values.ndim == 2:
        values = values[..., None]
    mi.Bitmap(np.round(np.clip(values, 0, 1) * 255).astype(np.uint8)).write(str(path))


def sky() -> np.ndarray:
    """Returns a sky: bluish above, brown below, with a sun wide enough for a few samples to find it."""
    y, x = np.mgrid[0:32, 0:64]
    azimuth, zenith = (x + 0.5) / 64 * 2 * np.pi, (y + 0.5) / 32 * np.pi
    direction = np.stack([np.sin(azimuth) * np.sin(zenith), np.cos(zenith), -np.cos(azimuth) * np.sin(zenith)], -1)
    sun = np.array([0.5, 0.6, 0.62])
    near = np.clip(direction @ (sun / np.linalg.norm(sun)), 0, 1)[..., None] ** 40
    above = np.clip(direction[..., 1:2], 0, 1)
    base = np.where(direction[..., 1:2] > 0, [0.5, 0.6, 0.8], [0.25, 0.2, 0.15])
    return base * (1 - 0.5 * above) + near * np.array([14.0, 11.0, 7.0])


class Waves:
    """A wavy mesh over [-1, 1]^2 with normals and texture coordinates."""

    def __init__(self, n: int):
        v, u = (a.ravel() for a in np.mgrid[0 : n + 1, 0 : n + 1] / n)
        x, y = 2 * u - 1, 2 * v - 1
        z = 0.2 * np.sin(3 * x) * np.cos(2 * y)
        normals = np.stack([-0.6 * np.cos(3 * x) * np.cos(2 * y), 0.4 * np.sin(3 * x) * np.sin(2 * y),
                            np.ones_like(x)], -1)
        self.positions = np.stack([x, y, z], -1)
        self.normals = normals / np.linalg.norm(normals, axis=-1, keepdims=True)
        self.uvs = np.stack([u, v], -1)
        corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)[None, :]).ravel()
        self.faces = np.concatenate([np.stack([corner, corner + 1, corner + n + 2], -1),
                                     np.stack([corner, corner + n + 2, corner + n + 1], -1)])

    def write_obj(self, path: Path) -> None:
        with open(path, "w") as f:
            for p in self.positions:
                f.write("v %.6f %.6f %.6f\n" % tuple(p))
            for t in self.uvs:
                f.write("vt %.6f %.6f\n" % tuple(t))
            for n in self.normals:
                f.write("vn %.6f %.6f %.6f\n" % tuple(n))
            for a, b, c in self.faces + 1:
                f.write(f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\n")

    def write_ply(self, path: Path, normals: bool) -> None:
        columns = [self.positions] + ([self.normals] if normals else []) + [self.uvs]
        names = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals else []) + ["u", "v"]
        vertices = np.concatenate(columns, -1).astype("<f4")
        faces = np.zeros(len(self.faces), dtype=[("count", "u1"), ("index", "<i4", 3)])
        faces["count"] = 3
        faces["index"] = self.faces
        header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
        header += [f"property float {name}" for name in names]
        header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
        path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())

    def write_attributes(self, path: Path) -> None:
        """Writes a PLY file with a colour and a roughness for each vertex, and two colours for each face."""
        u, v = self.uvs.T
        colors = np.stack([0.2 + 0.6 * u, 0.7 - 0.5 * v, 0.3 + 0.3 * np.sin(9 * u * v)], -1)
        rough = (0.1 + 0.4 * v)[:, None]
        vertices = np.concatenate([self.positions, self.normals, self.uvs, colors, rough], -1).astype("<f4")
        faces = np.zeros(len(self.faces), dtype=[("count", "u1"), ("index", "<i4", 3), ("own", "<f4", 6)])
        faces["count"] = 3
        faces["index"] = self.faces
        k = np.arange(len(faces))
        faces["own"] = np.stack([k % 3 / 3, k % 5 / 5, k % 7 / 7, k % 2 / 2, k % 4 / 5, 0.5 + 0 * k], -1)
        names = ["x", "y", "z", "nx", "ny", "nz", "u", "v", "color_0", "color_1", "color_2", "rough_0"]
        header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
        header += [f"property float {name}" for name in names]
        header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        header += [f"property float {name}" for name in ["r", "g", "b", "tint_x", "tint_y", "tint_z"]]
        header += ["end_header", ""]
        path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())

    def write_serialized(self, path: Path) -> None:
        """Writes Mitsuba's serialized format, version 4: an unused mesh, this mesh, and the offsets of both."""
        unused = Waves(2)
        parts = [unused.serialized_block(), self.serialized_block()]
        offsets = [0, len(parts[0])]
        path.write_bytes(b"".join(parts) + struct.pack("<QQI", *offsets, 2))

    def serialized_block(self) -> bytes:
        has_normals, has_uvs, single_precision = 0x0001, 0x0002, 0x1000
        content = struct.pack("<I", has_normals | has_uvs | single_precision) + b"waves\0"
        content += struct.pack("<QQ", len(self.positions), len(self.faces))
        for values in (self.positions, self.normals, self.uvs):
            content += values.astype("<f4").tobytes()
        content += self.faces.astype("<u4").tobytes()
        return struct.pack("<HH", 0x041C, 4) + zlib.compress(content)
