//! `shuttertruth run`

use std::path::Path;

use crate::output::wrapped::push_wrapped;
use crate::tables::cases::table;
use crate::tables::failures::failures_text;
use suite::{
    Error, Finding, Outcome, Run, judge, measure_scenes, open_gpu, printable_path, refuse_failures,
};

use super::measure::{adapter_line, claim_out, plan, write_judged};
use super::report::write_report;
use super::say;
use crate::arguments::RunArgs;

/// Loads what is named, runs every case, writes `run.json` and the page, prints the table.
pub fn execute(args: &RunArgs) -> Result<(), Error> {
    let (plan, mut bounds) = plan(&args.measure, args.measure.scenes.out.clone())?;
    let size = (plan.render.width, plan.render.height);
    for bounds in bounds.values_mut() {
        *bounds = std::mem::take(bounds).at(size);
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let _claim = claim_out(&plan)?;
    let run = measure_scenes(&plan, gpu.as_ref(), std::env::args().collect())?;
    let findings = judge(&run, &bounds);
    let json = write_judged(&run, &findings, &plan.out)?;
    let page = (args.html.as_deref())
        .map(|html| write_report(&run, &findings, &plan.out, html))
        .transpose()?;
    if args.json {
        say(&format!("{json}\n"))?;
    } else {
        let scores = table(&run) + &failures_text(&run.failures);
        say(&(scores + &closing(&run, &findings, &plan.out) + &page.unwrap_or_default()))?;
    }
    refuse_failures(&run.failures)
}

/// Counts of bounds, the adapter, and the path of run.json.
fn closing(run: &Run, findings: &[Finding], out: &Path) -> String {
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
        adapter_line(&run.adapter),
        printable_path(&out.join("run.json"))
    );
    text
}
