#!/bin/sh
# run.sh build: builds the fuzz targets with clang in build/fuzz.
# run.sh TARGET SECONDS: runs one target. Fails if it finds an input that breaks the target, and writes it to build/fuzz.
# Exit code 77 (skipped): there is no clang with libFuzzer.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
folder=$root/build/fuzz

skip() {
    echo "Skipped: $*"
    exit 77
}

find_clang() {
    for compiler in clang++ clang++-19 clang++-14; do
        if command -v "$compiler" >/dev/null; then
            echo "$compiler"
            return
        fi
    done
}

has_libfuzzer() {
    echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
        "$1" -x c++ -fsanitize=fuzzer,address,undefined - -o "$folder/has_libfuzzer" 2>/dev/null
}

if [ "$1" = build ]; then
    clang=$(find_clang)
    [ -n "$clang" ] || skip "there is no clang++ (Debian: clang)"
    mkdir -p "$folder"
    has_libfuzzer "$clang" || skip "$clang has no libFuzzer (Debian: libclang-rt-14-dev or libclang-rt-19-dev)"
    cd "$root"
    # A build folder of another source folder is configured again.
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt" 2>/dev/null ||
        cmake --fresh --preset fuzz -DCMAKE_CXX_COMPILER="$clang"
    exec cmake --build "$folder"
fi

program=$folder/tests/fuzz/fuzz_$1
[ -x "$program" ] || skip "fuzz_$1 is not built"
corpus=$folder/corpus/$1
mkdir -p "$corpus"
set -- "$1" "$2" "$corpus" "$here/seeds/$1"
[ "$1" != xml ] || set -- "$@" "$root/assets" "-dict=$here/xml.dict"
# One byte of a picture can expand to 16384 pixels. OpenEXR allocates up to 2 GiB, untouched, if an attribute asks for it.
[ "$1" != picture ] || set -- "$@" -max_len=2048 -malloc_limit_mb=2048
target=$1
seconds=$2
shift 2
# An input that takes more than 10 seconds or 1 GiB is an error, too. libFuzzer's default exit code for errors, 77,
# would mean "skipped".
exec "$program" -error_exitcode=1 -timeout_exitcode=1 -timeout=10 -rss_limit_mb=1024 -max_len=8192 \
    -max_total_time="$seconds" -print_final_stats=1 -artifact_prefix="$folder/$target-" "$@"
