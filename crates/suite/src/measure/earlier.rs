//! Cases of an earlier run in the same folder, which a narrower run keeps.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use filters::AdapterDescription;
use tracer::SceneId;

use crate::identity::CaseId;
use crate::measure::plan::RunPlan;
use crate::measure::planned_case::PlannedCase;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::sequence::Sequence;
use crate::run::{Run, list_run_settings};
use crate::stats::overall::overall;
use crate::{Error, PROGRAM};

/// The cases and failures of an earlier run that a plan does not measure again.
pub struct EarlierCases {
    cases: Vec<Case>,
    sequences: Vec<Sequence>,
    failures: Vec<Failure>,
    /// Cases of the earlier run that are out of date: their scene has changed since.
    pub outdated: usize,
}

impl EarlierCases {
    /// Finds the cases of `run.json` in the plan's folder that the plan leaves out, and lets the plan compare its own cases with
    /// the same common shutter. None where there is nothing to keep: no run, or one whose cases are all measured again.
    ///
    /// # Errors
    /// The earlier run cannot be read, or has other settings, so that its cases cannot stand beside those of the plan.
    pub fn find(
        plan: &mut RunPlan,
        adapter: Option<&AdapterDescription>,
    ) -> Result<Option<Self>, Error> {
        if plan.no_cache {
            return Ok(None);
        }
        let path = plan.out.join("run.json");
        let Some(run) = read_earlier_run(&path)? else {
            return Ok(None);
        };
        let planned = list_planned(plan);
        let names: HashSet<(&SceneId, String)> = (planned.iter())
            .filter(|id| !id.is_reference)
            .map(|id| (&id.scene, id.name()))
            .collect();
        let is_left_out = |scene: &SceneId, name: &str| !names.contains(&(scene, name.to_owned()));
        let left_out = (run.cases.iter())
            .filter(|case| !case.is_reference && is_left_out(&case.scene, &case.of_preset().name()))
            .count();
        if left_out == 0 {
            return Ok(None);
        }
        if let Some((setting, earlier, now)) = find_difference(&run, plan, adapter) {
            let (dropped, them) = match left_out {
                1 => ("1 case".to_owned(), "it"),
                count => (format!("{count} cases"), "them"),
            };
            return Err(Error::Usage(format!(
                "{}: this run would drop {dropped} of an earlier one, and cannot keep {them}: {setting} was {earlier}, now \
                 {now}",
                path.display()
            )));
        }
        plan.common = Some(run.common_alignment);
        let planned = list_planned(plan);
        let kept = (run.cases.into_iter()).filter(|case| !planned.contains(&case.of_preset()));
        let (cases, outdated): (Vec<Case>, Vec<Case>) =
            kept.partition(|case| !is_outdated(plan, case));
        let failures = (run.failures.into_iter())
            .filter(|failure| is_left_out(&failure.scene, &failure.filter))
            .collect();
        let is_outdated = |sequence: &Sequence| {
            let of_scene = |case: &&Case| case.scene == sequence.scene;
            outdated.iter().any(|case| of_scene(&case))
        };
        let sequences = (run.sequences.into_iter())
            .filter(|own| !own.is_reference && is_left_out(&own.scene, &own.filter))
            .filter(|own| !is_outdated(own))
            .collect();
        Ok(Some(Self {
            cases,
            sequences,
            failures,
            outdated: outdated.iter().filter(|case| !case.is_reference).count(),
        }))
    }

    /// Number of filter cases that are kept.
    pub fn count(&self) -> usize {
        self.cases.iter().filter(|case| !case.is_reference).count()
    }

