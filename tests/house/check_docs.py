#!/usr/bin/env python3
"""Checks the documents: links, anchors, lengths of lines and sizes, and that the README's picture is up to date.

check_docs.py [PROGRAM]: with the program, the picture's metadata must name the README's command and the default
reconstructions. scripts/readme-picture makes the picture with this metadata.
"""
import re
import struct
import subprocess
import sys
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
LIMIT = 120  # columns
KILOBYTES = {"README.md": 6, "docs/guide.md": 15, "docs/scenes.md": 8, "docs/theory.md": 26, "docs/reconstruction.md": 30,
             "docs/results.md": 15, "docs/decisions.md": 12, "docs/cluster.md": 5}


def anchor_of(heading):
    """Returns the anchor that a Markdown viewer makes of a heading."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def outside_code(text):
    """Yields (line number, line) outside of fenced and indented code."""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith("    "):
            yield number, line


def anchors_of(path):
    return {anchor_of(line.lstrip("#")) for _, line in outside_code(path.read_text()) if line.startswith("#")}


def check_document(path):
    text = path.read_text()
    name = path.relative_to(ROOT).as_posix()
    if len(text.encode()) > 1024 * KILOBYTES.get(name, 1000):
        yield f"{name}: has more than {KILOBYTES[name]} KB"
    for number, line in outside_code(text):
        if len(line) > LIMIT:
            yield f"{name}:{number}: is longer than {LIMIT} columns"
    prose = "\n".join(line for _, line in outside_code(text))
    for target in re.findall(r"\]\(([^)\s]+)\)", prose):
        if re.match(r"[a-z]+://", target):
            continue
        file, _, anchor = target.partition("#")
        linked = (path.parent / file).resolve() if file else path
        if not linked.exists():
            yield f"{name}: links to {target}, which does not exist"
        elif anchor and anchor not in anchors_of(linked):
            yield f"{name}: links to {target}, which has no such heading"


def png_texts(path):
    """Returns the text chunks of a PNG file."""
    data, texts, offset = path.read_bytes(), {}, 8
    while offset < len(data):
        length, kind = struct.unpack(">I4s", data[offset:offset + 8])
        body = data[offset + 8:offset + 8 + length]
        key, _, value = body.partition(b"\0")
        if kind == b"tEXt":
            texts[key.decode()] = value.decode("latin-1")
        elif kind == b"zTXt":
            texts[key.decode()] = zlib.decompress(value[1:]).decode("latin-1")
        offset += 12 + length
    return texts


def check_picture(program):
    readme = re.sub(r"\s+", " ", (ROOT / "README.md").read_text())
    texts = png_texts(ROOT / "assets/screenshot.png")
    command = texts.get("Command", "")
    if not command or command not in readme:
        yield "README.md: the command of its picture is not the one in assets/screenshot.png: run scripts/readme-picture"
    if program:
        shown = texts.get("Reconstructions", "")
        if shown != default_reconstructions(program):
            yield f"assets/screenshot.png: shows {shown or 'unknown reconstructions'}, and the defaults are " \
                  f"{default_reconstructions(program)}: run scripts/readme-picture"


def default_reconstructions(program):
    """Returns the default reconstruction of each method, such as "pt none, gpr guided"."""
    text = subprocess.run([program, "render", "--help"], capture_output=True, text=True, check=True).stdout
    return re.search(r"\(default: ([^)]*)\)", re.sub(r"\s+", " ", text))[1]


def main():
    documents = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]
    faults = [fault for path in documents for fault in check_document(path)]
    faults += check_picture(sys.argv[1] if len(sys.argv) > 1 else None)
    for fault in faults:
        print(fault)
    print(f"{len(documents)} documents: {len(faults) or 'no'} faults")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
