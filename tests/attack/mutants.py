#!/usr/bin/env python3
"""Renders scenes with random faults. None may crash the program.

    tests/attack/mutants.py PROGRAM SCENE... [--count 5000] [--seed 1] [--keep FOLDER]

Each mutant is a scene with one to four faults: numbers replaced by huge, tiny, negative or malformed ones, names and types
replaced by others of the file, elements removed, doubled or nested, the end cut off, or bytes changed. A random method
renders it with 16x16 pixels within 2 GiB of memory and 20 seconds. The program must end with code 0 and a picture, or with
code 1 or 2 and a message that names the file. Prints a tally. Exit code 1: something else happened; these scenes are kept.
"""

import argparse
import collections
import random
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

NUMBERS = ["0", "-1", "1e38", "-1e38", "1e-40", "nan", "inf", "1e999", "", "0x10", "1,2,3", "99999999999", "-0", "1e-7"]
SECONDS = 20
MEMORY = 2 << 30


def change_number(text, rng):
    places = [m for m in re.finditer(r'(?<=[" ,])-?\d+\.?\d*(e-?\d+)?(?=[" ,])', text)]
    if not places:
        return text
    place = rng.choice(places)
    return text[: place.start()] + rng.choice(NUMBERS) + text[place.end() :]


def replace_word(text, rng):
    places = [m for m in re.finditer(r'(?<=")[A-Za-z_]+(?=")', text)]
    if not places:
        return text
    place = rng.choice(places)
    return text[: place.start()] + rng.choice(places).group() + text[place.end() :]


def elements(text):
    return [m for m in re.finditer(r"<(\w+)[^<>]*/>|<(\w+)[^<>]*>.*?</\2>", text, re.DOTALL)]


def remove_element(text, rng):
    found = elements(text)
    if not found:
        return text
    place = rng.choice(found)
    return text[: place.start()] + text[place.end() :]


def insert_copy(text, rng):
    """Inserts a copy of an element before, after or within another one."""
    found = elements(text)
    if not found:
        return text
    at = rng.choice([m.start() for m in re.finditer("<", text)] + [m.end() for m in re.finditer(">", text)])
    return text[:at] + rng.choice(found).group() + text[at:]


def cut_off(text, rng):
    return text[: rng.randrange(len(text))] if rng.random() < 0.2 else text


def change_bytes(text, rng):
    data = bytearray(text.encode())
    for _ in range(rng.randrange(1, 4)):
        if data:
            data[rng.randrange(len(data))] = rng.randrange(256)
    return data.decode("latin-1")


FAULTS = [change_number] * 4 + [replace_word] * 2 + [remove_element, insert_copy, cut_off, change_bytes]


def link_folder(folder, scratch):
    """Returns a new folder with links to all files of the scene's folder, such as textures and meshes."""
    place = Path(tempfile.mkdtemp(dir=scratch))
    for entry in folder.iterdir():
        (place / entry.name).symlink_to(entry.resolve())
    return place


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def judge(program, scene, method, picture):
    """Returns the outcome, in capitals if it is a failure, and the program's messages."""
    command = [program, "render", str(scene), "-m", method, "--size", "16x16", "--spp", "1", "-o", str(picture)]
    picture.unlink(missing_ok=True)
    try:
        done = subprocess.run(
            [*command, "--threads", "1"], capture_output=True, timeout=SECONDS, preexec_fn=limit_memory
        )
    except subprocess.TimeoutExpired:
        return "HANGS", ""
    message = done.stderr.decode(errors="replace")
    if done.returncode == 0:
        return ("rendered" if picture.exists() else "NO PICTURE"), message
    if done.returncode not in (1, 2):
        return f"CODE {done.returncode}", message
    if "bad_alloc" in message or not message.strip():
        return "NO REASON", message
    return ("refused" if ".xml" in message else "NO FILE NAMED"), message


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("mutants"))
    given = parser.parse_args()
    rng = random.Random(given.seed)
    tally = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.exr"
        places = {origin.parent: link_folder(origin.parent, Path(folder)) for origin in given.scenes}
        for number in range(given.count):
            origin = rng.choice(given.scenes)
            text = origin.read_text(encoding="latin-1")
            for _ in range(rng.randrange(1, 5)):
                text = rng.choice(FAULTS)(text, rng)
            mutant = places[origin.parent] / "mutant.xml"
            mutant.write_text(text, encoding="latin-1")
            verdict, message = judge(given.program, mutant, rng.choice(["pt", "pr", "gpt", "gpr"]), picture)
            tally[verdict] += 1
            if verdict.isupper() or verdict.startswith("CODE"):
                given.keep.mkdir(exist_ok=True)
                (given.keep / f"{number}.xml").write_text(text, encoding="latin-1")
                print(f"{number}: {origin}: {verdict}\n{message[-500:]}", flush=True)
    print(", ".join(f"{count} {verdict}" for verdict, count in tally.most_common()))
    sys.exit(any(v.isupper() or v.startswith("CODE") for v in tally))


if __name__ == "__main__":
    main()
