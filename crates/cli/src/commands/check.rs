//! `shuttertruth check`

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::output::github::{annotations, summary};
use crate::output::junit::junit;
use crate::tables::check::check_text;
use frame::FileError;
use suite::{
    BOUNDS_FILE, Baseline, Check, Error, Finding, Judgement, Margin, Run, RunBounds, add_evidence,
    bounded_size, check, check_bounded, check_names, compare, judge, measure_scenes, open_gpu,
    read_bounds, read_bounds_file, refuse_tracked,
};

use super::measure::{adapter_line, check_replicates, claim_out, plan, write_judged};
use super::report::write_report;
use super::say;
use crate::arguments::CheckArgs;

/// Judges a run, one that is made now or one that is finished, and reports in every form that is asked for. What is wrong with
/// the words of the command line, the bounds or the baseline is said before anything is rendered.
pub fn execute(args: &CheckArgs) -> Result<(), Error> {
    let baseline = args.baseline.as_deref().map(Baseline::read).transpose()?;
    let margins = margins(&args.measure.scenes.scenes_dir)?;
    let summary_file = args.github.then(summary_file).transpose()?;
    let Judged {
        run,
        findings,
        folder,
    } = match &args.run {
        Some(path) => judge_finished(args, path, baseline.is_some())?,
        None => run_and_judge(args, baseline.is_some())?,
    };
    let comparisons = match (&baseline, &args.baseline) {
        (Some(baseline), Some(path)) => compare(&run, baseline, &margins, path)?,
        _ => Vec::new(),
    };
    let page = (args.html.as_deref())
        .map(|html| write_report(&run, &findings, &folder, html))
        .transpose()?;
    let check = check(&run, findings, comparisons);

    if let Some(path) = &args.junit {
        frame::write_atomically(path, junit(&check).as_bytes())?;
    }
    if let Some(path) = &summary_file {
        append(path, &summary(&check))?;
    }
    if args.json {
        say(&json(&check))?;
    } else {
        let text = check_text(&check, &folder);
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

/// A run, the findings about it, and the folder of its files.
struct Judged {
    run: Run,
    findings: Vec<Finding>,
    folder: PathBuf,
}

/// Measures every case, as `run` does, judges it and looks for evidence.
fn run_and_judge(args: &CheckArgs, compared: bool) -> Result<Judged, Error> {
    let (mut plan, bounds) = plan(&args.measure, args.measure.scenes.out.clone())?;
    if let Some((width, height)) = bounded_size(bounds.values(), &plan.filters, args.measure.size)?
    {
        (plan.render.width, plan.render.height) = (width, height);
    }
    plan.intervals = true;
    check_replicates(plan.render.replicates)?;
    let root = &args.measure.scenes.scenes_dir;
    check_names(root, bounds.values(), &plan.filters)?;
    // With a baseline, nothing else need be bounded.
    if !compared {
        let scenes = bounds.iter().map(|(name, bounds)| (name.as_str(), bounds));
        check_bounded(root, scenes, &plan.filters)?;
    }
    if !plan.no_cache {
        let way_out = "choose a folder outside of the repository for --out, or have all made anew with --no-cache";
        refuse_tracked(&plan.out, way_out)?;
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let _claim = claim_out(&plan)?;
    let run = measure_scenes(&plan, gpu.as_ref(), std::env::args().collect())?;
    let mut findings = judge(&run, &bounds);
    add_evidence(&run, &mut findings, &plan.out)?;
    write_judged(&run, &findings, &plan.out)?;
    Ok(Judged {
        run,
        findings,
        folder: plan.out,
    })
}

/// Judges a finished run by the bounds beside its scenes: nothing is rendered, and no adapter is opened.
fn judge_finished(args: &CheckArgs, path: &Path, compared: bool) -> Result<Judged, Error> {
    let path = match path.is_dir() {
        true => path.join("run.json"),
        false => path.to_owned(),
    };
    let run = Run::read(&path)?;
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    refuse_tracked(&folder, "measure it now: shuttertruth check, without a RUN")?;
    let root = &args.measure.scenes.scenes_dir;
    let bounds = bounds_of(&run, root)?;
    let mut findings = judge(&run, &bounds);
    if findings.is_empty() && !compared {
        return Err(Error::Usage(format!(
            "{}: no score of it has a bound, and no check is no success; bounds are looked for in {} and beside each scene \
             below it: name another folder with --scenes-dir",
            path.display(),
            root.join(BOUNDS_FILE).display()
        )));
    }
    if args.evidence {
        add_evidence(&run, &mut findings, &folder)?;
    }
    Judgement::new(&folder, findings.clone())?.write(&folder)?;
    Ok(Judged {
        run,
        findings,
        folder,
    })
}

/// The bounds of a run's scenes, in the folder of scenes that they came from, for pictures of the run's size.
fn bounds_of(run: &Run, root: &Path) -> Result<RunBounds, Error> {
    let mut found = RunBounds::new();
    for case in &run.cases {
        if found.contains_key(&case.scene) {
            continue;
        }
        let name = (case.scene.split_once('@')).map_or(case.scene.as_str(), |(name, _)| name);
        let folder = root.join(name);
        if !folder.is_dir() {
            return Err(Error::Usage(format!(
                "{}: there is no such scene, and its bounds cannot be read; name the folder of the run's scenes with --scenes-dir",
                folder.display()
            )));
        }
        let bounds = read_bounds(root, &folder)?.at((run.width, run.height));
        found.insert(case.scene.clone(), bounds);
    }
    Ok(found)
}

/// Margins by which scores may be worse than the baseline's.
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
