//! Parsers of single values on the command line.

use std::num::{ParseFloatError, ParseIntError};
use std::ops::{Range, RangeBounds};

use clap::builder::{PossibleValue, PossibleValuesParser, RangedU64ValueParser, TypedValueParser};
use frame::{Alignment, Size};
use measure::{MAX_FRAMES, MAX_REPLICATES, SIDES};
use tracer::{MAX_SAMPLES, RenderSettings};

/// Number of replicates, or a range of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Replicates {
    /// All replicates of a truth: their number.
    All(u32),
    /// Some replicates: their indices.
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

/// Parses an exposure within the limits of a shutter.
pub fn parse_exposure(text: &str) -> Result<f64, String> {
    let exposure = text
        .parse()
        .map_err(|error: ParseFloatError| error.to_string())?;
    let shutter = Alignment::Trailing.shutter(exposure);
    shutter.map_err(|error| error.to_string())?;
    Ok(exposure)
}

/// Parses the mean number of samples per pixel of a truth with the usual number of replicates.
pub fn parse_samples(text: &str) -> Result<u32, String> {
    let replicates = RenderSettings::default().replicates;
    let samples: u32 = text
        .parse()
        .map_err(|error: ParseIntError| error.to_string())?;
    // A frame has as many samples as all replicates of a truth together.
    let (each, most) = (samples / replicates, MAX_SAMPLES / replicates);
    if (1..=most).contains(&each) && each * replicates == samples {
        return Ok(samples);
    }
    let nearest = each.clamp(1, most) * replicates;
    Err(format!(
        "allowed: multiples of {replicates} up to {MAX_SAMPLES}, such as {nearest}"
    ))
}

/// Parses an even number of replicates.
pub fn parse_even(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| is_even(*count));
    count.ok_or_else(|| format!("allowed: even numbers from 2 to {MAX_REPLICATES}, such as 8"))
}

fn is_even(replicates: u32) -> bool {
    (2..=MAX_REPLICATES).contains(&replicates) && replicates.is_multiple_of(2)
}

/// Parses a number that `is_allowed` allows; refuses others with a message of what is allowed.
pub fn parse_number(
    text: &str,
    is_allowed: impl Fn(f64) -> bool,
    allowed: impl FnOnce() -> String,
) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number| is_allowed(*number));
    number.ok_or_else(|| format!("allowed: {}", allowed()))
}

/// Parses a number above 0 and at most `most`.
pub fn above_zero(most: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let is_allowed = |number| number > 0.0 && number <= most;
        parse_number(text, is_allowed, || match most {
            f64::MAX => "a number above 0".to_owned(),
            _ => format!("a number above 0 and up to {most}"),
        })
    }
}

/// Parses `640x360`.
pub fn parse_size(text: &str) -> Result<Size, String> {
    let is_allowed = |size: &Size| size.sides().iter().all(|side| SIDES.contains(side));
    let size = text.parse().ok().filter(is_allowed);
    let (least, most) = (SIDES.start(), SIDES.end());
    size.ok_or_else(|| {
        format!("allowed: WIDTHxHEIGHT, each from {least} to {most} pixels, such as 640x360")
    })
}

/// Parses `8` as all eight, or `3..6` as the replicates 3, 4 and 5.
pub fn parse_replicates(text: &str) -> Result<Replicates, String> {
    let number = |text: &str| (text.parse().ok()).filter(|number| *number <= MAX_REPLICATES);
    let parsed = match text.split_once("..") {
        None => number(text).map(Replicates::All),
        Some((first, end)) => (number(first).zip(number(end)))
            .filter(|(first, end)| first < end)
            .map(|(first, end)| Replicates::Part(first..end)),
    };
    let is_allowed = |replicates: &Replicates| match replicates {
        Replicates::All(count) => is_even(*count),
        Replicates::Part(_) => true,
    };
    parsed.filter(is_allowed).ok_or_else(|| {
        format!(
            "allowed: an even number up to {MAX_REPLICATES}, such as 8, or A..B with A below B: 3..6 is replicates 3, 4 and 5"
        )
    })
}

/// Parses a shell pattern.
pub fn parse_glob(text: &str) -> Result<glob::Pattern, String> {
    glob::Pattern::new(text)
        .map_err(|error| format!("{error}; allowed: a pattern such as 'fan/*' or '*/jump_flood:*'"))
}

/// Parses `1.2x`.
pub fn parse_ratio(text: &str) -> Result<f64, String> {
    let is_allowed = |ratio: f64| ratio > 0.0 && ratio.is_finite();
    parse_number(text.strip_suffix('x').unwrap_or(text), is_allowed, || {
        "a ratio above 0, such as 1.0x".to_owned()
    })
}

/// Upper limit on the speed of an imported model, in its unit.
const FASTEST: f64 = 1e5;

/// Parses a speed with its unit, such as `20deg/frame`.
pub fn parse_speed(
    unit: &'static str,
    example: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone {
    let is_allowed = |speed: f64| speed.abs() <= FASTEST && speed != 0.0;
    move |text| {
        parse_number(
            text.strip_suffix(unit).unwrap_or_default(),
            is_allowed,
            || {
                format!(
                    "a speed other than 0, from -{FASTEST} to {FASTEST}, with its unit, such as {example}"
                )
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_their_form_and_their_range() {
        assert_eq!(parse_size("640x360"), Ok(Size::new(640, 360)));
        assert_eq!(parse_replicates("16"), Ok(Replicates::All(16)));
        assert_eq!(parse_replicates("3..6"), Ok(Replicates::Part(3..6)));
        assert_eq!(above_zero(1.0)("0.002"), Ok(0.002));
        assert_eq!(parse_ratio("1.25x"), Ok(1.25));
        let speed = parse_speed("deg/frame", "20deg/frame");
        assert_eq!(speed("-7.5deg/frame"), Ok(-7.5));
        for wrong in "640 640x x360 0x360 640x99999 640_x_360 -1x5".split(' ') {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
        for wrong in "x 3.. ..3 3..3 6..3 3..=6 -1..2 1.5 99999".split(' ') {
            assert!(parse_replicates(wrong).is_err(), "{wrong}");
        }
        for wrong in "0 -1 nan inf low 1.1".split(' ') {
            assert!(above_zero(1.0)(wrong).is_err(), "{wrong}");
        }
        for wrong in "0x -1x x nan infx 1.0_x".split(' ') {
            assert!(parse_ratio(wrong).is_err(), "{wrong}");
        }
        for wrong in "20 20deg deg/frame nandeg/frame 20px/frame".split(' ') {
            assert!(speed(wrong).is_err(), "{wrong}");
        }
    }
}
