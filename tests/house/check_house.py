#!/usr/bin/env python3
"""Checks the structure of the sources, without a compiler:

  - Each file includes the headers of the standard library, glm and fmt whose names it uses, directly or by a project
    header that it includes. Transitive includes of these libraries differ between releases.
  - No folder includes a folder that comes later in FOLDERS. No headers include each other in a cycle.
  - A folder has at most 31 files, a file at most 400 lines.
  - No two types of one namespace have the same name.

check_house.py [--root FOLDER]    prints the faults; exit code 1 if there are any
    --fix [PATH...]               adds missing includes to all files, or to those whose paths begin with a PATH;
                                  clang-format sorts them
    --rooms                       prints the folders, their sizes and the folders that each one includes
"""

import argparse
import re
import sys
from collections import Counter, defaultdict
from pathlib import Path

sys.dont_write_bytecode = True  # writes no files into the source folder
import header_names

# Source folders in order of dependence: a file includes only files of its own folder and of earlier ones.
FOLDERS = """recon recon/solvers recon/guided recon/picture recon/metrics
    render/io render/settings render/sampling render/shapes render/surface render/trace render/scene render/mesh render/load render/film render/paths render/estimator
    render/inspect render/run render/session
    ui/gl ui/state ui/settings ui/inside ui/charts ui/panes ui/jobs ui/panels ui/viewer ui/window
    app/cli app/experiment app/report app/compare app/commands app""".split()
MAX_FILES = 31
MAX_LINES = 400

STD = header_names.table(header_names.STD) | {"initializer_list": header_names.INITIALIZER_LIST}
GLM = header_names.table(header_names.GLM)
FMT = header_names.table(header_names.FMT)
PLAIN = header_names.table(header_names.PLAIN)
SYSTEM = header_names.table(header_names.SYSTEM)

LITERALS_AND_COMMENTS = re.compile(
    r'R"(?P<end>[^()\s\\]*)\(.*?\)(?P=end)"'
    r'|"(?:[^"\\\n]|\\.)*"'
    r"|(?<![0-9a-zA-Z_])'(?:[^'\\\n]|\\.)+'"
    r"|//[^\n]*|/\*.*?\*/",
    re.S,
)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<([^>]+)>)', re.M)
QUALIFIED = re.compile(r"(?<![\w:])(?:::)?(std|glm|fmt)::(\w+)(?:::(\w+))?")
WORD = re.compile(r"(?<![\w.:])[A-Za-z_]\w*")
SYSTEM_CALL = re.compile(r"(?<![\w>:\])])::(\w+)\(")


class Source:
    def __init__(self, root, path):
        self.path = path.relative_to(root).as_posix()
        self.folder = path.parent.relative_to(root).as_posix()
        self.text = path.read_text(encoding="utf-8")
        self.own_includes = []
        self.includes = set()
        for match in INCLUDE.finditer(re.sub(r"//[^\n]*", "", self.text)):
            if match.group(1):
                self.own_includes.append(match.group(1))
            else:
                self.includes.add(match.group(2))
        self.code = LITERALS_AND_COMMENTS.sub(self._blank, self.text)
        self.code = re.sub(r"^[ \t]*#[ \t]*include[^\n]*", "", self.code, flags=re.M)

    @staticmethod
    def _blank(match):
        """Replaces a literal or comment, but keeps its line breaks, so that line numbers stay right."""
        text = match.group(0)
        return ("0" if text[0] in "\"'R" else " ") + "\n" * text.count("\n")

    def line_of(self, position):
        return self.code.count("\n", 0, position) + 1

    def is_header(self):
        return self.path.endswith(".h")


def uses_of(source):
    """Yields (position, name used, headers of which one must be included). No headers: the name is in no table."""
    for match in QUALIFIED.finditer(source.code):
        space, name, inner = match.groups()
        whole = match.group(0).lstrip(":")
        if space == "std" and name == "ranges" and inner:
            headers = ("ranges",) if inner in ("subrange", "views") or inner.endswith("_view") else STD.get(inner)
            if inner in ("begin", "end", "size", "data", "empty"):
                headers = ("ranges",)
        elif space == "std":
            headers = STD.get(name)
        elif space == "glm":
            if name in ("glm", "detail"):
                continue
            headers = GLM.get(name)
            headers = headers and headers + (header_names.ALL_OF_GLM,)
        else:
            if name == "fmt":
                continue
            headers = FMT.get(name)
        yield match.start(), whole if space == "std" and name == "ranges" else f"{space}::{name}", headers or ()
    for match in WORD.finditer(source.code):
        if match.group(0) in PLAIN:
            yield match.start(), match.group(0), PLAIN[match.group(0)]
    for match in SYSTEM_CALL.finditer(source.code):
        if match.group(1) in SYSTEM:
            yield match.start(), "::" + match.group(1), SYSTEM[match.group(1)]
    for position in braced_loops(source.code):
        yield position, "a loop over a braced list", header_names.INITIALIZER_LIST


def braced_loops(code):
    """Yields the positions of `for (... : {`."""
    for match in re.finditer(r"\bfor\s*\(", code):
        depth = 1
        for i in range(match.end(), len(code)):
            c = code[i]
            if c in "([{":
                depth += 1
            elif c in ")]}":
                depth -= 1
                if depth == 0:
                    break
            elif c == ":" and depth == 1 and code[i - 1] != ":" and code[i + 1] != ":":
                if code[i + 1:].lstrip().startswith("{"):
                    yield match.start()
                break


