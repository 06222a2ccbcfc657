//! The command `pack`.

use suite::{Error, Run, find_newer_sizes, printable_path, write_pack};

use crate::arguments::PackArgs;
use crate::output::count::count_text;
use crate::output::print::{print, print_json, print_note};
use crate::output::progress::make_monitor;
use crate::selection::choose_names;

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
            "{0} is newer, and is not packed; a pack holds one run: shuttertruth pack {0}",
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
