#!/bin/sh
# random_run.sh tsan|asan SECONDS: builds the random input test with a sanitizer in build/tsan or build/asan, and
# runs it. Fails after a data race, a memory error or a leak.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
folder=$root/build/$1

cd "$root"
# Configures again if the project has been moved.
grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt" 2>/dev/null || cmake --fresh --preset "$1"
cmake --build "$folder" --target random_input_test

# Disables Mesa's threads, because they are not built with the sanitizer.
export LP_NUM_THREADS=0
export TSAN_OPTIONS="suppressions=$root/tests/tsan.supp halt_on_error=1"
export UBSAN_OPTIONS="halt_on_error=1 print_stacktrace=1"
export LSAN_OPTIONS="suppressions=$root/tests/ui/lsan.supp"
export TESSERA_RANDOM_SECONDS="$2"
exec "$folder/tests/ui/random_input_test"
