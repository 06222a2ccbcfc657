//! Checks of numbers.

use std::fmt::Debug;
use std::ops::RangeBounds;

/// Fails unless two numbers differ by less than `tolerance`.
#[track_caller]
pub fn assert_near(found: impl Into<f64>, expected: impl Into<f64>, tolerance: f64) {
    let (found, expected) = (found.into(), expected.into());
    assert!(
        (found - expected).abs() < tolerance,
        "{found}, expected {expected} within {tolerance}"
    );
}

/// Fails unless a number is in a range.
#[track_caller]
pub fn assert_within(found: impl Into<f64>, range: impl RangeBounds<f64> + Debug) {
    let found = found.into();
    assert!(range.contains(&found), "{found}, expected in {range:?}");
}

/// Fails unless two numbers are as near as the tolerance.
#[track_caller]
pub fn expect_near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance,
        "{what}: {found}, not {expected} within {tolerance}"
    );
}
