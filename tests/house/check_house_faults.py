#!/usr/bin/env python3
"""Tests check_house.py: it reports no fault in a small source tree, and the one fault in each of its variants."""

import contextlib
import io
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # writes no files into the source folder
import check_house

SOURCES = {
    "recon/image.h": "#pragma once\n\n#include <vector>\n\n#include <glm/vec2.hpp>\n\n"
                     "namespace tessera {\nstruct Image {\n    struct Row {};\n    std::vector<float> pixels;\n};\n}\n",
    "recon/image.cpp": '#include "recon/image.h"\n\nnamespace tessera {\nnamespace {\nstruct Part {};\n}\n'
                       'std::vector<float> part(); // std::string\nconst char* text = "std::map"; char quote = \'"\';\n'
                       'const char* raw = R"x(std::set " )x";\n}\n',
    "recon/blur.cpp": '#include "recon/image.h"\n\nnamespace tessera {\nnamespace {\nstruct Part {};\n}\n'
                      "std::vector<int> size(glm::ivec2);\n}\n",
    "render/scene/scene.h": '#pragma once\n\n#include "recon/image.h"\n\nnamespace tessera {\nclass Scene {\n'
                            "    struct Row {};\n    Image image;\n};\n}\n",
}

# Files that replace or extend those of SOURCES, and the fault that is expected; None: no fault.
INTERRUPT = '#include <csignal>\n\nvoid reset() {\n    for (int signal : {%s})\n        std::signal(signal, nullptr);\n}\n'
CASES = [
    ({}, None),
    # Newer standard libraries do not compile this file, as <csignal> does not include <initializer_list>.
    ({"app/interrupt.cpp": INTERRUPT % "SIGINT, SIGTERM"},
     "app/interrupt.cpp:4: a loop over a braced list is used without <initializer_list>"),
    ({"app/interrupt.cpp": "#include <initializer_list>\n" + INTERRUPT % "SIGINT, SIGTERM"}, None),
    ({"app/a.cpp": "int a = std::move(1);\n"}, "app/a.cpp:1: std::move is used without <utility>"),
    ({"app/a.cpp": "#include <algorithm>\nauto a = std::ranges::find(b, 1);\n"}, None),
    ({"app/a.cpp": "auto a = std::ranges::find(b, 1);\n"},
     "app/a.cpp:1: std::ranges::find is used without <algorithm>"),
    ({"app/a.cpp": "float a = glm::dot(b, b);\n"}, "app/a.cpp:1: glm::dot is used without <glm/geometric.hpp>"),
    ({"app/a.cpp": "auto a = fmt::format(\"\");\n"}, "app/a.cpp:1: fmt::format is used without <fmt/core.h>"),
    ({"app/a.cpp": "int a = errno;\n"}, "app/a.cpp:1: errno is used without <cerrno>"),
    ({"app/a.cpp": "int a = ::getpid();\n"}, "app/a.cpp:1: ::getpid is used without <unistd.h>"),
    ({"app/a.cpp": "std::no_such_name a;\n"},
     "app/a.cpp:1: std::no_such_name is in no table of tests/house/header_names.py"),
    # Includes of a project header count if the file includes that header directly.
    ({"app/a.cpp": '#include "recon/image.h"\nstd::vector<int> a;\n'}, None),
    ({"app/a.cpp": '#include "render/scene/scene.h"\nstd::vector<int> a;\n'},
     "app/a.cpp:2: std::vector is used without <vector>"),
    ({"recon/image.cpp": '#include "render/scene/scene.h"\n'},
     "recon/image.cpp: includes render/scene/scene.h, which belongs to a later folder"),
    ({"render/cellar/a.cpp": ""}, "render/cellar: not in the list of folders in tests/house/check_house.py"),
    ({"recon/image.h": '#pragma once\n#include "recon/pixel.h"\n#include <vector>\n#include <glm/vec2.hpp>\n',
      "recon/pixel.h": '#pragma once\n#include "recon/image.h"\n'},
     "headers include each other: recon/image.h -> recon/pixel.h -> recon/image.h"),
    ({f"recon/part_{i}.cpp": "" for i in range(28)}, None),
    ({f"recon/part_{i}.cpp": "" for i in range(29)}, "recon: 32 files, but a folder has at most 31"),
    ({"app/a.cpp": "//\n" * 400}, None),
    ({"app/a.cpp": "//\n" * 401}, "app/a.cpp: 401 lines, but a file has at most 400"),
    ({"ui/gl/a.h": "#pragma once\nnamespace tessera {\nenum class Image : char { a };\n}\n"},
     "tessera::Image names 2 types: recon/image.h:8, ui/gl/a.h:3"),
    ({"ui/gl/a.h": "#pragma once\nnamespace tessera {\ntemplate <class T>\nclass Image final : public T {};\n}\n"},
     "tessera::Image names 2 types: recon/image.h:8, ui/gl/a.h:4"),
    ({"ui/gl/a.h": "#pragma once\nnamespace tessera {\nstruct Image;\nstruct Image* image(const Image&);\n"
                   "namespace inner {\nstruct Image {};\n}\n}\n"}, None),
]


def faults_in(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (SOURCES | files).items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            failed = check_house.main(["--root", folder])
        return output.getvalue().splitlines() if failed else []


def main():
    bad = 0
    for files, expected in CASES:
        faults = faults_in(files)
        if faults != ([expected] if expected else []):
            bad += 1
            print(f"expected: {expected}\nfound:    {faults}")
    print(f"{len(CASES) - bad} of {len(CASES)} source trees give the expected result")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
