//! Exports the hash of the sources.

fn main() {
    source_hash::export_source_hash();
}
