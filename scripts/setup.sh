# Functions of run.sh and test.sh, which source this file. `root` is the project's folder.

say() { printf '%s\n' "$*" >&2; }

die() {
    say "$*"
    exit 1
}

# Prints the names of the packages of the given kinds ("build", "test").
package_names() {
    for kind in "$@"; do
        sed -n "s/^$kind //p" "$root/scripts/packages"
    done
}

# Prints the names in an entry "a|b|c".
names_in() {
    printf '%s' "$1" | tr '|' ' '
}

# Prints the given packages that are not installed; of "a|b" one is enough.
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

# Prints the given packages. Each "a|b" is replaced by the first name that apt knows, or else by its first name.
choose_known() {
    for entry in "$@"; do
        chosen=
        for name in $(names_in "$entry"); do
            [ -n "$chosen" ] || ! apt-cache policy "$name" | grep -q '^  Candidate: [^(]' || chosen=$name
        done
        printf '%s ' "${chosen:-${entry%%|*}}"
    done
}

# Installs missing packages of the given kinds. Uses root only if there are any.
install_packages() {
    wanted=$(package_names "$@")
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "This is not Debian. Assuming that these packages are installed (Debian's names):"
        say $wanted
        return
    fi
    missing=$(missing_packages $wanted)
    [ -n "$missing" ] || return 0
    say "Installing packages: $missing"
    as_root=
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "Installing packages needs root, and there is no sudo. As root, please run:
    apt-get install --no-install-recommends $(choose_known $missing)"
        as_root=sudo
    fi
    # Slim systems exclude documentation, but Dear ImGui's OpenGL backend is installed there.
    $as_root apt-get -q update >&2 && $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q install -y --no-install-recommends \
        -o 'Dpkg::Options::=--path-include=/usr/share/doc/libimgui-dev/*' $(choose_known $missing) >&2 ||
        die "The packages could not be installed. Debian 12 and 13 provide all of them."
}

# build FOLDER [CMAKE OPTIONS]: configures build/FOLDER if necessary, and builds it.
build() {
    folder=$root/build/$1
    shift
    # A build folder of another source folder is configured again.
    if [ ! -f "$folder/build.ninja" ] ||
        ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
        (cd "$root" && cmake --fresh --preset release -B "$folder" "$@" >&2) ||
            die "The project could not be configured."
    fi
    cmake --build "$folder" >&2 || die "The project could not be built."
}
