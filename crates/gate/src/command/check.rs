//! The command `check`.

use std::io::Write;
use std::path::{Path, PathBuf};
use terminal::refuse;

use scene::Location;

use crate::baseline::{Baseline, compare_with_baseline};
use crate::check::{Check, check};
use clap::{Args, Command, Id};
use frame::FileError;
use judge::{
    BOUNDS_FILE, Finding, Judgement, RunBounds, add_evidence, bound_subframes, check_lengths,
    check_names, judge, require_bounds, size_for_bounds,
};
use measure::{Case, Error, Run, StoredRun, open_gpu, printable_path, refuse_tracked};
use metrics::Metric;
use report::AddToPage;

use crate::tables::{annotations, check_text, junit, page_verdict, summary, verdict_text};
use run::{Margins, add_bounds, make_plan, read_margins};
use run::{MeasuredRun, measure};
use run::{RunPage, WrittenFile, page_lines, refuse_folder, write_judgement, write_run};
use terminal::arguments::{AdapterArgs, MeasureArgs, SequenceArgs};
use terminal::output::{adapter_text, is_verbose, print, print_json, print_note};
use terminal::result::Ending;

/// Lists the arguments that only a measuring check may have.
fn list_measuring() -> Vec<Id> {
    let all = MeasureArgs::augment_args(Command::new("check"));
    let all = AdapterArgs::augment_args(SequenceArgs::augment_args(all));
    let ids = all
        .get_arguments()
        .map(|argument| argument.get_id().clone());
    ids.filter(|id| *id != "scenes_dir" && *id != "threads")
        .collect()
}

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// Finished run to judge: its run.json, or its folder. Renders nothing and opens no adapter
    /// [default: measure now].
    #[arg(help_heading = "Judging", long = "run", value_name = "RUN", conflicts_with_all = list_measuring())]
    pub finished: Option<PathBuf>,
    /// For every broken bound of RUN, find the worst place and the known failure that the picture
    /// resembles most. A check that measures always does.
    #[arg(help_heading = "Judging", long, requires = "finished")]
    pub evidence: bool,
    /// What to measure.
    #[command(flatten)]
    pub measure: MeasureArgs,
    /// Frames of each scene.
    #[command(flatten)]
    pub sequence: SequenceArgs,
    /// Adapter to run kernels on.
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Also compare with the scores that `limits accept` wrote there, by the margins in
    /// bounds.toml.
    #[arg(help_heading = "Judging", long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// HTML page to write [default: report.html in --out; for a finished RUN none].
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write the result as JUnit XML.
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Write GitHub's step summary ($GITHUB_STEP_SUMMARY) and print at most ten annotations.
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub github: bool,
    /// Print the result as JSON instead of text.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Judges a run, made now or finished before, and reports in every requested form. Refuses wrong
/// arguments, bounds and baselines before anything is rendered. `additions` make what other crates
/// add to the page.
pub fn execute(args: &CheckArgs, additions: &[AddToPage]) -> Result<Ending, Error> {
    refuse_folder("--html", args.html.as_ref())?;
    refuse_folder("--junit", args.junit.as_ref())?;
    let root = &args.measure.scenes.root.scenes_dir;
    let compared = match &args.baseline {
        Some(path) => Some((Baseline::read(path)?, path.as_path())),
        None => None,
    };
    let judging = Judging {
        compared,
        margins: read_margins(root)?,
        additions,
    };
    let summary_file = args.github.then(find_summary_file).transpose()?;
    let judged = match &args.finished {
        Some(path) => judge_finished(args, path, &judging)?,
        None => run_and_judge(args, &judging)?,
    };
    report(args, &judging, &judged, summary_file.as_deref())?;
    match judged.checked.verdict() {
        Ok(()) => Ok(Ending::Done),
        // JSON goes to standard output, so the exit code and standard error alone report the
        // verdict.
        Err(error) if args.json => Err(error),
        Err(error) => Ok(Ending::Failed(error)),
    }
}

