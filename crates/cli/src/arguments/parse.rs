//! Parsers of single values on the command line.

use std::ops::{Range, RangeBounds};

use clap::builder::{PossibleValue, PossibleValuesParser, RangedU64ValueParser, TypedValueParser};
use store::MAX_REPLICATES;
use suite::{MAX_FRAMES, SIDES};
use tune::Objective;

/// Number of replicates, or a part of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Replicates {
    /// All replicates of a truth, by their number.
    All(u32),
    /// Some replicates, by their indices.
    Part(Range<u32>),
}

/// Parses a value of an enum by its name.
pub fn parse_named<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    name: fn(T) -> &'static str,
    help: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let possible = (all.iter()).map(move |value| {
        let text = help(*value).trim_end_matches('.');
        PossibleValue::new(name(*value)).help(text)
    });
    PossibleValuesParser::new(possible).map(move |text| {
        let value = all.iter().find(|value| name(**value) == text);
        *value.expect("the parser knows these names alone")
    })
}

/// Parses a whole number in a range.
pub fn within<T: TryFrom<u64> + Clone + Send + Sync + 'static>(
    range: impl RangeBounds<u64>,
) -> RangedU64ValueParser<T> {
    RangedU64ValueParser::new().range(range)
}

/// Threads that one command may have.
const MAX_THREADS: u64 = 1024;

/// Parses a number of threads.
pub fn thread_count() -> RangedU64ValueParser<usize> {
    within(1..=MAX_THREADS)
}

/// Parses a number of frames of a sequence.
pub fn frame_count() -> RangedU64ValueParser<u32> {
    within(1..=u64::from(MAX_FRAMES))
}

/// Parses a number above 0 and up to another one.
pub fn above_zero(most: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number <= most => Ok(number),
        _ if most == f64::MAX => Err("allowed: a number above 0".to_owned()),
        _ => Err(format!("allowed: a number above 0 and up to {most}")),
    }
}

/// Parses `640x360`.
pub fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text
        .split_once('x')
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match parsed {
        Some((width, height)) if SIDES.contains(&width) && SIDES.contains(&height) => {
            Ok((width, height))
        }
        _ => Err(format!(
            "allowed: WIDTHxHEIGHT, each from {} to {} pixels, such as 640x360",
            SIDES.start(),
            SIDES.end()
        )),
    }
}

/// Parses `8` as all eight, `3..6` as the replicates 3, 4 and 5.
pub fn parse_replicates(text: &str) -> Result<Replicates, String> {
    let parsed = match text.split_once("..") {
        None => text.parse().ok().map(Replicates::All),
        Some((first, end)) => (first.parse().ok())
            .zip(end.parse().ok())
            .filter(|(first, end)| first < end)
            .map(|(first, end)| Replicates::Part(first..end)),
    };
    let end = |replicates: &Replicates| match replicates {
        Replicates::All(count) => *count,
        Replicates::Part(indices) => indices.end,
    };
    parsed.filter(|replicates| end(replicates) <= MAX_REPLICATES).ok_or_else(|| {
        format!(
            "allowed: a number up to {MAX_REPLICATES}, such as 8, or A..B with A below B: 3..6 is replicates 3, 4 and 5"
        )
    })
}

/// Parses a pattern as shells have it.
pub fn parse_glob(text: &str) -> Result<glob::Pattern, String> {
    glob::Pattern::new(text)
        .map_err(|error| format!("{error}; allowed: a pattern such as 'fan/*' or '*/jump_flood:*'"))
}

/// Parses `1.2x`.
pub fn parse_ratio(text: &str) -> Result<f64, String> {
    match text.strip_suffix('x').unwrap_or(text).parse::<f64>() {
        Ok(ratio) if ratio > 0.0 && ratio.is_finite() => Ok(ratio),
        _ => Err("allowed: a ratio above 0, such as 1.0x".to_owned()),
    }
}

/// Parses `20deg/frame`.
pub fn parse_degrees_per_frame(text: &str) -> Result<f64, String> {
    parse_speed(text, "deg/frame", "20deg/frame")
}

/// Parses `40px/frame`.
pub fn parse_pixels_per_frame(text: &str) -> Result<f64, String> {
    parse_speed(text, "px/frame", "40px/frame")
}

/// Upper limit on the speed of an imported model, in its unit.
const FASTEST: f64 = 1e5;

fn parse_speed(text: &str, unit: &str, example: &str) -> Result<f64, String> {
    let number = text
        .strip_suffix(unit)
        .and_then(|number| number.parse::<f64>().ok());
    match number {
        Some(speed) if speed.abs() <= FASTEST && speed != 0.0 => Ok(speed),
        _ => Err(format!(
            "allowed: a speed other than 0, from -{FASTEST} to {FASTEST}, with its unit, such as {example}"
        )),
    }
}

/// Parses an objective of a search.
pub fn parse_objective(text: &str) -> Result<Objective, String> {
    (Objective::ALL.iter().copied())
        .find(|objective| objective.name() == text)
        .ok_or_else(|| "allowed: flip, bleed, cost".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_two_numbers() {
        assert_eq!(parse_size("640x360"), Ok((640, 360)));
        for wrong in [
            "640",
            "640x",
            "x360",
            "0x360",
            "640x99999",
            "640 x 360",
            "-1x5",
        ] {
            assert!(
                parse_size(wrong).unwrap_err().contains("640x360"),
                "{wrong} must be refused"
            );
        }
    }

    #[test]
    fn replicates_are_a_number_or_a_rising_range() {
        assert_eq!(parse_replicates("16"), Ok(Replicates::All(16)));
        assert_eq!(parse_replicates("3..6"), Ok(Replicates::Part(3..6)));
        for wrong in [
            "", "x", "3..", "..3", "3..3", "6..3", "3..=6", "-1..2", "1.5",
        ] {
            assert!(
                parse_replicates(wrong).unwrap_err().contains("3..6"),
                "{wrong} must be refused"
            );
        }
    }

    #[test]
    fn a_number_is_above_zero_and_bounded() {
        assert_eq!(above_zero(1.0)("0.002"), Ok(0.002));
        for wrong in ["0", "-1", "nan", "inf", "low", "1.1"] {
            assert!(above_zero(1.0)(wrong).is_err(), "{wrong} must be refused");
        }
    }

    #[test]
    fn a_ratio_is_above_zero() {
        assert_eq!(parse_ratio("1.25x"), Ok(1.25));
        assert_eq!(parse_ratio("2"), Ok(2.0));
        for wrong in ["0x", "-1x", "x", "nan", "infx", "1.0 x"] {
            assert!(parse_ratio(wrong).unwrap_err().contains("1.0x"), "{wrong}");
        }
    }

    #[test]
    fn a_speed_has_its_unit() {
        assert_eq!(parse_degrees_per_frame("-7.5deg/frame"), Ok(-7.5));
        assert_eq!(parse_pixels_per_frame("40px/frame"), Ok(40.0));
        for wrong in [
            "20",
            "20deg",
            "deg/frame",
            "0deg/frame",
            "nandeg/frame",
            "20px/frame",
        ] {
            assert!(
                parse_degrees_per_frame(wrong)
                    .unwrap_err()
                    .contains("20deg/frame"),
                "{wrong} must be refused"
            );
        }
    }
}
