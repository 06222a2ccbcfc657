//! `shuttertruth check`

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use frame::FileError;
use suite::{
    BOUNDS_FILE, Baseline, Check, Error, Margin, Plan, annotations, bounded_size, check,
    check_bounded, check_names, check_text, compare, junit, open_gpu, read_bounds_file,
    refuse_tracked, run, summary,
};

use super::measure::{adapter_line, check_replicates, claim_out, plan, write_run};
use super::report::write_report;
use super::say;
use crate::cli::CheckArgs;

/// Runs every case, judges it, reports in every form that is asked for. What is wrong with the words of the command line, the
/// bounds or the baseline is said before anything is rendered.
pub fn execute(args: &CheckArgs) -> Result<(), Error> {
    let mut plan = plan(&args.measure, args.measure.scenes.out.clone())?;
    let bounds = plan.scenes.iter().map(|(_, bounds)| bounds);
    if let Some((width, height)) = bounded_size(bounds, &plan.filters, args.measure.size)? {
        (plan.render.width, plan.render.height) = (width, height);
    }
    plan.intervals = true;
    plan.evidence = true;
    check_replicates(plan.render.replicates)?;
    let baseline = args.baseline.as_deref().map(Baseline::read).transpose()?;
    check_configuration(args, &plan, baseline.is_some())?;
    let margins = margins(&args.measure.scenes.scenes_dir)?;
    if !plan.no_cache {
        refuse_tracked(&plan.out)?;
    }
    let summary_file = args.github.then(summary_file).transpose()?;
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref())?;
    let _claim = claim_out(&plan)?;

    let run = run(&plan, gpu.as_ref(), std::env::args().collect())?;
    write_run(&run, &plan.out)?;
    let comparisons = match (&baseline, &args.baseline) {
        (Some(baseline), Some(path)) => compare(&run, baseline, &margins, path)?,
        _ => Vec::new(),
    };
    let check = check(&run, comparisons);
    let page = (args.html.as_deref())
        .map(|html| write_report(&run, &plan.out, html))
        .transpose()?;

    if let Some(path) = &args.junit {
        frame::write_atomically(path, junit(&check).as_bytes())?;
    }
    if let Some(path) = &summary_file {
        append(path, &summary(&check))?;
    }
    if args.json {
        say(&json(&check))?;
    } else {
        let text = check_text(&check, &plan.out);
        let adapter = adapter_line(&run.adapter);
        let other = (baseline.iter()).find(|baseline| !baseline.is_of_class(&run.adapter));
        let note = other.map_or(String::new(), |baseline| {
            let theirs = adapter_line(&baseline.adapter);
            format!("the baseline is of another class of adapter: {theirs}\n")
        });
        let page = page.unwrap_or_default();
        say(&format!("{text}adapter: {adapter}\n{note}{page}"))?;
    }
    if args.github {
        say(&annotations(&check))?;
    }
    check.verdict()
}

/// With a baseline, nothing else need be bounded.
fn check_configuration(args: &CheckArgs, plan: &Plan, compared: bool) -> Result<(), Error> {
    let root = &args.measure.scenes.scenes_dir;
    let bounds = plan.scenes.iter().map(|(_, bounds)| bounds);
    check_names(root, bounds, &plan.filters)?;
    if compared {
        return Ok(());
    }
    let scenes = plan.scenes.iter();
    check_bounded(
        root,
        scenes.map(|(scene, bounds)| (scene.name.as_str(), bounds)),
        &plan.filters,
    )
}

/// By how much scores may be worse than the baseline's.
fn margins(root: &Path) -> Result<BTreeMap<String, Margin>, Error> {
    let path = root.join(BOUNDS_FILE);
    match path.exists() {
        true => Ok(read_bounds_file(&path)?.margins),
        false => Ok(BTreeMap::new()),
    }
}

fn summary_file() -> Result<PathBuf, Error> {
    match std::env::var_os("GITHUB_STEP_SUMMARY") {
        Some(path) if !path.is_empty() => Ok(path.into()),
        _ => Err(Error::Usage(
            "--github: GITHUB_STEP_SUMMARY is not set; it is in a step of GitHub Actions, or set it to a file".to_owned(),
        )),
    }
}

/// Adds to a step's summary, which other programs may have written to as well.
fn append(path: &Path, text: &str) -> Result<(), Error> {
    let write = || {
        let mut file = (std::fs::OpenOptions::new().create(true).append(true)).open(path)?;
        file.write_all(text.as_bytes())
    };
    Ok(write().map_err(|source| FileError::io(path, "write", source))?)
}

fn json(check: &Check) -> String {
    serde_json::to_string_pretty(check).expect("a check is plain data") + "\n"
}
