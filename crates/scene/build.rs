//! Tells the build scripts of dependents where the sources are: the tracer hashes them.

fn main() {
    let package = std::env::var("CARGO_MANIFEST_DIR").expect("cargo names the package's folder");
    println!("cargo::metadata=sources={package}/src");
    println!("cargo::rerun-if-changed=build.rs");
}
