//! `shuttertruth run`

use std::path::Path;

use suite::{
    Error, InputFormat, Outcome, Plan, Run, open_gpu, read_bounds, run, select_filters,
    select_scenes, table,
};

use super::{render_settings, say};
use crate::cli::RunArgs;

/// Loads what is named, runs every case, writes `run.json`, prints the table.
pub fn execute(args: &RunArgs) -> Result<(), Error> {
    let scenes = select_scenes(&args.scenes.scenes_dir, &args.scenes.scenes)?;
    let folders = args.filter.iter().map(|folder| Path::new(".").join(folder));
    let words: Vec<String> = (args.filters.iter().cloned())
        .chain(folders.map(|folder| folder.display().to_string()))
        .collect();
    let filters = select_filters(&words, args.preset.as_deref(), &args.set)?;
    let scenes = scenes
        .into_iter()
        .map(|choice| {
            Ok((
                choice.scene,
                read_bounds(&args.scenes.scenes_dir, &choice.folder)?,
            ))
        })
        .collect::<Result<_, Error>>()?;
    let gpu = open_gpu(&filters, args.adapter.adapter.as_deref())?;
    let plan = Plan {
        scenes,
        filters,
        inputs: InputFormat::one_by_one(&args.velocity_format, &args.depth_format, &args.border),
        jitter_frames: args.jitter_frames,
        render: render_settings(&args.scenes, args.size, args.replicates)?,
        out: args.scenes.out.clone(),
        quiet: args.scenes.quiet,
    };
    let run = run(&plan, gpu.as_ref(), std::env::args().collect())?;
    let json = write_run(&run, &plan.out)?;
    if args.json {
        say(&format!("{json}\n"))
    } else {
        say(&(table(&run) + &closing(&run, &plan.out)))
    }
}

fn write_run(run: &Run, out: &Path) -> Result<String, Error> {
    let json = serde_json::to_string_pretty(run).expect("a run is plain data");
    frame::write_atomically(&out.join("run.json"), json.as_bytes())?;
    Ok(json)
}

/// What the table does not say: bounds, adapter, where the files are.
fn closing(run: &Run, out: &Path) -> String {
    let verdicts = || run.cases.iter().flat_map(|case| &case.verdicts);
    let broken = verdicts()
        .filter(|verdict| matches!(verdict.outcome, Outcome::Broken { .. }))
        .count();
    let noisy = verdicts()
        .filter(|verdict| matches!(verdict.outcome, Outcome::TooNoisy { .. }))
        .count();
    let mut text = format!("\n{broken} of {} bounds broken", verdicts().count());
    if noisy > 0 {
        text += &format!(
            "; {noisy} narrower than 3 noise floors: raise --samples-per-pixel or --replicates (now {} samples per pixel in all)",
            run.samples_per_pixel
        );
    }
    let adapter = match &run.adapter {
        Some(adapter) => format!("{}, {}", adapter.name, adapter.backend),
        None => "none, every filter is a command".to_owned(),
    };
    text += &format!(
        "\nadapter: {adapter}\nwritten: {}\n",
        out.join("run.json").display()
    );
    text
}
