//! Jobs of a run or a calibration: truths, references, filters, the merge, and the report.

use std::path::{Path, PathBuf};

use clap::{ArgMatches, Args};
use frame::Alignment;
use serde::Serialize;
use suite::{Error, JobCost, RunPlan, estimate_jobs, estimate_report};

use super::words::{
    FilterWords, SceneWords, list_filter_words, list_scene_words, path_word, push_given, words,
    words_behind,
};
use crate::arguments::MeasureArgs;
use crate::commands::calibrate::list_seeds;
use crate::commands::render::RenderArgs;
use crate::commands::run::RunArgs;

/// A process of this program: one line of a plan.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Job {
    /// Unique name.
    pub job: String,
    /// Words after the program's name.
    pub arguments: Vec<String>,
    /// Files that must exist before it starts.
    pub inputs: Vec<String>,
    /// Files that exist after it ends.
    pub outputs: Vec<String>,
    /// Expected time on one core, in seconds.
    pub cpu_seconds: f64,
    /// Expected peak memory, in bytes.
    pub memory: u64,
}

impl Job {
    /// Makes a job from its cost, without words and files.
    fn new(job: &str, cost: JobCost) -> Self {
        Self {
            job: job.to_owned(),
            // Estimates are no more precise.
            cpu_seconds: (cost.cpu_seconds * 10.0).ceil() / 10.0,
            memory: cost.memory,
            ..Self::default()
        }
    }

    /// Makes a job that reads the outputs of all others and needs no time.
    fn last_of(jobs: &[Self], job: &str) -> Self {
        let cost = JobCost {
            cpu_seconds: 1.0,
            memory: jobs.iter().map(|job| job.memory).max().unwrap_or(0),
        };
        Self::new(job, cost)
    }
}

/// Lists all jobs of a run or a calibration; each comes after the jobs that produce its inputs.
pub fn list_jobs(
    args: &MeasureArgs,
    parts: Option<&Path>,
    runs: Option<u32>,
    given: &ArgMatches,
    plan: &RunPlan,
) -> Result<Vec<Job>, Error> {
    let whole = Planner {
        given,
        plan,
        scenes: list_scene_words(args, plan)?,
        filters: list_filter_words(args, plan)?,
        seed: None,
        parts: parts.map_or_else(|| plan.out.join("parts"), Path::to_owned),
        out: plan.out.clone(),
    };
    match runs {
        None => whole.jobs_of_run(),
        Some(runs) => whole.jobs_of_calibration(runs),
    }
}

/// Planner of one run's jobs: the only run, or a seed's.
#[derive(Clone)]
struct Planner<'a> {
    given: &'a ArgMatches,
    plan: &'a RunPlan,
    scenes: Vec<SceneWords>,
    filters: Vec<FilterWords>,
    seed: Option<u64>,
    /// Folder of the parts.
    parts: PathBuf,
    /// Folder of the whole run.
    out: PathBuf,
}

