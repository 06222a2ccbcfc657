//! The command `engine import`.

use std::path::{Path, PathBuf};

use clap::Args;
use measure::{Error, printable_path};
use terminal::arguments::{frame_count, parse_exposure, parse_named, parse_speed};
use terminal::output::{print, print_note};
use terminal::refuse;

use crate::import::{GltfPlan, ImportPlan, Imported, Motions, Up, import, import_gltf};

/// Frames per second of a glTF file's scene by default.
const RATE: f64 = 60.0;

/// Arguments of `engine import`.
#[derive(Debug, Args)]
pub struct ImportArgs {
    /// OBJ file, which is copied with the MTL and PNG files that it names; a folder of OBJ files, one
    /// per frame, with the same faces; or a glTF file (.glb, .gltf) with its own animation, cameras
    /// and lights.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// New folder for the scene, which gives the scene its name [default: out/<name of MODEL>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Move the camera around the model.
    #[arg(long, value_name = "SPEED", value_parser = parse_speed("deg/frame", "20deg/frame"), allow_hyphen_values = true)]
    pub orbit: Option<f64>,
    /// Exposure in frames; 0.5 is a shutter of 180 degrees.
    #[arg(long, value_name = "E", default_value_t = 0.5, value_parser = parse_exposure)]
    pub exposure: f64,
    /// What moves an OBJ file.
    #[command(flatten)]
    pub obj: ObjArgs,
    /// What is taken from a glTF file.
    #[command(flatten)]
    pub gltf: GltfArgs,
}

/// Arguments for OBJ files.
#[derive(Debug, Args)]
#[command(next_help_heading = "OBJ files")]
pub struct ObjArgs {
    /// Turn the model around its vertical axis.
    #[arg(long, value_name = "SPEED", value_parser = parse_speed("deg/frame", "20deg/frame"), allow_hyphen_values = true)]
    pub spin: Option<f64>,
    /// Slide the model to the right, in pixels at 640x360.
    #[arg(long, value_name = "SPEED", value_parser = parse_speed("px/frame", "40px/frame"), allow_hyphen_values = true)]
    pub slide: Option<f64>,
    /// Axis of the model that points up [default: y].
    #[arg(long, value_parser = parse_named(Up::ALL, Up::name, Up::help), value_name = "AXIS")]
    pub up: Option<Up>,
    /// Import the shape alone, in grey, without materials.
    #[arg(long)]
    pub plain: bool,
}

/// Arguments for glTF files.
#[derive(Debug, Args)]
#[command(next_help_heading = "glTF files")]
pub struct GltfArgs {
    /// Time of the animation at the frame, such as 1.25s [default: its middle].
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    pub time: Option<f64>,
    /// Frames per second, which say how far things move in a frame [default: 60].
    #[arg(long, value_name = "RATE", value_parser = parse_rate)]
    pub fps: Option<f64>,
    /// Frames of a sequence, for `run --frames`; of a folder of OBJ files too [default: 1].
    #[arg(long, value_name = "N", value_parser = frame_count())]
    pub frames: Option<u32>,
    /// Animation, by its name; repeatable, for animations of different nodes that play together
    /// [default: the first].
    #[arg(long, value_name = "NAME")]
    pub animation: Vec<String>,
    /// Camera, by its name [default: the first; without any, one is framed on the model].
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
}

/// Makes the scene folder and prints its contents.
pub fn execute(args: &ImportArgs) -> Result<(), Error> {
    let out = match &args.out {
        Some(out) => out.clone(),
        None => Path::new("out").join(args.model.file_stem().unwrap_or(args.model.as_os_str())),
    };
    let Imported {
        exposes,
        triangles,
        notes,
        lines,
    } = if is_gltf(&args.model) {
        import_gltf(&gltf_plan(args, &out)?)?
    } else {
        import(&obj_plan(args, &out)?)?
    };
    for note in &notes {
        print_note(note);
    }
    let folder = printable_path(&out);
    let lines: String = lines.iter().map(|line| format!("{line}\n")).collect();
    print(format!(
        "{exposes}\n{triangles} triangles, the set's among them\n{lines}written: {folder}\nnext: shuttertruth run {}{folder}\n",
        if out.is_relative() { "./" } else { "" },
    ))
}

fn is_gltf(model: &Path) -> bool {
    let ending = model.extension().unwrap_or_default().to_ascii_lowercase();
    ending == "glb" || ending == "gltf"
}

fn obj_plan(args: &ImportArgs, out: &Path) -> Result<ImportPlan, Error> {
    let GltfArgs {
        time,
        fps,
        frames,
        animation,
        camera,
    } = &args.gltf;
    let given = [
        (time.is_some(), "--time"),
        (fps.is_some(), "--fps"),
        (frames.is_some() && !args.model.is_dir(), "--frames"),
        (!animation.is_empty(), "--animation"),
        (camera.is_some(), "--camera"),
    ];
    refuse_given(&given, args, "glTF files (.glb, .gltf)")?;
    Ok(ImportPlan {
        model: args.model.clone(),
        frames: frames.unwrap_or(1),
        out: out.to_owned(),
        up: args.obj.up.unwrap_or(Up::Y),
        plain: args.obj.plain,
        motions: Motions {
            spin: args.obj.spin,
            slide: args.obj.slide,
            orbit: args.orbit,
        },
        exposure: args.exposure,
    })
}

fn gltf_plan(args: &ImportArgs, out: &Path) -> Result<GltfPlan, Error> {
    let ObjArgs {
        spin,
        slide,
        up,
        plain,
    } = &args.obj;
    let given = [
        (spin.is_some(), "--spin"),
        (slide.is_some(), "--slide"),
        (up.is_some(), "--up"),
        (*plain, "--plain"),
    ];
    refuse_given(
        &given,
        args,
        "OBJ files; a glTF file has its own motion, and --orbit",
    )?;
    Ok(GltfPlan {
        model: args.model.clone(),
        out: out.to_owned(),
        time: args.gltf.time,
        rate: args.gltf.fps.unwrap_or(RATE),
        frames: args.gltf.frames.unwrap_or(1),
        animations: args.gltf.animation.clone(),
        camera: args.gltf.camera.clone(),
        orbit: args.orbit,
        exposure: args.exposure,
    })
}

/// Refuses an argument that is for other files.
fn refuse_given(given: &[(bool, &str)], args: &ImportArgs, files: &str) -> Result<(), Error> {
    if let Some((_, name)) = given.iter().find(|(is_given, _)| *is_given) {
        refuse!("{}: {name} is for {files}", printable_path(&args.model));
    }
    Ok(())
}

/// Reads a time such as `1.25s`.
fn parse_seconds(text: &str) -> Result<f64, String> {
    let number = text
        .strip_suffix('s')
        .and_then(|number| number.parse::<f64>().ok());
    match number.filter(|seconds| seconds.abs() <= 1e6) {
        Some(seconds) => Ok(seconds),
        None => Err("allowed: seconds such as 1.25s".into()),
    }
}

/// Reads frames per second.
fn parse_rate(text: &str) -> Result<f64, String> {
    let [slowest, fastest] = [scene::limits::SLOWEST_RATE, scene::limits::FASTEST_RATE];
    match text
        .parse::<f64>()
        .ok()
        .filter(|rate| (slowest..=fastest).contains(rate))
    {
        Some(rate) => Ok(rate),
        None => Err(format!("allowed: {slowest} to {fastest}, such as 60")),
    }
}
