//! The command `truths pack`.

use std::path::PathBuf;

use clap::Args;
use store::printable_path;
use suite::{Error, Run, find_newer_sizes, write_pack};

use crate::output::{count_text, make_monitor, print, print_json, print_note};
use crate::selection::choose_names;

#[derive(Debug, Args)]
pub struct PackArgs {
    /// Folder of a finished run: --out of `run` or `check`.
    #[arg(value_name = "RUN", default_value = "out")]
    pub run: PathBuf,
    /// Scenes of the run: names with their @variant, or patterns such as 'rail*'; repeatable, or separated by commas [default: all].
    #[arg(
        long,
        visible_alias = "scene",
        value_delimiter = ',',
        value_name = "SCENES"
    )]
    pub scenes: Vec<String>,
    /// Archive to write.
    #[arg(short, long, value_name = "FILE", default_value = "truths.tar.zst")]
    pub out: PathBuf,
    /// Print the manifest of the pack as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Packs the kept frames, truths and ladders of a finished run into one archive.
pub fn execute(args: &PackArgs) -> Result<(), Error> {
    let run = Run::read(&args.run.join("run.json"))?;
    let mut known: Vec<String> = run
        .cases
        .iter()
        .map(|case| case.scene.to_string())
        .collect();
    known.sort();
    known.dedup();
    let scenes = choose_names("--scenes", &args.scenes, &known)?;
    for folder in find_newer_sizes(&args.run) {
        print_note(&format!(
            "{0} is newer, and is not packed; a pack holds one run: shuttertruth truths pack {0}",
            folder.display()
        ));
    }
    let manifest = write_pack(&run, &args.run, &scenes, &args.out, make_monitor())?;
    if args.json {
        return print_json(&manifest);
    }
    let size = |bytes: u64| format!("{:.1} MB", bytes as f64 / 1e6);
    let written = std::fs::metadata(&args.out).map_or(0, |found| found.len());
    print(&format!(
        "written: {} ({}; {} in {}, {} unpacked)\n",
        printable_path(&args.out),
        size(written),
        count_text(manifest.truths(), "truth", "truths"),
        count_text(manifest.files.len(), "file", "files"),
        size(manifest.bytes())
    ))
}
