//! Comparison of two runs as a page.

mod page;
mod pictures;
mod runs;

pub use page::compare_page;

/// Writes a change in three digits: `+0.0123`.
pub fn signed(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value if value.abs() < 1e-4 => format!("{value:+.0e}"),
        value => {
            let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) as usize;
            format!("{value:+.digits$}")
        }
    }
}
