"""Command line and scene names, shared by scripts that compare two programs."""

import argparse
import sys
from pathlib import Path


def make_parser(description):
    """Returns a parser of two programs and scenes; callers add further options."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs=2, metavar=("BEFORE", "AFTER"))
    parser.add_argument("scenes", nargs="+", type=Path)
    return parser


def parse(parser):
    """Returns the parsed arguments, and the options of `tessera render` that follow `--`."""
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1 :]
    return parser.parse_args(arguments), options


def scene_name(scene):
    """Returns the name of a scene: that of its file, or of its folder if the file is scene.xml."""
    return scene.parent.name if scene.stem == "scene" else scene.stem
