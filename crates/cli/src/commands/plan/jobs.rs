//! Jobs of a run or a calibration: truths, references, filters, the merge, and the report.

use std::path::{Path, PathBuf};

use frame::Alignment;
use suite::{Error, JobCost, RunPlan, SceneJobs, estimate_jobs, estimate_report};

use super::arguments::PlanArgs;
use super::filter_words::{FilterWords, list_filter_words};
use super::given::{given_options, words_behind};
use super::job::{Job, path_word};
use super::scene_words::{SceneWords, list_scene_words};
use crate::commands::render::RenderArgs;
use crate::commands::run::RunArgs;

/// Options that every job of cases gets in words of its own, or that change no case.
const OWN: [&str; 17] = [
    "scenes",
    "seal",
    "frame-rate",
    "shutter-time",
    "filter",
    "preset",
    "set",
    "size",
    "out",
    "common",
    "part",
    "truths",
    "html",
    "table",
    "json",
    "no-cache",
    "quiet",
];
/// Options of a calibration's jobs that are its own as well.
const OWN_OF_SEEDS: [&str; 3] = ["seed", "intervals", "jitter-frames"];
/// Options that a render gets in words of its own.
const OWN_OF_RENDERS: [&str; 10] = [
    "scenes",
    "seal",
    "frame-rate",
    "shutter-time",
    "size",
    "out",
    "alignments",
    "ladders",
    "noise",
    "most-replicates",
];

/// Everything that the jobs of one run share.
struct Planner<'a> {
    plan: &'a RunPlan,
    scenes: &'a [SceneWords],
    filters: &'a [FilterWords],
    costs: &'a [SceneJobs],
    /// Folder of the parts.
    parts: PathBuf,
    /// Folder of the truths.
    truths: PathBuf,
    /// True if jobs render the truths.
    renders: bool,
    /// Words of every job of cases.
    measuring: Vec<String>,
    /// Words of every render.
    rendering: Vec<String>,
    /// Begin of the names of jobs.
    prefix: String,
}

/// Lists all jobs; each stands behind those whose outputs it needs.
pub fn list_jobs(args: &PlanArgs, plan: &RunPlan) -> Result<Vec<Job>, Error> {
    let scenes = list_scene_words(&args.measure.scenes)?;
    let filters = list_filter_words(&args.measure, &plan.filters)?;
    let costs = estimate_jobs(plan);
    let planner = Planner {
        plan,
        scenes: &scenes,
        filters: &filters,
        costs: &costs,
        parts: args.parts.clone().unwrap_or_else(|| plan.out.join("parts")),
        truths: PathBuf::new(),
        renders: plan.truths.is_none(),
        measuring: Vec::new(),
        rendering: Vec::new(),
        prefix: String::new(),
    };
    match args.runs {
        None => planner.jobs_of_run(),
        Some(runs) => planner.jobs_of_calibration(runs),
    }
}

