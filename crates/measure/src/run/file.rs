//! The file run.json: its text, and its reader, which checks any author's file before using it.

use std::collections::HashSet;
use std::path::Path;

use crate::{Error, MAX_REPLICATES, MAX_RUN_BYTES, is_below, read_text_within, to_lines};

use super::case::Case;
use super::sequence::{MAX_FRAMES, Sequence};
use super::{FORMAT, Run};
use crate::render::settings::SIDES;

/// Upper limit on the cases of a run.json.
pub const MAX_CASES: usize = 50_000;

impl Run {
    /// Formats the text of its `run.json`, with a line per case.
    pub fn text(&self) -> String {
        to_lines(self)
    }

    /// Reads a `run.json` of this program.
    pub fn read(path: &Path) -> Result<Self, Error> {
        if !path.exists() {
            return Err(Error::Refused(format!(
                "{}: cannot read: there is no such file; `shuttertruth run` or `check` writes one",
                path.display()
            )));
        }
        parse(&read_text_within(path, MAX_RUN_BYTES)?).map_err(|reason| {
            Error::Refused(format!(
                "{}: {reason}; `shuttertruth run` or `check` writes one",
                path.display()
            ))
        })
    }
}

/// Parses a run.json; the error names what is wrong and what is allowed.
fn parse(text: &str) -> Result<Run, String> {
    let broken = |error: serde_json::Error| format!("no run of this program: {error}");
    let run: Run = serde_json::from_str(text).map_err(broken)?;
    if run.format != FORMAT {
        return Err(format!("has format {}; allowed: {FORMAT}", run.format));
    }
    check_settings(&run)?;
    if run.cases.len() > MAX_CASES {
        return Err(format!(
            "holds {} cases; allowed: up to {MAX_CASES}",
            run.cases.len()
        ));
    }
    run.sequences.iter().try_for_each(check_sequence)?;
    let mut folders = HashSet::new();
    for case in &run.cases {
        check_case(case).map_err(|reason| format!("{}: {reason}", case.id))?;
        if !folders.insert(&case.folder) {
            return Err(format!(
                "{}: folder \"{}\" belongs to two cases; allowed: one case each",
                case.id,
                case.folder.display()
            ));
        }
    }
    Ok(run)
}

/// Checks sizes and counts of the whole run.
fn check_settings(run: &Run) -> Result<(), String> {
    let render = &run.render;
    let sides = [render.width, render.height];
    if !sides.iter().all(|side| SIDES.contains(side)) {
        return Err(format!(
            "has pictures of {}x{} pixels; allowed: {} to {} columns and rows",
            render.width,
            render.height,
            SIDES.start(),
            SIDES.end()
        ));
    }
    if !(1..=MAX_REPLICATES).contains(&render.replicates) {
        return Err(format!(
            "has {} replicates; allowed: 1 to {MAX_REPLICATES}",
            render.replicates
        ));
    }
    if render.samples_per_pixel == 0 {
        return Err("has 0 samples per pixel; allowed: 1 or more".to_owned());
    }
    Ok(())
}

fn check_case(case: &Case) -> Result<(), String> {
    if !is_below(&case.folder) {
        return Err(format!(
            "folder \"{}\": a case has to be in a folder below run.json",
            case.folder.display()
        ));
    }
    (case.alignment.shutter(case.exposure).map(drop)).map_err(|error| error.to_string())
}

fn check_sequence(sequence: &Sequence) -> Result<(), String> {
    let name = format!("the sequence {} / {}", sequence.scene, sequence.name);
    let count = sequence.frames.len();
    if count > MAX_FRAMES as usize {
        return Err(format!(
            "{name} has {count} frames; allowed: up to {MAX_FRAMES}"
        ));
    }
    let mut worst = sequence.worst_frames.iter();
    if let Some((metric, frame)) = worst.find(|(_, frame)| **frame as usize >= count) {
        return Err(format!(
            "{name} is worst in {metric} at frame {frame}; allowed: 0 to {}",
            count.saturating_sub(1)
        ));
    }
    let frames = sequence.frames.iter();
    let mut paths = frames.flat_map(|frame| [&frame.scene, &frame.folder]);
    match paths.find(|path| !is_below(path)) {
        None => Ok(()),
        Some(path) => Err(format!(
            "{name} names the folder \"{}\"; allowed: folders below run.json",
            path.display()
        )),
    }
}