/// Reports a check in every requested form.
fn report(
    args: &CheckArgs,
    judging: &Judging,
    judged: &Judged,
    summary_file: Option<&Path>,
) -> Result<(), Error> {
    let Judged {
        run,
        checked,
        pages,
        folder,
    } = judged;
    if let Some(path) = &args.junit {
        frame::write_atomically(path, junit(checked, folder, &run.seconds).as_bytes())?;
    }
    let measured = args.finished.as_ref().map(|path| {
        format!(
            "nothing was measured or verified now: the scores are those that {} has",
            printable_path(path)
        )
    });
    if let Some(path) = summary_file {
        let measured = measured.iter().map(|text| format!("\n{text}\n"));
        append(path, &(summary(checked) + &measured.collect::<String>()))?;
    }
    if args.json {
        print_json(checked)?;
        measured.iter().for_each(|text| print_note(text));
    } else {
        let text = check_text(checked, folder, is_verbose());
        let mut baselines = judging.compared.iter().map(|(baseline, _)| baseline);
        let other = baselines.find(|baseline| !baseline.is_of_class(&run.adapter));
        let note = other.map_or(String::new(), |baseline| {
            let theirs = adapter_text(&baseline.adapter);
            format!("the baseline is of another class of adapter: {theirs}\n")
        });
        let pages = page_lines("report", pages);
        let adapter = adapter_text(&run.adapter);
        let measured = measured.map_or(String::new(), |text| text + "\n");
        let verdict = verdict_text(checked);
        let adapter = format!("adapter: {adapter}\n");
        print(text + note + pages + adapter + measured + verdict)?;
    }
    if args.github {
        print(annotations(checked))?;
    }
    Ok(())
}

/// What a run is judged by, other than bounds, and what its page shows of other crates.
struct Judging<'a> {
    /// Baseline, and its file.
    compared: Option<(Baseline, &'a Path)>,
    margins: Margins,
    additions: &'a [AddToPage],
}

impl Judging<'_> {
    fn check(&self, run: &Run, findings: Vec<Finding>) -> Result<Check, Error> {
        let comparisons = match &self.compared {
            Some((baseline, path)) => compare_with_baseline(run, baseline, &self.margins, path)?,
            None => Vec::new(),
        };
        Ok(check(run, findings, comparisons))
    }
}

/// A run, its check, its pages, and the folder of its files.
struct Judged {
    run: Run,
    checked: Check,
    pages: Vec<WrittenFile>,
    folder: PathBuf,
}

/// Measures every case as `run` does, judges it and looks for evidence. Ladders, which need a
/// quarter of the time, are left out unless something is judged by them.
fn run_and_judge(args: &CheckArgs, judging: &Judging) -> Result<Judged, Error> {
    let (mut plan, bounds) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    let asked = args.measure.size;
    if let Some(size) = size_for_bounds(bounds.values(), &plan.filters, asked)? {
        plan.render = plan.render.with_size(size);
    }
    check_lengths(bounds.values(), &plan.filters, args.sequence.frames())?;
    plan.frames = args.sequence.frames();
    plan.intervals = true;
    plan.check()?;
    plan.ladders = bound_subframes(bounds.values(), &plan.filters)
        || (judging.margins.keys()).any(|metric| matches!(metric, Metric::Equivalent(_)));
    let root = &args.measure.scenes.root.scenes_dir;
    check_names(root, bounds.values(), &plan.filters)?;
    // With a baseline, no bound is required.
    if judging.compared.is_none() {
        require_bounds(root, bounds.iter(), &plan.filters, plan.frames)?;
    }
    if let Some(truths) = &plan.truths {
        let way_out = "choose a folder outside of the repository for --truths";
        refuse_tracked(truths, way_out)?;
    }
    if !plan.no_cache {
        let way_out = "choose a folder outside of the repository for --out, or have all made anew with --no-cache";
        refuse_tracked(&plan.out, way_out)?;
    }
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let MeasuredRun {
        run,
        whole,
        lock: _lock,
    } = measure(&mut plan, gpu.as_ref())?;
    write_run(&whole, &plan.out)?;
    let mut findings = judge(&whole, &bounds);
    add_evidence(&whole, &mut findings, &plan.out)?;
    let mut asked_for = findings.clone();
    asked_for.retain(|finding| run.cases.iter().any(|case| finding.is_of(case)));
    let checked = judging.check(&run, asked_for)?;
    let verdict = Some(page_verdict(&checked));
    let html = args.html.as_ref();
    let additions = judging.additions;
    let pages = write_judgement(&whole, &findings, verdict, &plan.out, html, additions)?;
    Ok(Judged {
        run,
        checked,
        pages,
        folder: plan.out,
    })
}

