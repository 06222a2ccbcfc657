#!/bin/sh
# Builds the image of Containerfile twice, measures with both, and compares run.json byte for byte. `make image` runs this, after
# `make archive`. Needs buildah, as root. BASE names another base image than Debian's; STORE another folder for images.
set -eu
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
store=${STORE:-$work/store}
buildah="buildah --root $store --runroot $work/run --storage-driver vfs"

for name in one two; do
    # Neither takes layers of the other.
    $buildah build --quiet --no-cache --isolation chroot --format oci ${BASE:+--build-arg "BASE=$BASE"} --tag "shuttertruth:$name" . >&2
    container=$($buildah from --pull-never "localhost/shuttertruth:$name")
    mkdir "$work/$name"
    $buildah run --isolation chroot --volume "$work/$name:/work" "$container" -- \
        shuttertruth check fan --filter mcguire:paper --quiet --out /work/out
done
for file in run.json fan/frame.exr fan/truth_centred.exr fan/mcguire_paper/output.exr; do
    cmp "$work/one/out/$file" "$work/two/out/$file"
    echo "equal in both images: $file"
done
