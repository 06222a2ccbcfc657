#!/bin/sh
# Prints what naga makes of each module. Needs spirv-tools, and the command of naga: cargo install naga-cli@30.0.1.
cd "$(dirname "$0")" || exit 1
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
for module in *.spvasm; do
    echo "== $module"
    head -1 "$module"
    spirv-as "$module" -o "$work/in.spv" && spirv-val "$work/in.spv"
    naga "$work/in.spv" "$work/out.wgsl" && sed -n '/switch/,/^    }/p' "$work/out.wgsl"
    naga "$work/in.spv" "$work/out.spv" && spirv-val "$work/out.spv"
done
