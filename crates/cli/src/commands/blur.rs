//! The command `blur`.

use std::path::Path;

use filters::{Convention, FilterError, Input};
use frame::{Camera, ExrFile, Image, Plane, Reprojection, Vectors, read_exr, write_exr};
use suite::{Error, FilterChoice, Runner, open_gpu, printable_path};

use super::convention::read_convention;
use super::render_settings::check_exposure;
use crate::arguments::BlurArgs;
use crate::output::print::print;
use crate::output::progress::make_silent_monitor;
use crate::selection::select_filters;

/// Runs one filter on one frame file and writes its colour.
pub fn execute(args: &BlurArgs) -> Result<(), Error> {
    let choice = select_filter(args)?;
    let convention = read_convention(args.convention.as_deref())?;
    let buffers = read_buffers(&args.frame, args.exposure, &convention)?;
    let choice = choice.scaled_to(buffers.picture_width());
    let gpu = open_gpu(
        std::slice::from_ref(&choice),
        args.adapter.adapter.as_deref(),
        make_silent_monitor(),
    )?;
    let (width, height) = (buffers.color.width, buffers.color.height);
    let mut runner = Runner::new(
        gpu.as_ref(),
        &choice,
        (width, height),
        make_silent_monitor(),
    )?;
    let input = Input {
        color: &[&buffers.color],
        velocity: &buffers.velocity,
        depth: &buffers.depth,
        reprojection: buffers.reprojection,
        camera: buffers.camera,
        exposure: buffers.exposure,
        frame_index: args.frame_index,
    };
    let outputs = runner.run(&input).map_err(|error| match error {
        FilterError::Input { reason, .. } => {
            Error::Usage(format!("{}: {reason}", args.frame.display()))
        }
        other => other.into(),
    })?;
    let mut file = ExrFile::new(width, height);
    file.push_color("", &convention.convert_color(&outputs[0]));
    file.set("kind", "output");
    file.set("filter", choice.name());
    file.set("program", suite::PROGRAM);
    if let Some(gpu) = &gpu {
        file.set("adapter", &gpu.adapter.name);
    }
    file.set("exposure", buffers.exposure);
    file.set("alignment", choice.filter.alignment);
    write_exr(&args.out, &file)?;
    print(&format!("{}\n", printable_path(&args.out)))
}

fn select_filter(args: &BlurArgs) -> Result<FilterChoice, Error> {
    let names = [args.filter.clone()];
    let mut filters = select_filters(
        &names,
        args.preset.as_deref(),
        &args.set,
        args.programs.programs(),
    )?;
    Ok(filters.remove(0).as_written(args.as_written))
}

/// Buffers of a frame file that a filter needs. Any OpenEXR file with these channels will do.
struct Buffers {
    color: Image,
    velocity: Vectors,
    depth: Plane,
    reprojection: Option<Reprojection>,
    camera: Option<Camera>,
    exposure: f64,
    guard_band: u32,
}

impl Buffers {
    /// Counts the pixels per row without the guard band.
    fn picture_width(&self) -> u32 {
        self.color
            .width
            .saturating_sub(self.guard_band.saturating_mul(2))
            .max(1)
    }
}

/// Reads the camera's motion between places of the file's rasters, if the file has it.
fn read_reprojection(file: &ExrFile, band: u32) -> Result<Option<Reprojection>, Error> {
    if !file.attributes.contains_key("reprojection") {
        return Ok(None);
    }
    Ok(Some(Reprojection::from_exr(file)?.moved(f64::from(band))))
}

/// Reads the buffers, and converts them from the convention of their engine.
fn read_buffers(
    path: &Path,
    exposure: Option<f64>,
    convention: &Convention,
) -> Result<Buffers, Error> {
    let file = read_exr(path)?;
    let guard_band: u32 = match file.attributes.contains_key("guard_band") {
        true => file.get("guard_band")?,
        false => 0,
    };
    let [x, y] = [file.plane("velocity.X")?, file.plane("velocity.Y")?];
    let velocity = x.zip(&y, |x, y| [*x, *y]);
    let (color, depth) = (file.color("")?, file.plane("Z")?);
    let exposure = match exposure {
        Some(exposure) => exposure,
        None if file.attributes.contains_key("exposure") => file.get("exposure")?,
        None => {
            return Err(Error::Usage(format!(
                "{}: has no attribute \"exposure\"; give one with --exposure (0.5 = 180 degrees)",
                path.display()
            )));
        }
    };
    check_exposure(exposure)?;
    Ok(Buffers {
        color: convention.restore_color(&color),
        velocity: convention.restore_velocity(&velocity, exposure),
        depth: convention.restore_depth(&depth),
        reprojection: read_reprojection(&file, guard_band)?,
        camera: Camera::from_exr(&file)?,
        exposure,
        guard_band,
    })
}
