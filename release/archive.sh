#!/bin/sh
# Makes target/archive/shuttertruth-<version>-<target>.tar.gz: the program, completions, pages of the manual, licences and a README; and
# beside it its SHA-256. Prints the glibc that the program needs. `make archive` runs this.
#
#     release/archive.sh              for this machine
#     release/archive.sh TARGET       for another one, for which cargo can link
set -eu
cd "$(dirname "$0")/.."
host=$(rustc -vV | sed -n 's/^host: //p')
target=${1:-$host}
version=$(sed -n '/^\[workspace.package\]/,/^$/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
folder=${CARGO_TARGET_DIR:-target}
name=shuttertruth-$version-$target
out=$folder/archive

if [ "$target" = "$host" ]; then
    cargo build --release --locked --bin shuttertruth
    program=$folder/release/shuttertruth
    maker=$program
else
    cargo build --release --locked --bin shuttertruth --target "$target"
    program=$folder/$target/release/shuttertruth
    # Completions and pages are the same on every machine; one that runs here writes them.
    cargo build --release --locked --bin shuttertruth
    maker=$folder/release/shuttertruth
fi
case $target in *windows*) program=$program.exe ;; esac

rm -rf "${out:?}/$name"
mkdir -p "$out/$name/completions"
cp "$program" LICENSE-MIT LICENSE-APACHE release/README.md "$out/$name/"
"$maker" completions bash > "$out/$name/completions/shuttertruth.bash"
"$maker" completions zsh > "$out/$name/completions/_shuttertruth"
"$maker" completions fish > "$out/$name/completions/shuttertruth.fish"
"$maker" completions elvish > "$out/$name/completions/shuttertruth.elv"
"$maker" completions powershell > "$out/$name/completions/_shuttertruth.ps1"
"$maker" man --out "$out/$name/man" > /dev/null

# The same program gives the same archive: names in order, no owner, one time.
time=$(git log -1 --format=%ct 2>/dev/null || echo 0)
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$time" --mode=u=rwX,go=rX -C "$out" -cf - "$name" |
    gzip -9n > "$out/$name.tar.gz"
rm -rf "${out:?}/$name"
(cd "$out" && sha256sum "$name.tar.gz" > "$name.tar.gz.sha256")

"$maker" --version
echo "written: $out/$name.tar.gz ($(wc -c < "$out/$name.tar.gz") bytes)"
case $target in
    *linux-gnu*)
        glibc=$(objdump -T "$program" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
        echo "needs: glibc ${glibc#GLIBC_} or newer" ;;
esac
