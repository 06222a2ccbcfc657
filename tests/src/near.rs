//! Checks of numbers.

use std::fmt::Debug;
use std::ops::RangeBounds;

/// Fails unless two numbers differ by less than `tolerance`.
#[track_caller]
pub fn assert_near(actual: impl Into<f64>, expected: impl Into<f64>, tolerance: f64) {
    let (actual, expected) = (actual.into(), expected.into());
    assert!(
        (actual - expected).abs() < tolerance,
        "{actual}, expected {expected} within {tolerance}"
    );
}

/// Fails unless a number is in a range.
#[track_caller]
pub fn assert_within(actual: impl Into<f64>, range: impl RangeBounds<f64> + Debug) {
    let actual = actual.into();
    assert!(range.contains(&actual), "{actual}, expected in {range:?}");
}

/// Fails unless two numbers are as near as the tolerance.
#[track_caller]
pub fn expect_near(what: &str, actual: f64, expected: f64, tolerance: f64) {
    let off = (actual - expected).abs();
    assert!(
        off <= tolerance,
        "{what}: {actual}, not {expected} within {tolerance}"
    );
}
