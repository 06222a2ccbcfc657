//! The command `run`.

use std::path::Path;

use suite::{
    Error, Finding, Outcome, Run, judge, measure_scenes, open_gpu, printable_path, refuse_failures,
};

use super::pages::{write_run_page, written_lines};
use super::plan::{claim_out, make_plan};
use super::run_files::write_judged_run;
use crate::arguments::RunArgs;
use crate::output::print::print;
use crate::output::wrap::push_wrapped;
use crate::tables::adapter::adapter_text;
use crate::tables::cases::run_table;
use crate::tables::failures::failures_text;

/// Runs every case, writes `run.json` and the page, prints the table.
pub fn execute(args: &RunArgs) -> Result<(), Error> {
    let (plan, mut bounds) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    let size = (plan.render.width, plan.render.height);
    for bounds in bounds.values_mut() {
        *bounds = std::mem::take(bounds).at(size);
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let _claim = claim_out(&plan)?;
    let finished = measure_scenes(&plan, gpu.as_ref(), std::env::args().collect())?;
    let findings = judge(&finished, &bounds);
    let json = write_judged_run(&finished, &findings, &plan.out)?;
    let pages = (args.html.as_deref())
        .map(|html| write_run_page(&finished, &findings, &plan.out, html))
        .transpose()?
        .unwrap_or_default();
    if args.json {
        print(&format!("{json}\n"))?;
    } else {
        let scores = run_table(&finished) + &failures_text(&finished.failures);
        print(&(scores + &closing_text(&finished, &findings, &plan.out) + &written_lines(&pages)))?;
    }
    refuse_failures(&finished.failures)
}

/// Counts the bounds, and names the adapter and run.json.
fn closing_text(run: &Run, findings: &[Finding], out: &Path) -> String {
    let count = |outcome| {
        (findings.iter())
            .filter(|finding| finding.outcome == outcome)
            .count()
    };
    let (broken, noisy) = (count(Outcome::Broken), count(Outcome::TooNoisy));
    let mut bounds = format!("{broken} of {} bounds broken", findings.len());
    if noisy > 0 {
        bounds += &format!(
            "; {noisy} narrower than 3 noise floors: raise --samples-per-pixel or --replicates (now {} samples per pixel in all)",
            run.samples_per_pixel
        );
    }
    let mut text = "\n".to_owned();
    push_wrapped(&mut text, 0, &bounds);
    text += &format!(
        "adapter: {}\nwritten: {}\n",
        adapter_text(&run.adapter),
        printable_path(&out.join("run.json"))
    );
    text
}
