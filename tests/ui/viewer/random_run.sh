#!/bin/sh
# random_run.sh tsan|asan SECONDS: the viewer under random input, in a build of its own with a sanitizer, in
# build/tsan or build/asan. Fails where there is a race, an error of memory, or a leak.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
folder=$root/build/$1

cd "$root"
# A project that was moved since is configured afresh.
grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt" 2>/dev/null || cmake --fresh --preset "$1"
cmake --build "$folder" --target random_input_test

# Mesa's own threads are not built with the sanitizer, and so do without.
export LP_NUM_THREADS=0
export TSAN_OPTIONS="suppressions=$root/tests/tsan.supp halt_on_error=1"
export UBSAN_OPTIONS="halt_on_error=1 print_stacktrace=1"
export LSAN_OPTIONS="suppressions=$root/tests/ui/lsan.supp"
export TESSERA_RANDOM_SECONDS="$2"
exec "$folder/tests/ui/random_input_test"