/// Judges a finished run by its scenes' bounds; renders nothing and opens no adapter.
fn judge_finished(args: &CheckArgs, path: &Path, judging: &Judging) -> Result<Judged, Error> {
    let side = StoredRun::read(path)?;
    let folder = match side.folder() {
        folder if folder.as_os_str().is_empty() => PathBuf::from("."),
        folder => folder.to_owned(),
    };
    let run = side.run;
    refuse_tracked(&folder, "measure it now: shuttertruth check, without --run")?;
    let root = &args.measure.scenes.root.scenes_dir;
    let bounds = read_run_bounds(&run, root)?;
    let mut findings = judge(&run, &bounds);
    if findings.is_empty() && judging.compared.is_none() {
        refuse!(
            "{}: none of its scores has a bound, and a check without bounds fails; bounds are read from {} and from the \
             folder of each scene below it: name another folder with --scenes-dir",
            side.path.display(),
            root.join(BOUNDS_FILE)
        );
    }
    if args.evidence {
        add_evidence(&run, &mut findings, &folder)?;
    }
    let checked = judging.check(&run, findings)?;
    let (findings, verdict) = (&checked.findings, page_verdict(&checked));
    let judgement = Judgement::new(&folder, findings.clone(), Some(verdict.clone()))?;
    match judgement.write(&folder) {
        Err(Error::File(error @ FileError::Io { .. })) => print_note(&format!(
            "{error}; `report` shows an earlier judgement of this run, or none"
        )),
        written => written?,
    }
    let pages = match &args.html {
        Some(html) => RunPage {
            run: &run,
            findings,
            verdict: Some(&verdict),
            folder: &folder,
            html,
            additions: judging.additions,
        }
        .write()?,
        None => Vec::new(),
    };
    Ok(Judged {
        run,
        checked,
        pages,
        folder,
    })
}

/// Reads the bounds of a run's scenes, for the run's picture size, from the folder of scenes.
fn read_run_bounds(run: &Run, root: &Location) -> Result<RunBounds, Error> {
    let mut bounds = RunBounds::new();
    add_bounds(&mut bounds, run, root)?;
    let is_missing = |case: &&Case| !bounds.contains_key(&case.scene);
    match run.cases.iter().find(is_missing) {
        None => Ok(bounds),
        Some(case) if case.drawn.is_some() => refuse!(
            "{}: an engine drew it, and its bounds lie beside what was ingested, which is not in {root}; name the folder \
             above that with --scenes-dir, such as out/engine, or measure it now: shuttertruth check FOLDER",
            case.scene
        ),
        Some(case) => refuse!(
            "{}: there is no such scene, and its bounds cannot be read; name the folder of the run's scenes with --scenes-dir",
            root.join(&case.scene.name)
        ),
    }
}

fn find_summary_file() -> Result<PathBuf, Error> {
    match std::env::var_os("GITHUB_STEP_SUMMARY") {
        Some(path) if !path.is_empty() => Ok(path.into()),
        _ => refuse!(
            "--github: GITHUB_STEP_SUMMARY is not set; it is in a step of GitHub Actions, or set it to a file"
        ),
    }
}

/// Appends to a step's summary, which other programs may share.
fn append(path: &Path, text: &str) -> Result<(), Error> {
    let write = || {
        let mut file = (std::fs::OpenOptions::new().create(true).append(true)).open(path)?;
        file.write_all(text.as_bytes())
    };
    Ok(write().map_err(|source| FileError::io(path, "write", source))?)
}
