#!/usr/bin/env python3
"""Scenes that are broken in some places, as people and disks break them: none may bring the program down.

    tests/attack/mutants.py PROGRAM SCENE... [--count 5000] [--seed 1] [--keep FOLDER]

Each mutant is a scene with one to four faults: numbers replaced by huge, tiny, negative and no numbers, names and types
swapped with others of the file, elements left out, doubled or nested in each other, ends cut off, bytes turned. It is
rendered by a method chosen by chance, 16x16 pixels, with 2 GB of memory and 20 seconds. The program must end with code 0
and a picture, or with 1 (where pixels are not finite, too) or 2 and a message that names the file. Prints a tally; exit
code 1: something else happened, and such scenes are kept.
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


def change_number(text, chance):
    spots = [m for m in re.finditer(r'(?<=[" ,])-?\d+\.?\d*(e-?\d+)?(?=[" ,])', text)]
    if not spots:
        return text
    spot = chance.choice(spots)
    return text[: spot.start()] + chance.choice(NUMBERS) + text[spot.end() :]


def swap_words(text, chance):
    spots = [m for m in re.finditer(r'(?<=")[A-Za-z_]+(?=")', text)]
    if not spots:
        return text
    spot = chance.choice(spots)
    return text[: spot.start()] + chance.choice(spots).group() + text[spot.end() :]


def elements(text):
    return [m for m in re.finditer(r"<(\w+)[^<>]*/>|<(\w+)[^<>]*>.*?</\2>", text, re.DOTALL)]


def leave_out(text, chance):
    found = elements(text)
    if not found:
        return text
    spot = chance.choice(found)
    return text[: spot.start()] + text[spot.end() :]


def insert_copy(text, chance):
    """Beside another element, or within it."""
    found = elements(text)
    if not found:
        return text
    at = chance.choice([m.start() for m in re.finditer("<", text)] + [m.end() for m in re.finditer(">", text)])
    return text[:at] + chance.choice(found).group() + text[at:]


def cut_off(text, chance):
    return text[: chance.randrange(len(text))] if chance.random() < 0.2 else text


def turn_bytes(text, chance):
    data = bytearray(text.encode())
    for _ in range(chance.randrange(1, 4)):
        if data:
            data[chance.randrange(len(data))] = chance.randrange(256)
    return data.decode("latin-1")


FAULTS = [change_number] * 4 + [swap_words] * 2 + [leave_out, insert_copy, cut_off, turn_bytes]


def stand_in(folder, scratch):
    """A folder with links to all that is in the scene's, textures and meshes."""
    place = Path(tempfile.mkdtemp(dir=scratch))
    for entry in folder.iterdir():
        (place / entry.name).symlink_to(entry.resolve())
    return place


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def judge(program, scene, method, picture):
    """What happened, in a word; in capitals, what must not."""
    command = [program, "render", str(scene), "-m", method, "--size", "16x16", "--spp", "1", "-o", str(picture)]
    picture.unlink(missing_ok=True)
    try:
        done = subprocess.run(
            [*command, "--threads", "1"], capture_output=True, timeout=SECONDS, preexec_fn=limit_memory
        )
    except subprocess.TimeoutExpired:
        return "HANGS", ""
    told = done.stderr.decode(errors="replace")
    if done.returncode == 0:
        return ("rendered" if picture.exists() else "NO PICTURE"), told
    if done.returncode not in (1, 2):
        return f"CODE {done.returncode}", told
    if "bad_alloc" in told or not told.strip():
        return "NO REASON", told
    return ("refused" if ".xml" in told else "NO FILE NAMED"), told


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("mutants"))
    given = parser.parse_args()
    chance = random.Random(given.seed)
    tally = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.exr"
        places = {origin.parent: stand_in(origin.parent, Path(folder)) for origin in given.scenes}
        for number in range(given.count):
            origin = chance.choice(given.scenes)
            text = origin.read_text(encoding="latin-1")
            for _ in range(chance.randrange(1, 5)):
                text = chance.choice(FAULTS)(text, chance)
            mutant = places[origin.parent] / "mutant.xml"
            mutant.write_text(text, encoding="latin-1")
            verdict, told = judge(given.program, mutant, chance.choice(["pt", "pr", "gpt", "gpr"]), picture)
            tally[verdict] += 1
            if verdict.isupper() or verdict.startswith("CODE"):
                given.keep.mkdir(exist_ok=True)
                (given.keep / f"{number}.xml").write_text(text, encoding="latin-1")
                print(f"{number}: {origin}: {verdict}\n{told[-500:]}", flush=True)
    print(", ".join(f"{count} {verdict}" for verdict, count in tally.most_common()))
    sys.exit(any(v.isupper() or v.startswith("CODE") for v in tally))


if __name__ == "__main__":
    main()
