#!/bin/sh
# ./test.sh [ctest options]: installs missing packages, builds with warnings as errors, and runs all tests without the label
# slow.
set -eu
root=$(cd "$(dirname "$0")" && pwd)
. "$root/scripts/setup.sh"

install_packages build test
build test -DTESSERA_WERROR=ON
exec ctest --test-dir "$root/build/test" -LE slow --output-on-failure --no-tests=error -j "$(nproc)" "$@"
