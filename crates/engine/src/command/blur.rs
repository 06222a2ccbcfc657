//! The command `engine blur`.

use std::path::{Path, PathBuf};
use terminal::refuse;

use clap::Args;
use filters::{Convention, EXCLUSION, FilterError, Gpu, Input};
use frame::{
    Camera, ExrFile, FileError, Image, Plane, Reprojection, Size, Vectors, read_frame_rate,
    read_passes, write_exr,
};
use measure::{
    Error, FilterChoice, Runner, file_at_frame, numbered_file, open_gpu, printable_path,
    read_convention,
};

use super::show_texture::{check_shown, show_texture};
use terminal::arguments::{AdapterArgs, ProgramArgs, frame_count, parse_exposure};
use terminal::output::{make_monitor, print};
use terminal::selection::select_filters;

/// Arguments of `engine blur`.
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
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the
    /// preset was made for to the picture's].
    #[arg(long)]
    pub as_written: bool,
    /// OpenEXR file with the channels R G B, Z, velocity.X, velocity.Y, and velocity_next.X,
    /// velocity_next.Y, velocity_z and exclusion for filters that read them. With --frames the
    /// first frame's file, as `run` and `truths render` write it, or a folder of 0000.exr, 0001.exr
    /// and so on.
    #[arg(long, value_name = "FILE|DIR")]
    pub frame: PathBuf,
    /// TOML file with a table [convention] that says which velocity, depth and colour the frame has
    /// and the picture gets [default: pixels per frame, metres, scene-linear].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Exposure in frames [default: the file's attribute "exposure"].
    #[arg(long, value_name = "E", value_parser = parse_exposure)]
    pub exposure: Option<f64>,
    /// Frame number, which seeds the filter's noise; for a sequence, the first frame's.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame_index: u32,
    /// Blur N consecutive frames, each with the next frame number, and with the frame before for
    /// filters with history.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = frame_count())]
    pub frames: u32,
    /// OpenEXR file to write; with --frames a folder for 0000.exr, 0001.exr and so on [default:
    /// out/blurred.exr, or out/blurred].
    #[arg(short, long, value_name = "FILE|DIR")]
    pub out: Option<PathBuf>,
    /// Textures to write next to the picture as EXR and PNG, as the last pass left them: the
    /// filter's own, color, velocity, depth or output. Repeatable, or separated by commas.
    #[arg(long, value_name = "TEXTURES", value_delimiter = ',')]
    pub show: Vec<String>,
    /// Filters that are programs.
    #[command(flatten)]
    pub programs: ProgramArgs,
    /// Graphics card.
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

/// Runs one filter on a frame file or a sequence of them, and writes its colours.
pub fn execute(args: &BlurArgs) -> Result<(), Error> {
    let out = choose_out(args)?;
    check_frame_numbers(args)?;
    let names = [args.filter.clone()];
    let (preset, programs) = (args.preset.as_deref(), args.programs.programs());
    let choice = select_filters(&names, preset, &args.set, programs)?.remove(0);
    check_shown(&choice.filter, &args.show)?;
    let convention = read_convention(args.convention.as_deref())?;
    let first = Buffers::read(frame_file(args, 0), args.exposure, &convention)?;
    let size = first.color.size();
    let choice = (choice.as_written(args.as_written)).scaled_to(first.picture_width());
    let monitor = make_monitor().without_progress();
    let adapter = args.adapter.adapter.as_deref();
    let gpu = open_gpu(std::slice::from_ref(&choice), adapter, monitor)?;
    let mut runner = Runner::new(gpu.as_ref(), &choice, size)?;
    let first_path = first.path.clone();
    // The first frame has no previous one; it serves as its own.
    let mut before = first;
    for frame in 0..args.frames {
        let current = match frame {
            0 => None,
            _ => Some(Buffers::read(
                frame_file(args, frame),
                args.exposure,
                &convention,
            )?),
        };
        let now = current.as_ref().unwrap_or(&before);
        check_same_size(now, &first_path, size)?;
        let index = args.frame_index + frame;
        let colors = [[&now.color], [&before.color]];
        let input = now.input(&colors[0], index);
        let outputs = runner.run_after(&input, &before.input(&colors[1], index));
        let outputs = outputs.map_err(|error| match error {
            FilterError::Input { reason, .. } => {
                Error::Refused(format!("{}: {reason}", now.path.display()))
            }
            other => other.into(),
        })?;
        let mut file = describe_picture(&choice, gpu.as_ref(), size);
        file.push_color("", &convention.convert_color(&outputs[0]));
        file.set("exposure", now.exposure);
        let path = match args.frames {
            1 => out.clone(),
            _ => numbered_file(&out, frame),
        };
        write_exr(&path, &file)?;
        print(format!("{}\n", printable_path(&path)))?;
        for name in &args.show {
            show_texture(&runner, &choice.filter, name, &path)?;
        }
        before = current.unwrap_or(before);
    }
    Ok(())
}

