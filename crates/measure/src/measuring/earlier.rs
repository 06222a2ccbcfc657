//! Cases of an earlier run in the same folder that a narrower run keeps.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use filters::AdapterDescription;
use frame::Size;
use scene::SceneId;

use crate::fold::fold_runs;
use crate::identity::FilterId;
use crate::measuring::plan::RunPlan;
use crate::measuring::planned_case::PlannedCase;
use crate::run::Run;
use crate::run::case::Case;
use crate::run::stored::StoredRun;
use crate::{Error, RenderFile};

/// Cases of an earlier run that a plan does not include.
pub struct EarlierCases {
    kept: StoredRun,
    /// Outdated cases of the earlier run: their scene has changed since.
    pub outdated: usize,
}

impl EarlierCases {
    /// Finds the cases of `run.json` in the plan's folder that the plan leaves out, and lets the
    /// plan use the same common shutter. None if there is nothing to keep: no run, or one whose
    /// cases are all measured again.
    ///
    /// # Errors
    /// The earlier run cannot be read, or has other settings, so that its cases cannot be kept with
    /// the plan's.
    pub fn find(
        plan: &mut RunPlan,
        adapter: Option<&AdapterDescription>,
    ) -> Result<Option<Self>, Error> {
        if plan.no_cache {
            return Ok(None);
        }
        let path = plan.out.join("run.json");
        let Some(mut run) = read_earlier_run(&path)? else {
            return Ok(None);
        };
        let planned = Planned::new(plan);
        let is_left_out = |case: &&Case| !case.is_reference && !planned.names(case);
        let left_out = run.cases.iter().filter(is_left_out).count();
        if left_out == 0 {
            return Ok(None);
        }
        plan.common.get_or_insert(run.common_alignment);
        if let Some((setting, earlier, now)) = run.find_difference(&plan.facts(adapter)) {
            let (dropped, them) = match left_out {
                1 => ("1 case".to_owned(), "it"),
                count => (format!("{count} cases"), "them"),
            };
            return Err(Error::Refused(format!(
                "{}: this run would drop {dropped} of an earlier one, and cannot keep {them}: {setting} was {earlier}, now \
                 {now}",
                path.display()
            )));
        }
        // The common shutter has its own references.
        let planned = Planned::new(plan);
        run.cases.retain(|case| !planned.names(case));
        let is_outdated = |case: &mut Case| is_outdated(plan, case);
        let outdated: Vec<Case> = run.cases.extract_if(.., is_outdated).collect();
        run.failures
            .retain(|failure| !planned.has(&failure.scene, &failure.filter_id()));
        run.sequences.retain(|sequence| {
            let is_current = outdated.iter().all(|case| case.scene != sequence.scene);
            is_current && !planned.has(&sequence.scene, &sequence.filter)
        });
        Ok(Some(Self {
            kept: StoredRun { path, run },
            outdated: outdated.iter().filter(|case| !case.is_reference).count(),
        }))
    }

    /// Number of filter cases that are kept.
    pub fn count(&self) -> usize {
        let cases = self.kept.run.cases.iter();
        cases.filter(|case| !case.is_reference).count()
    }

    /// Folds the kept cases into a finished run.
    ///
    /// # Errors
    /// The kept cases have other settings than the run.
    pub fn add_to(self, run: &Run) -> Result<Run, Error> {
        let stored_run = StoredRun {
            path: self.kept.path.clone(),
            run: run.clone(),
        };
        fold_runs(&[stored_run, self.kept])
    }
}

/// Identities of a plan's cases: scenes with their filters, with and without overrides.
struct Planned(HashSet<(SceneId, FilterId)>);

impl Planned {
    fn new(plan: &RunPlan) -> Self {
        let of_scene = |scene| PlannedCase::all(plan, scene);
        let planned = plan.all_scenes().into_iter().flat_map(of_scene);
        let both = planned.flat_map(|case| [case.id.of_preset(), case.id]);
        Self(both.map(|id| (id.scene.clone(), id.filter_id())).collect())
    }

    /// Returns whether the plan measures a filter on a scene, at any frame.
    fn has(&self, scene: &SceneId, filter: &FilterId) -> bool {
        self.0.contains(&(scene.at_frame(0), filter.clone()))
    }

    /// Returns whether the plan measures a case, with any overrides.
    fn names(&self, case: &Case) -> bool {
        self.has(&case.scene, &case.of_preset().filter_id())
    }
}

/// Names the folder for a run of one picture size: `out` itself, or `160x90` below it if `out`
/// holds a run of another size, whose pictures have the same names.
///
/// # Errors
/// The run in `out` cannot be read.
pub fn folder_for_size(out: &Path, size: Size) -> Result<PathBuf, Error> {
    let earlier = read_earlier_run(&out.join("run.json"))?;
    Ok(match earlier {
        Some(run) if run.render.size() != size => out.join(size.to_string()),
        _ => out.to_owned(),
    })
}

/// Finds the runs of other picture sizes below `out` that are newer than the run in `out` itself,
/// and returns their folders.
pub fn find_newer_sizes(out: &Path) -> Vec<PathBuf> {
    let written = |folder: &Path| fs::metadata(folder.join("run.json"))?.modified();
    let (Ok(written_out), Ok(entries)) = (written(out), fs::read_dir(out)) else {
        return Vec::new();
    };
    let is_size = |folder: &Path| Some(folder.file_name()?.to_str()?.parse::<Size>().is_ok());
    let mut newer: Vec<PathBuf> = (entries.flatten().map(|entry| entry.path()))
        .filter(|folder| is_size(folder) == Some(true))
        .filter(|folder| written(folder).is_ok_and(|time| time > written_out))
        .collect();
    newer.sort();
    newer
}

/// Reads the run that a new one would replace; none without such a file.
fn read_earlier_run(path: &Path) -> Result<Option<Run>, Error> {
    if !path.exists() {
        return Ok(None);
    }
    Run::read(path).map(Some).map_err(|error| {
        Error::Refused(format!(
            "{error}; a new run would replace it and lose what it holds; repair or remove it"
        ))
    })
}

/// Returns whether a scene of the plan has changed since the case was measured.
fn is_outdated(plan: &RunPlan, case: &Case) -> bool {
    let mut scenes = plan.all_scenes().into_iter();
    let scene = scenes.find(|scene| *scene.id() == case.scene);
    let file = RenderFile::Truth(case.alignment);
    scene.is_some_and(|scene| plan.rendering(scene).content_hash(file) != case.truth_hash)
}
