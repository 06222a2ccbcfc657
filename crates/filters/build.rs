//! Embedded filter folders follow the disk: a new file under `shaders/` rebuilds the crate.

fn main() {
    println!("cargo::rerun-if-changed=../../shaders");
}
