//! A run that is measured now, beside the cases of an earlier run in the same folder.

use filters::Gpu;
use suite::{Claim, EarlierCases, Error, Run, RunPlan, estimate_run, measure_scenes};

use super::expected::print_expected;
use super::plan::claim_out;
use crate::output::count::count_text;
use crate::output::print::print_note;

/// A finished run.
pub struct MeasuredRun {
    /// The cases that were asked for.
    pub run: Run,
    /// These, and the cases of an earlier run that run.json keeps.
    pub whole: Run,
    /// Claim on the folder, until all files are written.
    pub claim: Claim,
}

/// Runs every case of a plan. Cases of an earlier run in the same folder are kept beside them.
pub fn measure(plan: &mut RunPlan, gpu: Option<&Gpu>) -> Result<MeasuredRun, Error> {
    let claim = claim_out(plan)?;
    let earlier = find_earlier(plan, gpu)?;
    print_expected(&estimate_run(plan, gpu), &plan.out);
    let finished = measure_scenes(plan, gpu, std::env::args().collect())?;
    let whole = match earlier {
        None => finished.clone(),
        Some(earlier) => {
            print_note(&kept_text(&earlier));
            earlier.add_to(&finished)
        }
    };
    Ok(MeasuredRun {
        run: finished,
        whole,
        claim,
    })
}

/// Finds the cases of an earlier run; names the options for it where they cannot be kept.
fn find_earlier(plan: &mut RunPlan, gpu: Option<&Gpu>) -> Result<Option<EarlierCases>, Error> {
    EarlierCases::find(plan, gpu.map(|gpu| &gpu.adapter)).map_err(|error| match error {
        Error::Usage(reason) => Error::Usage(format!(
            "{reason}; choose another folder with --out, or replace the earlier run with --no-cache"
        )),
        other => other,
    })
}

/// `run.json keeps 24 cases of an earlier run; --no-cache would drop them`
fn kept_text(earlier: &EarlierCases) -> String {
    let kept = count_text(earlier.count(), "case", "cases");
    let mut text = format!(
        "run.json keeps {kept} of an earlier run beside those of this one; --no-cache would drop them"
    );
    if earlier.outdated > 0 {
        let dropped = count_text(earlier.outdated, "other was", "others were");
        text += &format!("; {dropped} dropped, since the scene has changed");
    }
    text
}
