//! `shuttertruth run`

use std::path::Path;

use suite::{
    Error, Outcome, Run, failures_text, open_gpu, printable_path, push_wrapped, refuse_failures,
    run, table,
};

use super::measure::{adapter_line, plan, write_run};
use super::report::write_report;
use super::say;
use crate::cli::RunArgs;

/// Loads what is named, runs every case, writes `run.json` and the page, prints the table.
pub fn execute(args: &RunArgs) -> Result<(), Error> {
    let mut plan = plan(&args.measure, args.measure.scenes.out.clone())?;
    let size = (plan.render.width, plan.render.height);
    for (_, bounds) in &mut plan.scenes {
        *bounds = std::mem::take(bounds).at(size);
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref())?;
    let run = run(&plan, gpu.as_ref(), std::env::args().collect())?;
    let json = write_run(&run, &plan.out)?;
    let page = (args.html.as_deref())
        .map(|html| write_report(&run, &plan.out, html))
        .transpose()?;
    if args.json {
        say(&format!("{json}\n"))?;
    } else {
        let scores = table(&run) + &failures_text(&run.failures);
        say(&(scores + &closing(&run, &plan.out) + &page.unwrap_or_default()))?;
    }
    refuse_failures(&run.failures)
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
    let mut bounds = format!("{broken} of {} bounds broken", verdicts().count());
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
