"""What scripts that compare two programs have in common: their command line, and what a scene is called."""

import argparse
import sys
from pathlib import Path


def parser_of(description):
    """Takes the two programs and the scenes; further options are added by who asks."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs=2, metavar=("BEFORE", "AFTER"))
    parser.add_argument("scenes", nargs="+", type=Path)
    return parser


def parse(parser):
    """The arguments, and the options of `tessera render` that follow a --."""
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1 :]
    return parser.parse_args(arguments), options


def name_of(scene):
    """Of a file scene.xml that of its folder."""
    return scene.parent.name if scene.stem == "scene" else scene.stem
