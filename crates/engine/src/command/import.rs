//! The command `engine import`.

use std::path::{Path, PathBuf};

use clap::Args;
use measure::{Error, printable_path};
use terminal::arguments::{parse_exposure, parse_named, parse_speed};
use terminal::output::{print, print_note};

use crate::import::{ImportPlan, Imported, Motions, Up, import};

/// Arguments of `engine import`.
#[derive(Debug, Args)]
pub struct ImportArgs {
    /// OBJ file. It is copied, with the MTL and PNG files that it names.
    #[arg(value_name = "MODEL.OBJ")]
    pub model: PathBuf,
    /// New folder for the scene, which gives the scene its name [default: out/<name of the OBJ
    /// file>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Turn the model around its vertical axis.
    #[arg(long, value_name = "SPEED", value_parser = parse_speed("deg/frame", "20deg/frame"), allow_hyphen_values = true)]
    pub spin: Option<f64>,
    /// Slide the model to the right, in pixels at 640x360.
    #[arg(long, value_name = "SPEED", value_parser = parse_speed("px/frame", "40px/frame"), allow_hyphen_values = true)]
    pub slide: Option<f64>,
    /// Move the camera around the model.
    #[arg(long, value_name = "SPEED", value_parser = parse_speed("deg/frame", "20deg/frame"), allow_hyphen_values = true)]
    pub orbit: Option<f64>,
    /// Axis of the model that points up.
    #[arg(long, value_parser = parse_named(Up::ALL, Up::name, Up::help), value_name = "AXIS", default_value = "y")]
    pub up: Up,
    /// Import the shape alone, in grey, without materials.
    #[arg(long)]
    pub plain: bool,
    /// Exposure in frames; 0.5 is a shutter of 180 degrees.
    #[arg(long, value_name = "E", default_value_t = 0.5, value_parser = parse_exposure)]
    pub exposure: f64,
}

/// Makes the scene folder and prints its contents.
pub fn execute(args: &ImportArgs) -> Result<(), Error> {
    let out = match &args.out {
        Some(out) => out.clone(),
        None => Path::new("out").join(args.model.file_stem().unwrap_or(args.model.as_os_str())),
    };
    let plan = ImportPlan {
        model: args.model.clone(),
        out: out.clone(),
        up: args.up,
        plain: args.plain,
        motions: Motions {
            spin: args.spin,
            slide: args.slide,
            orbit: args.orbit,
        },
        exposure: args.exposure,
    };
    let Imported {
        exposes,
        triangles,
        notes,
    } = import(&plan)?;
    for note in &notes {
        print_note(note);
    }
    let folder = printable_path(&out);
    print(format!(
        "{exposes}\n{triangles} triangles, the set's among them\nwritten: {folder}\nnext: shuttertruth run {}{folder}\n",
        if out.is_relative() { "./" } else { "" },
    ))
}