    /// Adds the kept cases to a finished run: behind its own cases of each scene, references first.
    pub fn add_to(self, run: &Run) -> Run {
        let Run {
            mut cases,
            mut sequences,
            mut failures,
            ..
        } = run.clone();
        cases.extend(self.cases);
        sequences.extend(self.sequences);
        failures.extend(self.failures);
        let scenes: Vec<SceneId> = cases.iter().map(|case| case.scene.clone()).collect();
        let place = |case: &Case| scenes.iter().position(|scene| *scene == case.scene);
        cases.sort_by_cached_key(|case| (place(case), !case.is_reference));
        Run {
            overall: overall(&cases),
            cases,
            sequences,
            failures,
            ..run.clone()
        }
    }
}

/// Names the folder for a run with pictures of one size: `out` itself, or `160x90` below it where `out` holds a run of another
/// size, whose pictures have the same names.
///
/// # Errors
/// The run in `out` cannot be read.
pub fn folder_for_size(out: &Path, (width, height): (u32, u32)) -> Result<PathBuf, Error> {
    let earlier = read_earlier_run(&out.join("run.json"))?;
    Ok(match earlier {
        Some(run) if (run.render.width, run.render.height) != (width, height) => {
            out.join(format!("{width}x{height}"))
        }
        _ => out.to_owned(),
    })
}

/// Finds the runs of other picture sizes below `out` that are newer than the run in `out` itself, and returns their folders.
pub fn find_newer_sizes(out: &Path) -> Vec<PathBuf> {
    let written = |folder: &Path| fs::metadata(folder.join("run.json"))?.modified();
    let (Ok(own), Ok(entries)) = (written(out), fs::read_dir(out)) else {
        return Vec::new();
    };
    let is_size = |folder: &Path| {
        let sides = folder.file_name()?.to_str()?.split_once('x')?;
        Some(sides.0.parse::<u32>().is_ok() && sides.1.parse::<u32>().is_ok())
    };
    let mut newer: Vec<PathBuf> = (entries.flatten().map(|entry| entry.path()))
        .filter(|folder| is_size(folder) == Some(true))
        .filter(|folder| written(folder).is_ok_and(|time| time > own))
        .collect();
    newer.sort();
    newer
}

/// Reads the run that a new one would replace; none where there is no such file.
fn read_earlier_run(path: &Path) -> Result<Option<Run>, Error> {
    if !path.exists() {
        return Ok(None);
    }
    Run::read(path).map(Some).map_err(|error| {
        Error::Usage(format!(
            "{error}; a new run would replace it and lose what it holds; repair or remove it"
        ))
    })
}

/// Lists the presets of the plan on each of its scenes.
fn list_planned(plan: &RunPlan) -> HashSet<CaseId> {
    let of_scene = |scene| PlannedCase::all(plan, &plan.filters, scene);
    let planned = plan.all_scenes().into_iter().flat_map(of_scene);
    planned.map(|case| case.id.of_preset()).collect()
}

/// Tells whether a scene of the plan has changed since the case was measured.
fn is_outdated(plan: &RunPlan, case: &Case) -> bool {
    let mut scenes = plan.all_scenes().into_iter();
    let scene = scenes.find(|scene| *scene.id() == case.scene);
    scene.is_some_and(|scene| scene.truth_hash(&plan.render, case.alignment) != case.truth_hash)
}

/// Finds the first setting in which an earlier run and the plan differ, with both values.
fn find_difference(
    run: &Run,
    plan: &RunPlan,
    adapter: Option<&AdapterDescription>,
) -> Option<(&'static str, String, String)> {
    let common = plan.common.unwrap_or(run.common_alignment);
    let earlier = list_run_settings(&run.program, run.common_alignment, run.frames, &run.render);
    let now = list_run_settings(PROGRAM, common, plan.frames, &plan.render);
    let both = std::iter::zip(earlier, now);
    let settings = both.map(|((setting, earlier), (_, now))| (setting, earlier, now));
    // A run of programs alone has no adapter, and goes with any.
    let adapters = run.adapter.as_ref().zip(adapter);
    let adapters = adapters.map(|(own, now)| ("adapter", own.name.clone(), now.name.clone()));
    settings
        .chain(adapters)
        .find(|(_, earlier, now)| earlier != now)
}