impl Planner<'_> {
    fn jobs_of_run(&self) -> Result<Vec<Job>, Error> {
        let mut jobs = self.list_jobs(words(["run"]))?;
        let presets: usize = self.filters.iter().map(|filter| filter.presets).sum();
        let cost = estimate_report(self.plan, presets * self.scenes.len());
        let run = self.below_out("run.json")?;
        jobs.push(Job {
            arguments: words(["report", "--quiet", &run]),
            inputs: vec![run],
            outputs: vec![self.below_out("report.html")?],
            ..Job::new("report", cost)
        });
        Ok(jobs)
    }

    /// Lists one run per seed, then the calibration itself, which reads them all.
    fn jobs_of_calibration(&self, runs: u32) -> Result<Vec<Job>, Error> {
        let command = words(["limits", "calibrate"]);
        let (mut jobs, mut inputs) = (Vec::new(), Vec::new());
        for seed in list_seeds(self.plan.render.seed, runs)? {
            let mut run = self.clone();
            run.seed = Some(seed);
            run.parts.push(format!("seed_{seed}"));
            run.out.push(format!("seed_{seed}"));
            jobs.extend(run.list_jobs(command.clone())?);
            inputs.push(run.below_out("run.json")?);
        }
        let scenes = self.scenes.iter();
        let bounds = scenes.map(|scene| self.below_out(&format!("{}.bounds.toml", scene.id)));
        jobs.push(Job {
            arguments: [command, words_behind()?].concat(),
            inputs,
            outputs: bounds.collect::<Result<_, _>>()?,
            ..Job::last_of(&jobs, "calibrate")
        });
        Ok(jobs)
    }

    /// Lists the truths of every scene, references and filters, and the merge, which records this command line as `command`'s.
    fn list_jobs(&self, command: Vec<String>) -> Result<Vec<Job>, Error> {
        let mut jobs = Vec::new();
        let mut parts = Vec::new();
        for (scene, costs) in self.scenes.iter().zip(estimate_jobs(self.plan)) {
            let mut inputs = scene.files.clone();
            if let Some(cost) = costs.render.filter(|_| self.plan.truths.is_none()) {
                let truths = self.truth_job(scene, cost)?;
                inputs.extend(truths.outputs.clone());
                jobs.push(truths);
            }
            let references = costs.cases(costs.references);
            let mut of_scene = vec![self.case_job(scene, None, references)?];
            for filter in &self.filters {
                let cost = costs.cases(filter.presets * costs.inputs);
                of_scene.push(self.case_job(scene, Some(filter), cost)?);
            }
            for mut job in of_scene {
                job.inputs.splice(0..0, inputs.clone());
                parts.extend(job.outputs.clone());
                jobs.push(job);
            }
        }
        let mut merge = Job::last_of(&jobs, &self.name("merge"));
        merge.arguments = words(["truths", "merge", "--quiet"]);
        for part in &parts {
            let folder = Path::new(part).parent().expect("run.json is in a folder");
            merge.arguments.push(path_word(folder)?);
        }
        let program = std::env::args().next();
        let program = program.unwrap_or_else(|| "shuttertruth".to_owned());
        (merge.arguments).extend(words(["--out", &path_word(&self.out)?, "--", &program]));
        (merge.arguments).extend([command, words_behind()?].concat());
        merge.inputs = parts;
        merge.outputs = vec![self.below_out("run.json")?];
        jobs.push(merge);
        Ok(jobs)
    }

    fn truth_job(&self, scene: &SceneWords, cost: JobCost) -> Result<Job, Error> {
        let mut job = Job::new(&self.name(&format!("truths/{}", scene.id)), cost);
        let alignments = self.plan.alignments();
        let names: Vec<&str> = alignments.into_iter().map(Alignment::name).collect();
        let alignments = names.join(",");
        job.arguments = words(["truths", "render", "--quiet", "--ladders"]);
        (job.arguments).extend(words(["--alignments", &alignments]));
        self.push_own::<RenderArgs>(&mut job, scene, &self.truths())?;
        job.inputs = scene.files.clone();
        for frame in 0..self.plan.frames.count {
            let folder = self.truths().join(scene.id.at_frame(frame).folder());
            // A render writes a truth's ladder last.
            let truths = names.iter().flat_map(|name| {
                [
                    format!("truth_{name}.exr"),
                    format!("ladder_{name}/n64.exr"),
                ]
            });
            for file in std::iter::once("frame.exr".to_owned()).chain(truths) {
                job.outputs.push(path_word(&folder.join(file))?);
            }
        }
        Ok(job)
    }

    /// Makes the job that measures one filter, or all references if none is given.
    fn case_job(
        &self,
        scene: &SceneWords,
        filter: Option<&FilterWords>,
        cost: JobCost,
    ) -> Result<Job, Error> {
        let (part, own, filters) = match filter {
            Some(filter) => (
                "filters",
                format!("/{}", filter.name),
                std::slice::from_ref(filter),
            ),
            None => ("references", String::new(), &self.filters[..]),
        };
        let name = format!("{part}/{}{own}", scene.id);
        let folder = self.parts.join(&name);
        let mut job = Job::new(&self.name(&name), cost);
        let common = self.plan.common_alignment().name();
        job.arguments = words(["run", "--quiet", "--part", part, "--common", common]);
        for filter in filters {
            job.arguments.extend_from_slice(&filter.options);
            job.inputs.extend_from_slice(&filter.files);
        }
        // A scene that an engine drew includes its truth.
        if scene.is_rendered {
            let truths = path_word(&self.truths())?;
            job.arguments.extend(words(["--truths", &truths]));
            (job.inputs).extend(self.truths().is_file().then_some(truths));
        }
        if self.seed.is_some() {
            (job.arguments).extend(words(["--intervals", "--jitter-frames", "0"]));
        }
        self.push_own::<RunArgs>(&mut job, scene, &folder)?;
        job.outputs = vec![path_word(&folder.join("run.json"))?];
        Ok(job)
    }

    /// Names a file in the folder of the whole run.
    fn below_out(&self, file: &str) -> Result<String, Error> {
        path_word(&self.out.join(file))
    }

    /// Finds the folder of the truths.
    fn truths(&self) -> PathBuf {
        let kept = self.plan.truths.clone();
        kept.unwrap_or_else(|| self.parts.join("truths"))
    }

    /// Names a job.
    fn name(&self, job: &str) -> String {
        let seed = self.seed.map(|seed| format!("seed_{seed}/"));
        seed.unwrap_or_default() + job
    }

    /// Adds the words that all jobs of a scene share, and this command line's options.
    fn push_own<A: Args>(
        &self,
        job: &mut Job,
        scene: &SceneWords,
        out: &Path,
    ) -> Result<(), Error> {
        let size = format!("{}x{}", self.plan.render.width, self.plan.render.height);
        let out = path_word(out)?;
        (job.arguments).extend(words([
            "--scenes",
            &scene.word,
            "--size",
            &size,
            "--out",
            &out,
        ]));
        if let Some(seed) = self.seed {
            job.arguments.extend(words(["--seed", &seed.to_string()]));
        }
        push_given::<A>(&mut job.arguments, self.given)
    }
}
