#!/bin/sh
# ./run.sh [scene.xml] [options]: installs missing packages, builds, and opens the viewer (tessera view --help).
set -eu
root=$(cd "$(dirname "$0")" && pwd)
. "$root/scripts/setup.sh"

install_packages build
build release -DTESSERA_TESTS=OFF
exec "$root/build/release/app/tessera" view "$@"
