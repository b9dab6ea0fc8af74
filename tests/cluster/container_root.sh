#!/bin/sh
# tests/cluster/container_root.sh FOLDER: the steps of Containerfile without a container engine, in a root of Debian made by
# debootstrap: what RUN says, then the program on the scene of the recipes. As root, with debootstrap installed; takes
# packages from the network, 3 GB, and as long as the program takes to build. For the limits of builds:
# CMAKE_BUILD_PARALLEL_LEVEL=2.
set -eu
here=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(realpath "$1")
root=$folder/root
mkdir -p "$root"
[ -d "$root/etc" ] || debootstrap --variant=minbase bookworm "$root"
rm -rf "$root/tessera"
mkdir -p "$root/tessera" "$root/work"
git -C "$here" ls-files -z | tar --null -C "$here" -T - -c | tar -x -C "$root/tessera"
cp "$here/assets/cornell-box.xml" "$root/work/box.xml"
cp /etc/resolv.conf "$root/etc/resolv.conf"
run=$(sed -n 's/^RUN //p' "$here/Containerfile")
entry=$(sed -n 's/^ENTRYPOINT \["\(.*\)"\]$/\1/p' "$here/Containerfile")
# The mounts go with the namespace: the folder can be removed afterwards.
unshare -m sh -euc '
    mount --bind /proc "$1/proc"
    mount --bind /dev "$1/dev"
    chroot "$1" env CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-}" sh -euc "cd /tessera && $2"
    chroot "$1" sh -euc "cd /work && $3 info box.xml"
' sh "$root" "$run" "$entry"
