//! Files that a shader includes or imports, each from the filter's folder, as copies for a compiler.

mod collect;
mod directives;
mod plain_text;

pub use collect::{collect, stays_below};