impl Planner<'_> {
    fn jobs_of_run(mut self) -> Result<Vec<Job>, Error> {
        self.measuring = given_options::<RunArgs>(&OWN)?;
        self.rendering = given_options::<RenderArgs>(&OWN_OF_RENDERS)?;
        self.truths = self
            .plan
            .truths
            .clone()
            .unwrap_or_else(|| self.parts.join("truths"));
        let but = [("json", false), ("parts", true)];
        let mut command = vec![program(), "run".to_owned()];
        command.extend(words_behind(&but)?);
        let mut jobs = self.jobs_of_parts(&self.plan.out, &command)?;
        let cases: usize = self.filters.iter().map(|filter| filter.words.len()).sum();
        let cost = estimate_report(self.plan, cases * self.scenes.len());
        let mut report = Job::new("report".to_owned(), cost);
        let run = path_word(&self.plan.out.join("run.json"))?;
        report.arguments = words(["report", "--quiet", &run]);
        report.inputs = vec![run];
        report.outputs = vec![path_word(&self.plan.out.join("report.html"))?];
        jobs.push(report);
        Ok(jobs)
    }

    /// One run per seed, and the command itself, which reads all of them back.
    fn jobs_of_calibration(mut self, runs: u32) -> Result<Vec<Job>, Error> {
        let measuring = given_options::<RunArgs>(&[&OWN[..], &OWN_OF_SEEDS].concat())?;
        let rendering = given_options::<RenderArgs>(&[&OWN_OF_RENDERS[..], &["seed"]].concat())?;
        let parts = self.parts.clone();
        let but = [("json", false), ("parts", true)];
        let mut command = words(["limits", "calibrate"]);
        command.extend(words_behind(&but)?);
        let mut jobs = Vec::new();
        let mut merged = Vec::new();
        let first = self.plan.render.seed;
        for seed in (0..runs).map(|run| first.saturating_add(u64::from(run))) {
            let own = words(["--seed", &seed.to_string()]);
            self.prefix = format!("seed_{seed}/");
            self.parts = parts.join(format!("seed_{seed}"));
            self.truths = self
                .plan
                .truths
                .clone()
                .unwrap_or_else(|| self.parts.join("truths"));
            self.rendering = [&rendering[..], &own].concat();
            let fixed = words(["--intervals", "--jitter-frames", "0"]);
            self.measuring = [&measuring[..], &own, &fixed].concat();
            let out = self.plan.out.join(format!("seed_{seed}"));
            jobs.extend(self.jobs_of_parts(&out, &[&[program()], &command[..]].concat())?);
            merged.push(path_word(&out.join("run.json"))?);
        }
        let cost = JobCost {
            cpu_seconds: 1.0,
            memory: self
                .costs
                .iter()
                .map(|scene| scene.cases(1).memory)
                .max()
                .unwrap_or(0),
        };
        let mut last = Job::new("calibrate".to_owned(), cost);
        last.arguments = command;
        last.inputs = merged;
        for scene in self.scenes {
            let bounds = format!("{}.bounds.toml", scene.id);
            last.outputs.push(path_word(&self.plan.out.join(bounds))?);
        }
        jobs.push(last);
        Ok(jobs)
    }

    /// Truths of every scene, references and filters, and the merge into `out`.
    fn jobs_of_parts(&self, out: &Path, command: &[String]) -> Result<Vec<Job>, Error> {
        let mut jobs = Vec::new();
        let mut parts = Vec::new();
        for (scene, costs) in self.scenes.iter().zip(self.costs) {
            let mut inputs = scene.files.clone();
            if let Some(cost) = costs.render.filter(|_| self.renders) {
                let truths = self.truth_job(scene, cost)?;
                inputs.extend(truths.outputs.clone());
                jobs.push(truths);
            }
            let all: Vec<&FilterWords> = self.filters.iter().collect();
            let references = ("references", &all[..], costs.cases(costs.references));
            let filters = all.iter().map(|filter| {
                let cases = filter.words.len() * costs.inputs;
                ("filters", std::slice::from_ref(filter), costs.cases(cases))
            });
            for (part, filters, cost) in std::iter::once(references).chain(filters) {
                let mut job = self.case_job(scene, part, filters, cost)?;
                job.inputs.splice(0..0, inputs.clone());
                job.inputs
                    .extend(filters.iter().flat_map(|filter| filter.files.clone()));
                parts.extend(job.outputs.clone());
                jobs.push(job);
            }
        }
        let cost = JobCost {
            cpu_seconds: 1.0,
            memory: jobs.iter().map(|job| job.memory).max().unwrap_or(0),
        };
        let mut merge = Job::new(format!("{}merge", self.prefix), cost);
        merge.arguments = words(["truths", "merge", "--quiet"]);
        let folder = |run: &String| Path::new(run).parent().map_or(Ok(String::new()), path_word);
        for run in &parts {
            merge.arguments.push(folder(run)?);
        }
        merge
            .arguments
            .extend(words(["--out", &path_word(out)?, "--"]));
        merge.arguments.extend_from_slice(command);
        merge.inputs = parts;
        merge.outputs = vec![path_word(&out.join("run.json"))?];
        jobs.push(merge);
        Ok(jobs)
    }

    fn truth_job(&self, scene: &SceneWords, cost: JobCost) -> Result<Job, Error> {
        let mut job = Job::new(format!("{}truths/{}", self.prefix, scene.id), cost);
        let alignments = self.plan.alignments();
        let names: Vec<&str> = alignments.into_iter().map(Alignment::name).collect();
        job.arguments = words(["truths", "render", "--quiet", "--scenes", &scene.word]);
        job.arguments.extend(self.rendering.clone());
        job.arguments.extend(words([
            "--size",
            &self.size(),
            "--alignments",
            &names.join(","),
            "--ladders",
            "--out",
            &path_word(&self.truths)?,
        ]));
        job.inputs = scene.files.clone();
        for frame in 0..self.plan.frames.count {
            let folder = self.truths.join(scene.id.at_frame(frame).folder());
            job.outputs.push(path_word(&folder.join("frame.exr"))?);
            for name in &names {
                // The last file that a render writes of a truth.
                job.outputs
                    .push(path_word(&folder.join(format!("truth_{name}.exr")))?);
                job.outputs
                    .push(path_word(&folder.join(format!("ladder_{name}/n64.exr")))?);
            }
        }
        Ok(job)
    }

    fn case_job(
        &self,
        scene: &SceneWords,
        part: &str,
        filters: &[&FilterWords],
        cost: JobCost,
    ) -> Result<Job, Error> {
        let name = match (part, filters) {
            ("filters", [filter]) => format!("filters/{}/{}", scene.id, filter.name),
            _ => format!("references/{}", scene.id),
        };
        let folder = self.parts.join(&name);
        let mut job = Job::new(format!("{}{name}", self.prefix), cost);
        job.arguments = words(["run", "--quiet", "--scenes", &scene.word]);
        for word in filters.iter().flat_map(|filter| &filter.words) {
            job.arguments.extend(words(["--filter", word]));
        }
        for set in filters.iter().flat_map(|filter| &filter.overrides) {
            job.arguments.extend(words(["--set", set]));
        }
        job.arguments.extend(self.measuring.clone());
        job.arguments.extend(words([
            "--size",
            &self.size(),
            "--common",
            self.plan.common_alignment().name(),
            "--part",
            part,
            "--out",
            &path_word(&folder)?,
        ]));
        // What an engine drew has its truth beside it.
        if scene.is_rendered {
            let truths = path_word(&self.truths)?;
            job.arguments.extend(words(["--truths", &truths]));
            if self.truths.is_file() {
                job.inputs.push(truths);
            }
        }
        job.outputs = vec![path_word(&folder.join("run.json"))?];
        Ok(job)
    }

    fn size(&self) -> String {
        format!("{}x{}", self.plan.render.width, self.plan.render.height)
    }
}

/// Returns this program's name, as the command line has it.
fn program() -> String {
    std::env::args()
        .next()
        .unwrap_or_else(|| "shuttertruth".to_owned())
}

fn words<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).to_vec()
}
