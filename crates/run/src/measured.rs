//! A run that is measured now, together with an earlier run's cases in the same folder.

use filters::Gpu;
use measure::{
    EarlierCases, Error, FolderLock, Run, RunPlan, estimate_run, folder_for_size, measure_scenes,
};

use crate::noise::choose_samples;
use crate::plan::lock_out;
use crate::previous::keep_aside;
use terminal::expected::print_expected;
use terminal::output::{count_text, is_quiet, print_note};

/// A finished run.
pub struct MeasuredRun {
    /// The requested cases.
    pub run: Run,
    /// The requested cases, and the earlier run's cases that run.json keeps.
    pub whole: Run,
    /// Lock on the folder until all files are written.
    pub lock: FolderLock,
}

/// Runs every case of a plan. Keeps an earlier run's cases in the same folder, except a run of
/// another picture size: that is left alone, and the plan gets a subfolder.
pub fn measure(plan: &mut RunPlan, gpu: Option<&Gpu>) -> Result<MeasuredRun, Error> {
    choose_folder(plan)?;
    let lock = lock_out(plan)?;
    keep_aside(plan)?;
    choose_samples(plan)?;
    let earlier = EarlierCases::find(plan, gpu.map(|gpu| &gpu.adapter)).map_err(name_options)?;
    if !is_quiet() {
        print_expected(&estimate_run(plan, gpu), &plan.out);
    }
    let finished = measure_scenes(plan, gpu, std::env::args().collect())?;
    let whole = match earlier {
        None => finished.clone(),
        Some(earlier) => {
            print_note(&kept_text(&earlier));
            earlier.add_to(&finished)?
        }
    };
    Ok(MeasuredRun {
        run: finished,
        whole,
        lock,
    })
}

/// Leaves a run of another picture size alone, and prints where this one goes.
fn choose_folder(plan: &mut RunPlan) -> Result<(), Error> {
    let size = plan.render.size();
    let folder = match folder_for_size(&plan.out, size) {
        Err(_) if plan.no_cache => return Ok(()),
        folder => folder.map_err(name_options)?,
    };
    if folder != plan.out {
        print_note(&format!(
            "{} holds a run of another picture size; this one, at {size}, goes to {}",
            plan.out.display(),
            folder.display()
        ));
        plan.out = folder;
    }
    Ok(())
}

/// Adds the options that help if an earlier run cannot be kept.
fn name_options(error: Error) -> Error {
    match error {
        Error::Refused(reason) => Error::Refused(format!(
            "{reason}; choose another folder with --out, or replace the earlier run with --no-cache"
        )),
        other => other,
    }
}

/// `run.json keeps 24 cases of an earlier run; --no-cache would drop them`
fn kept_text(earlier: &EarlierCases) -> String {
    let kept = count_text(earlier.count(), "case", "cases");
    let mut text = format!(
        "run.json keeps {kept} of an earlier run next to those of this one; --no-cache would drop them"
    );
    if earlier.outdated > 0 {
        let dropped = count_text(earlier.outdated, "other was", "others were");
        text += &format!("; {dropped} dropped, since the scene has changed");
    }
    text
}
