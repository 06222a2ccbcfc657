#!/bin/sh
# Runs the Godot of a Debian that lies in the folder ROOT, on a screen of its own, with the files of this folder and those beside ROOT:
#
#     engines/godot/debian.sh ROOT ARGUMENT ..
#
# As root, in a mount namespace that ends with it.
set -eu
exec unshare --mount sh -euc '
    root=$1 && shift
    for folder in /proc /dev "$PWD" "$(dirname "$root")"; do
        mkdir -p "$root$folder"
        mount --rbind "$folder" "$root$folder"
    done
    exec chroot "$root" env -u VK_DRIVER_FILES HOME=/tmp XDG_RUNTIME_DIR=/tmp xvfb-run --auto-servernum \
        godot --rendering-driver vulkan --audio-driver Dummy "$@"
' sh "$@"