def missing_includes(source, sources):
    """Returns (line, name used, header to add, or None for an unknown name), once per header."""
    named = set(source.own_includes)
    own = sources.get(source.path[:-4] + ".h") if source.path.endswith(".cpp") else None
    if own:
        named |= set(own.own_includes)
    have = source.includes.union(*(sources[path].includes for path in named if path in sources))
    found = {}
    for position, name, headers in uses_of(source):
        if not headers:
            found.setdefault(name, (source.line_of(position), name, None))
        elif not have.intersection(headers):
            found.setdefault(headers[0], (source.line_of(position), name, headers[0]))
    return sorted(found.values(), key=lambda entry: entry[0])


def check_includes(sources):
    for source in sources.values():
        for line, name, header in missing_includes(source, sources):
            if header:
                yield f"{source.path}:{line}: {name} is used without <{header}>"
            else:
                yield f"{source.path}:{line}: {name} is in no table of tests/house/header_names.py"


def check_folders(sources):
    order = {folder: i for i, folder in enumerate(FOLDERS)}
    sizes = Counter(s.folder for s in sources.values() if not s.folder.startswith("tests"))
    for folder, size in sorted(sizes.items()):
        if folder not in order:
            yield f"{folder}: not in the list of folders in tests/house/check_house.py"
        if size > MAX_FILES:
            yield f"{folder}: {size} files, but a folder has at most {MAX_FILES}"
    for source in sources.values():
        for include in source.own_includes:
            included = include.rpartition("/")[0]
            if source.folder in order and order.get(included, -1) > order[source.folder]:
                yield f"{source.path}: includes {include}, which belongs to a later folder"


def check_cycles(sources):
    """Yields each cycle of includes once."""
    done, trail = set(), []

    def walk(path):
        if path in trail:
            yield "headers include each other: " + " -> ".join(trail[trail.index(path):] + [path])
        elif path not in done and path in sources:
            trail.append(path)
            for include in sources[path].own_includes:
                yield from walk(include)
            trail.pop()
            done.add(path)

    for source in sources.values():
        if source.is_header():
            yield from walk(source.path)


def check_lengths(sources):
    for source in sources.values():
        lines = source.text.count("\n")
        if lines > MAX_LINES:
            yield f"{source.path}: {lines} lines, but a file has at most {MAX_LINES}"


NAMESPACE = re.compile(r"^(?:inline\s+)?namespace\b\s*([\w:]*)\s*$")
TYPE = re.compile(r"^(?:template\s*<.*>\s*)?(?:struct|class|union|enum(?:\s+(?:class|struct))?)\s+"
                  r"(?:alignas\s*\([^)]*\)\s*)?(?:\[\[[^\]]*\]\]\s*)?(\w+)\s*(?:final\b\s*)?(?::[^:].*)?$", re.S)


def types_of(source):
    """Yields (line, qualified name) of the types that a file defines, except those within types, functions and unnamed
    namespaces."""
    code = re.sub(r"^[ \t]*#[^\n]*(?:\\\n[^\n]*)*", lambda m: "\n" * m.group(0).count("\n"), source.code, flags=re.M)
    spaces = []  # for each open brace, the namespace that it opens, or None
    start = 0
    for match in re.finditer(r"[{};]", code):
        if match.group(0) == "{":
            before = code[start:match.start()].strip()
            space = NAMESPACE.match(before)
            kind = TYPE.match(before)
            if kind and all(spaces):
                yield source.line_of(match.start()), "::".join(spaces + [kind.group(1)])
            spaces.append((space.group(1) or None) if space else None)
        elif match.group(0) == "}" and spaces:
            spaces.pop()
        start = match.end()


def check_types(sources):
    places = defaultdict(list)
    for source in sources.values():
        for line, name in types_of(source):
            places[name].append(f"{source.path}:{line}")
    for name, where in sorted(places.items()):
        if len(where) > 1:
            yield f"{name} names {len(where)} types: {', '.join(where)}"


def print_folders(sources):
    for folder in FOLDERS:
        inside = [s for s in sources.values() if s.folder == folder]
        uses = {i.rpartition("/")[0] for s in inside for i in s.own_includes} - {folder}
        uses = sorted(uses & set(FOLDERS), key=FOLDERS.index)
        print(f"{folder}: {len(inside)} files, {sum(s.text.count(chr(10)) for s in inside)} lines <- {' '.join(uses)}")


def fix(root, sources, beginnings):
    for source in sources.values():
        if not source.path.startswith(beginnings):
            continue
        headers = [header for _, _, header in missing_includes(source, sources) if header]
        if not headers:
            continue
        text = source.text
        first = re.search(r"^#include <", text, re.M) or re.search(r"^#include", text, re.M)
        at = first.start() if first else re.search(r"^#pragma once\n", text, re.M).end()
        lines = "".join(f"#include <{header}>\n" for header in headers)
        if first and not text.startswith("#include <", at):
            at = list(re.finditer(r"^#include[^\n]*\n", text, re.M))[-1].end()
        if not first:
            lines = "\n" + lines
        (root / source.path).write_text(text[:at] + lines + text[at:], encoding="utf-8")
        print(source.path)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("--fix", nargs="*", metavar="FILE")
    parser.add_argument("--rooms", action="store_true")
    options = parser.parse_args(arguments)
    paths = sorted(p for folder in ("recon", "render", "ui", "app", "tests")
                   for p in (options.root / folder).rglob("*") if p.suffix in (".h", ".cpp"))
    sources = {s.path: s for s in (Source(options.root, p) for p in paths)}
    if options.rooms:
        return print_folders(sources)
    if options.fix is not None:
        return fix(options.root, sources, tuple(options.fix) or ("",))
    faults = [fault for check in (check_includes, check_folders, check_cycles, check_lengths, check_types)
              for fault in check(sources)]
    print("\n".join(faults) if faults else f"{len(sources)} files: no faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