/// Refuses a frame of another size than the first.
fn check_same_size(now: &Buffers, first: &Path, size: Size) -> Result<(), Error> {
    let found = now.color.size();
    if found != size {
        refuse!(
            "{}: has {found} pixels, {} has {size}; the frames of a sequence have one size",
            now.path.display(),
            first.display()
        );
    }
    Ok(())
}

/// Refuses frames whose numbers would pass the largest one.
fn check_frame_numbers(args: &BlurArgs) -> Result<(), Error> {
    let last = u32::MAX - (args.frames - 1);
    if args.frame_index > last {
        refuse!(
            "--frame-index {}: each of the {} frames has the next one; allowed: up to {last}",
            args.frame_index,
            args.frames
        );
    }
    Ok(())
}

/// Makes a file without a picture that records what blurred it.
fn describe_picture(choice: &FilterChoice, gpu: Option<&Gpu>, size: Size) -> ExrFile {
    let mut file = ExrFile::new(size.width, size.height);
    file.set("kind", "output");
    file.set("filter", choice.name());
    file.set("program", measure::PROGRAM);
    if let Some(gpu) = gpu {
        file.set("adapter", &gpu.adapter.name);
    }
    file.set("alignment", choice.filter.alignment);
    file
}

/// Chooses the picture to write, or the folder for a sequence.
fn choose_out(args: &BlurArgs) -> Result<PathBuf, Error> {
    let (frames, is_one) = (args.frames, args.frames == 1);
    let default = if is_one {
        "out/blurred.exr"
    } else {
        "out/blurred"
    };
    let out = args.out.clone().unwrap_or_else(|| default.into());
    if !is_one && out.extension().is_some_and(|ending| ending == "exr") {
        refuse!(
            "--out: {} is the name of one picture, and {frames} are written; name a folder for them",
            out.display()
        );
    }
    Ok(out)
}

/// Names a frame's file.
fn frame_file(args: &BlurArgs, frame: u32) -> PathBuf {
    match args.frames {
        1 => args.frame.clone(),
        _ if args.frame.is_dir() => numbered_file(&args.frame, frame),
        _ => file_at_frame(&args.frame, frame),
    }
}

/// Buffers of a frame file for a filter. Any OpenEXR file with these channels will do.
struct Buffers {
    path: PathBuf,
    color: Image,
    velocity: Vectors,
    velocity_next: Option<Vectors>,
    velocity_z: Option<Plane>,
    exclusion: Option<Plane>,
    depth: Plane,
    reprojection: Option<Reprojection>,
    camera: Option<Camera>,
    exposure: f64,
    frames_per_second: Option<f64>,
    guard_band: u32,
}

impl Buffers {
    /// Reads the buffers, and converts them from their engine's convention.
    fn read(path: PathBuf, exposure: Option<f64>, convention: &Convention) -> Result<Self, Error> {
        let mut file = read_passes(&path)?;
        let has = |attribute| file.attributes.contains_key(attribute);
        let guard_band = if has("guard_band") {
            file.get("guard_band")?
        } else {
            0
        };
        let velocity = file.vectors("velocity")?;
        let next = file.optional("velocity_next.X", || file.vectors("velocity_next"))?;
        let refuse = |reason| FileError::foreign(&path, reason);
        let exposure = match exposure {
            Some(exposure) => exposure,
            None if has("exposure") => file.get("exposure")?,
            None => {
                refuse!(
                    "{}: has no attribute \"exposure\"; give one with --exposure (0.5 = 180 degrees)",
                    path.display()
                );
            }
        };
        let restore_velocity =
            |velocity: &Vectors| (convention.restore_velocity(velocity, exposure)).map_err(refuse);
        let reprojection = if has("reprojection") {
            Some(Reprojection::from_exr(&file)?.moved(f64::from(guard_band)))
        } else {
            None
        };
        Ok(Self {
            color: convention.read_color(&mut file)?,
            velocity: restore_velocity(&velocity)?,
            velocity_next: next.as_ref().map(restore_velocity).transpose()?,
            velocity_z: file.optional("velocity_z", || file.plane("velocity_z"))?,
            exclusion: file.optional(EXCLUSION, || file.plane(EXCLUSION))?,
            depth: convention
                .restore_depth(&file.plane("Z")?)
                .map_err(refuse)?,
            reprojection,
            camera: Camera::from_exr(&file)?,
            exposure,
            frames_per_second: read_frame_rate(&file)?,
            guard_band,
            path,
        })
    }

    /// Makes the input of a filter, with colours in place of the frame's own.
    fn input<'a>(&'a self, color: &'a [&'a Image], frame_index: u32) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            velocity_next: self.velocity_next.as_ref(),
            velocity_z: self.velocity_z.as_ref(),
            exclusion: self.exclusion.as_ref(),
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
        let band = self.guard_band.saturating_mul(2);
        self.color.width.saturating_sub(band).max(1)
    }
}
