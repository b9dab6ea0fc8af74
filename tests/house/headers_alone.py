#!/usr/bin/env python3
"""headers_alone.py BUILD [PATH...]: compiles each header alone, or those whose paths begin with a PATH, and prints those that
do not compile. Flags are those of the most similar source path in the build's compile_commands.json."""

import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("recon", "render", "ui", "app", "tests")


def flags_of(entry):
    """Returns the compiler and flags of a command, without input, output, precompiled header, dependences and -O."""
    words = entry.get("arguments") or shlex.split(entry["command"])
    while "=" in words[0] or os.path.basename(words[0]) == "ccache":
        words = words[1:]
    flags, i = [], 0
    while i < len(words):
        word = words[i]
        follower = words[i + 1] if i + 1 < len(words) else ""
        if word in ("-o", "-c", "-MF", "-MT", "-MQ") or (word == "-include" and "cmake_pch" in follower):
            i += 2
        else:
            if word not in ("-MD", "-MMD", "-Winvalid-pch") and not word.startswith("-O"):
                flags.append(word)
            i += 1
    return flags


def nearest(header, commands):
    """Returns the source whose path has the longest common prefix with the header's."""
    return max(commands, key=lambda source: len(os.path.commonprefix([str(header.with_suffix(".cpp")), source])))


def main():
    build = Path(sys.argv[1])
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        if entry["file"].endswith(".cpp") and Path(entry["file"]).is_relative_to(ROOT):
            commands.setdefault(entry["file"], entry)
    wanted = tuple(str(ROOT / path) for path in sys.argv[2:]) or (str(ROOT),)
    headers = sorted(h for folder in FOLDERS for h in (ROOT / folder).rglob("*.h") if str(h).startswith(wanted))

    def compile_alone(header):
        entry = commands[nearest(header, commands)]
        # A line of standard input includes the header, as compilers warn of #pragma once in a main file.
        return subprocess.run(
            flags_of(entry) + ["-fsyntax-only", "-x", "c++", "-"], cwd=entry["directory"], text=True,
            input=f'#include "{header.relative_to(ROOT)}"\n', stderr=subprocess.PIPE, check=False)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(compile_alone, headers))
    bad = [(h, r.stderr) for h, r in zip(headers, results) if r.returncode != 0]
    for header, message in bad:
        print(f"{header.relative_to(ROOT)} does not compile alone:\n{message}")
    print(f"{len(headers) - len(bad)} of {len(headers)} headers compile alone")
    return 1 if bad or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
