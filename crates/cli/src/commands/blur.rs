//! The command `engine blur`.

use std::path::{Path, PathBuf};

use clap::Args;
use filters::{Convention, FilterError, Input};
use frame::{
    Camera, ExrFile, Image, Plane, Reprojection, Vectors, read_exr, read_frame_rate, write_exr,
};
use store::printable_path;
use suite::{Error, FilterChoice, Runner, file_at_frame, numbered_file, open_gpu};

use super::convention::read_convention;
use super::render_settings::check_exposure;
use crate::arguments::{AdapterArgs, ProgramArgs, frame_count};
use crate::output::{make_silent_monitor, print};
use crate::selection::select_filters;

#[derive(Debug, Args)]
pub struct BlurArgs {
    /// Filter: a name or a folder, with an optional :preset.
    #[arg(long, value_name = "FILTER")]
    pub filter: String,
    /// Preset [default: the filter's first].
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; repeatable.
    #[arg(long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the preset was made for to the
    /// picture's].
    #[arg(long)]
    pub as_written: bool,
    /// OpenEXR file with the channels R G B, Z, velocity.X, velocity.Y. With --frames that of the first frame, as `run` and `truths render`
    /// lay them out, or a folder of 0000.exr, 0001.exr and so on.
    #[arg(long, value_name = "FILE|DIR")]
    pub frame: PathBuf,
    /// TOML file with a table [convention] that says which velocity, depth and colour the frame has, and the picture gets
    /// [default: pixels per frame, metres, scene-linear].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Exposure in frames [default: the file's attribute "exposure"].
    #[arg(long, value_name = "E")]
    pub exposure: Option<f64>,
    /// Frame number, which seeds the filter's noise; of a sequence that of the first frame.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame_index: u32,
    /// Blur N consecutive frames, each with the next frame number, and with the frame before for filters with history.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = frame_count())]
    pub frames: u32,
    /// OpenEXR file to write; with --frames a folder for 0000.exr, 0001.exr and so on [default: out/blurred.exr, or out/blurred].
    #[arg(short, long, value_name = "FILE|DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub programs: ProgramArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

/// Runs one filter on one frame file, or on those of a sequence, and writes its colours.
pub fn execute(args: &BlurArgs) -> Result<(), Error> {
    let frames = list_frames(args)?;
    let choice = select_filter(args)?;
    let convention = read_convention(args.convention.as_deref())?;
    let buffers = Buffers::read(&frames[0].file, args.exposure, &convention)?;
    let choice = choice.scaled_to(buffers.picture_width());
    let gpu = open_gpu(
        std::slice::from_ref(&choice),
        args.adapter.adapter.as_deref(),
        make_silent_monitor(),
    )?;
    let size = buffers.size();
    let mut runner = Runner::new(gpu.as_ref(), &choice, size, make_silent_monitor())?;
    // The first frame stands in for the one before it.
    let mut before = buffers;
    for (at, frame) in frames.iter().enumerate() {
        let own = match at {
            0 => None,
            _ => Some(Buffers::read(&frame.file, args.exposure, &convention)?),
        };
        let now = own.as_ref().unwrap_or(&before);
        now.check_size(size, frame, &frames[0])?;
        let colors = [[&now.color], [&before.color]];
        let input = now.input(&colors[0], frame.index);
        let outputs = runner.run_after(&input, &before.input(&colors[1], frame.index));
        let outputs = outputs.map_err(|error| match error {
            FilterError::Input { reason, .. } => {
                Error::Usage(format!("{}: {reason}", frame.file.display()))
            }
            other => other.into(),
        })?;
        let mut file = ExrFile::new(size.0, size.1);
        file.push_color("", &convention.convert_color(&outputs[0]));
        file.set("kind", "output");
        file.set("filter", choice.name());
        file.set("program", suite::PROGRAM);
        if let Some(gpu) = &gpu {
            file.set("adapter", &gpu.adapter.name);
        }
        file.set("exposure", now.exposure);
        file.set("alignment", choice.filter.alignment);
        write_exr(&frame.out, &file)?;
        if let Some(own) = own {
            before = own;
        }
        print(&format!("{}\n", printable_path(&frame.out)))?;
    }
    Ok(())
}

/// One frame to blur.
struct FrameFiles {
    /// The frame.
    file: PathBuf,
    /// Picture to write.
    out: PathBuf,
    /// Frame number, which seeds the filter's noise.
    index: u32,
}

/// Lists the frames to blur, and the pictures to write.
fn list_frames(args: &BlurArgs) -> Result<Vec<FrameFiles>, Error> {
    let is_one = args.frames == 1;
    let out = args.out.clone().unwrap_or_else(|| match is_one {
        true => PathBuf::from("out/blurred.exr"),
        false => PathBuf::from("out/blurred"),
    });
    if is_one {
        return Ok(vec![FrameFiles {
            file: args.frame.clone(),
            index: args.frame_index,
            out,
        }]);
    }
    if out.extension().is_some_and(|ending| ending == "exr") {
        refuse!(
            "--out: {} is the name of one picture, and {} are written; name a folder for them",
            out.display(),
            args.frames
        );
    }
    if args.frame_index.checked_add(args.frames - 1).is_none() {
        refuse!(
            "--frame-index {}: each of the {} frames has the next one; allowed: up to {}",
            args.frame_index,
            args.frames,
            u32::MAX - (args.frames - 1)
        );
    }
    let is_folder = args.frame.is_dir();
    let frames = (0..args.frames).map(|frame| FrameFiles {
        file: match is_folder {
            true => numbered_file(&args.frame, frame),
            false => file_at_frame(&args.frame, frame),
        },
        out: numbered_file(&out, frame),
        index: args.frame_index + frame,
    });
    Ok(frames.collect())
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
    frames_per_second: Option<f64>,
    guard_band: u32,
}

impl Buffers {
    /// Reads the buffers, and converts them from the convention of their engine.
    fn read(path: &Path, exposure: Option<f64>, convention: &Convention) -> Result<Self, Error> {
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
                refuse!(
                    "{}: has no attribute \"exposure\"; give one with --exposure (0.5 = 180 degrees)",
                    path.display()
                );
            }
        };
        check_exposure(exposure)?;
        Ok(Self {
            color: convention.restore_color(&color),
            velocity: convention.restore_velocity(&velocity, exposure),
            depth: convention.restore_depth(&depth),
            reprojection: read_reprojection(&file, guard_band)?,
            camera: Camera::from_exr(&file)?,
            exposure,
            frames_per_second: read_frame_rate(&file)?,
            guard_band,
        })
    }

    fn size(&self) -> (u32, u32) {
        (self.color.width, self.color.height)
    }

    /// Refuses a frame of another size than the first one.
    fn check_size(
        &self,
        size: (u32, u32),
        own: &FrameFiles,
        first: &FrameFiles,
    ) -> Result<(), Error> {
        match self.size() == size {
            true => Ok(()),
            false => refuse!(
                "{}: has {}x{} pixels, {} has {}x{}; the frames of a sequence have one size",
                own.file.display(),
                self.size().0,
                self.size().1,
                first.file.display(),
                size.0,
                size.1
            ),
        }
    }

    /// Makes the input of a filter, with colours in place of the frame's own.
    fn input<'a>(&'a self, color: &'a [&'a Image], frame_index: u32) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            depth: &self.depth,
            reprojection: self.reprojection,
            camera: self.camera,
            exposure: self.exposure,
            frames_per_second: self.frames_per_second,
            frame_index,
        }
    }

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
