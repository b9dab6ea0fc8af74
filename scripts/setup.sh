# Functions that run.sh and test.sh share; read by them, not run. `root` is the project's folder.

say() { printf '%s\n' "$*" >&2; }

die() {
    say "$*"
    exit 1
}

# Names of the packages of the given kinds ("build", "test").
package_names() {
    for kind in "$@"; do
        sed -n "s/^$kind //p" "$root/scripts/packages"
    done
}

# The names in an entry "a|b|c".
names_in() {
    printf '%s' "$1" | tr '|' ' '
}

# Those of the packages given that are not installed; of "a|b" one is enough.
missing_packages() {
    names=$(for entry in "$@"; do names_in "$entry"; echo; done)
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $names 2>/dev/null | sed -n 's/^installed //p')
    for entry in "$@"; do
        found=
        for name in $(names_in "$entry"); do
            ! printf '%s\n' "$installed" | grep -qxF -e "$name" || found=yes
        done
        [ -n "$found" ] || printf '%s ' "$entry"
    done
}

# The packages given, with one name in the place of each "a|b": the first that apt knows, or the first.
choose_known() {
    for entry in "$@"; do
        chosen=
        for name in $(names_in "$entry"); do
            [ -n "$chosen" ] || ! apt-cache policy "$name" | grep -q '^  Candidate: [^(]' || chosen=$name
        done
        printf '%s ' "${chosen:-${entry%%|*}}"
    done
}

# Installs what is missing of the packages of the given kinds. Asks for root only then.
install_packages() {
    wanted=$(package_names "$@")
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "This is not Debian: the packages needed are taken to be installed. By their names in Debian:"
        say $wanted
        return
    fi
    missing=$(missing_packages $wanted)
    [ -n "$missing" ] || return 0
    say "Installing packages: $missing"
    as_root=
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "This takes root, and there is no sudo. As root, please run:
    apt-get install --no-install-recommends $(choose_known $missing)"
        as_root=sudo
    fi
    # Slim systems leave documentation out, and Dear ImGui's OpenGL backend lies there.
    $as_root apt-get -q update >&2 && $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q install -y --no-install-recommends \
        -o 'Dpkg::Options::=--path-include=/usr/share/doc/libimgui-dev/*' $(choose_known $missing) >&2 ||
        die "The packages could not be installed. Debian 12 and 13 have them all."
}

# build FOLDER [CMAKE OPTIONS]: configures build/FOLDER if need be, and builds what is not up to date.
build() {
    folder=$root/build/$1
    shift
    # A project that was moved since is configured afresh.
    if [ ! -f "$folder/build.ninja" ] ||
        ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
        (cd "$root" && cmake --fresh --preset release -B "$folder" "$@" >&2) ||
            die "The project could not be configured."
    fi
    cmake --build "$folder" >&2 || die "The project could not be built."
}
