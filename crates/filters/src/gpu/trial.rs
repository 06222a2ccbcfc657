//! Trial of a filter before it is measured: every preset, and both ends of every range, on a tiny
//! frame.

use frame::{Camera, CameraPose, FAR_DEPTH, Image, Plane, Raster, Reprojection, Vectors};

use super::blur::Blur;
use super::device::Gpu;
use super::kernels::Kernels;
use crate::{Filter, FilterError, Input, Kind, Parameter, Settings, Value};

/// Sides of the frame, in pixels.
const SIDE: u32 = 16;

/// Upper limit on failures that are listed.
const MAX_LISTED: usize = 20;

/// Settings to try, their description, and the line of filter.toml that declares them.
type Trial = (Settings, String, Option<usize>);

/// Runs kernels with every preset, and with the first preset and one parameter at either end of its
/// range, or at each of its choices. The frame has 16x16 pixels: still ones, moving ones, and some
/// that move farther than the frame is wide.
///
/// # Errors
/// Lists the failures with their places in filter.toml: a pixel that is not finite or not written,
/// loops that are too long, a pass that is too slow. A filter that is a command is not run.
pub fn try_out(gpu: &Gpu, filter: &Filter) -> Result<(), FilterError> {
    if filter.command.is_some() {
        return Ok(());
    }
    let kernels = Kernels::compile(gpu, filter)?;
    let (color, velocity, depth) = make_frame();
    let velocity_z = velocity.map(|[right, _]| 0.01 * right);
    let exclusion = depth.map(|depth| f32::from(*depth < 3.0));
    let input = Input {
        color: &[&color],
        velocity: &velocity,
        velocity_next: Some(&velocity),
        velocity_z: Some(&velocity_z),
        exclusion: Some(&exclusion),
        depth: &depth,
        reprojection: Some(Reprojection::STILL),
        camera: Some(Camera::still(CameraPose::at_origin(f64::from(SIDE)))),
        exposure: 0.5,
        frames_per_second: None,
        frame_index: 0,
    };
    let mut failures = Vec::new();
    let trials = list_trials(filter)?;
    for (index, (settings, what, line)) in trials.iter().enumerate() {
        // If the default fails, so does each of its neighbours.
        if index == filter.presets.len() && !failures.is_empty() {
            break;
        }
        let blurred = Blur::with_kernels(&kernels, settings, SIDE, SIDE)
            .and_then(|mut blur| blur.run(&input));
        let error = match blurred {
            Ok(_) => continue,
            // No other value would help.
            Err(error @ (FilterError::Interrupted | FilterError::Lost { .. })) => {
                return Err(error);
            }
            Err(error) => error,
        };
        // The adapter may still be at work on a pass that was given up.
        let is_last = matches!(error, FilterError::TooSlow { .. });
        let path = filter.lines.path.display();
        let line = line.map_or(String::new(), |line| format!(":{line}"));
        failures.push(format!(
            "{path}{line}: {what} fails on a frame of {SIDE}x{SIDE} pixels: {error}"
        ));
        if is_last {
            break;
        }
    }
    if failures.is_empty() {
        Ok(())
    } else {
        Err(FilterError::Refused(shorten(failures).join("\n")))
    }
}

/// Lists every preset, then either end of every range with the first preset.
fn list_trials(filter: &Filter) -> Result<Vec<Trial>, FilterError> {
    let mut trials: Vec<Trial> = Vec::new();
    for (index, preset) in filter.presets.iter().enumerate() {
        trials.push((
            filter.settings(Some(&preset.name))?,
            format!("preset \"{}\"", preset.name),
            filter.lines.presets.get(index).copied(),
        ));
    }
    let default = trials[0].0.clone();
    for (parameter, line) in filter.parameters.iter().zip(&filter.lines.parameters) {
        for (value, which) in extreme_values(parameter) {
            let what = format!(
                "parameter \"{}\" = {value}, {which}, with preset \"{}\"",
                parameter.name, default.preset
            );
            let mut settings = default.clone();
            settings.set_value(filter, &parameter.name, value)?;
            trials.push((settings, what, Some(*line)));
        }
    }
    Ok(trials)
}

/// Lists the ends of a range or the choices, each with a description.
fn extreme_values(parameter: &Parameter) -> Vec<(Value, &'static str)> {
    let (low, high) = ("the lower end of its range", "the upper end of its range");
    match &parameter.kind {
        Kind::Integer { min, max, .. } => {
            vec![(Value::Integer(*min), low), (Value::Integer(*max), high)]
        }
        Kind::Real { min, max, .. } => vec![(Value::Real(*min), low), (Value::Real(*max), high)],
        Kind::Choice { choices } => (choices.iter())
            .map(|choice| (Value::Choice(choice.clone()), "one of its choices"))
            .collect(),
    }
}

fn shorten(mut failures: Vec<String>) -> Vec<String> {
    let more = failures.len().saturating_sub(MAX_LISTED);
    failures.truncate(MAX_LISTED);
    if more > 0 {
        failures.push(format!("and {more} more like these"));
    }
    failures.push("allowed: presets and ranges with which every pixel is written and finite; narrow the range, or make the kernel hold at its ends".into());
    failures
}

/// Makes a bright square that moves in front of a wall, and a sky: colour, velocity and depth.
fn make_frame() -> (Image, Vectors, Plane) {
    let is_square = |x: u32, y: u32| (4..10).contains(&x) && (5..11).contains(&y);
    let is_sky = |y: u32| y < 3;
    let color = Raster::from_fn(SIDE, SIDE, |x, y| {
        if is_square(x, y) {
            [8.0, 4.0, 0.5]
        } else {
            [x as f32 / 16.0, y as f32 / 16.0, 0.0]
        }
    });
    let velocity = Raster::from_fn(SIDE, SIDE, |x, y| match (is_square(x, y), y) {
        // One column moves farther than the frame is wide.
        (true, _) if x == 9 => [40.0, 25.0],
        (true, _) => [6.5, -3.0],
        (false, 0..3) => [-1.0, 0.25],
        (false, _) => [0.0, 0.0],
    });
    let depth = Raster::from_fn(SIDE, SIDE, |x, y| match is_square(x, y) {
        true => 2.0,
        false if is_sky(y) => FAR_DEPTH,
        false => 5.0,
    });
    (color, velocity, depth)
}
