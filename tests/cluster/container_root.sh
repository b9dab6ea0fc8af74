#!/bin/sh
# tests/cluster/container_root.sh FOLDER: runs the steps of Containerfile without a container engine, in a Debian root made
# by debootstrap. After the RUN commands it runs the program on the scene of the recipes. Needs root, debootstrap, the
# network, 3 GB of disk space and the time of a build. CMAKE_BUILD_PARALLEL_LEVEL limits the build's processes.
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
# The mounts vanish with the namespace, so the folder can be removed afterwards.
unshare -m sh -euc '
    mount --bind /proc "$1/proc"
    mount --bind /dev "$1/dev"
    chroot "$1" env CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-}" sh -euc "cd /tessera && $2"
    chroot "$1" sh -euc "cd /work && $3 info box.xml"
' sh "$root" "$run" "$entry"
