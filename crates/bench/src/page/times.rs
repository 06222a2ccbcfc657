//! Times on a page.

use maud::{Markup, html};
use report::numbers::three_digits;

use crate::Spread;

/// Formats a time in milliseconds: `1.23`.
pub fn milliseconds(seconds: f64) -> String {
    three_digits(1e3 * seconds)
}

/// Writes the cells of a time: median and quartiles, in milliseconds.
pub fn spread(seconds: &Spread) -> Markup {
    html! {
        td { (milliseconds(seconds.median)) }
        td { (milliseconds(seconds.lower_quartile)) "–" (milliseconds(seconds.upper_quartile)) }
    }
}
