//! Jobs of a run or a calibration: truths, references, filters, the merge, and the report.

use std::path::{Path, PathBuf};

use clap::ArgMatches;
use frame::Alignment;
use serde::Serialize;
use suite::{Error, JobCost, RunPlan, estimate_jobs, estimate_report};

use super::arguments::PlanArgs;
use super::words::{
    FilterWords, SceneWords, list_filter_words, list_scene_words, path_word, push_given, words,
    words_behind,
};
use crate::commands::render::RenderArgs;
use crate::commands::run::RunArgs;

/// A process of this program: a line of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Job {
    /// Name, which no other job has.
    pub job: String,
    /// Words behind the program's name.
    pub arguments: Vec<String>,
    /// Files that must be there before it starts.
    pub inputs: Vec<String>,
    /// Files that are there once it has ended.
    pub outputs: Vec<String>,
    /// Expected time on one core, in seconds.
    pub cpu_seconds: f64,
    /// Expected memory at the most, in bytes.
    pub memory: u64,
}

impl Job {
    /// Makes a job of its cost, without words and files.
    fn new(job: String, cost: JobCost) -> Self {
        Self {
            job,
            arguments: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            // Estimates are not known to more.
            cpu_seconds: (cost.cpu_seconds * 10.0).ceil() / 10.0,
            memory: cost.memory,
        }
    }

    /// Makes a job that reads what all others made, in no time.
    fn last_of(jobs: &[Self], job: String) -> Self {
        let cost = JobCost {
            cpu_seconds: 1.0,
            memory: jobs.iter().map(|job| job.memory).max().unwrap_or(0),
        };
        Self::new(job, cost)
    }
}

/// Lists all jobs; each stands behind those whose outputs it needs.
pub fn list_jobs(args: &PlanArgs, given: &ArgMatches, plan: &RunPlan) -> Result<Vec<Job>, Error> {
    let planner = Planner {
        args,
        given,
        plan,
        scenes: list_scene_words(args, plan)?,
        filters: list_filter_words(args, plan)?,
    };
    match args.runs {
        None => planner.jobs_of_run(),
        Some(runs) => planner.jobs_of_calibration(runs),
    }
}

/// What the jobs of all runs share.
struct Planner<'a> {
    args: &'a PlanArgs,
    given: &'a ArgMatches,
    plan: &'a RunPlan,
    scenes: Vec<SceneWords>,
    filters: Vec<FilterWords>,
}

/// Folders of one run: the only one, or that of a seed.
struct Folders {
    seed: Option<u64>,
    parts: PathBuf,
    truths: PathBuf,
    out: PathBuf,
}

impl Folders {
    /// Names a job.
    fn name(&self, job: &str) -> String {
        let seed = self.seed.map(|seed| format!("seed_{seed}/"));
        seed.unwrap_or_default() + job
    }

    fn run(&self) -> Result<String, Error> {
        path_word(&self.out.join("run.json"))
    }
}

impl Planner<'_> {
    fn jobs_of_run(&self) -> Result<Vec<Job>, Error> {
        let run = self.folders(None);
        let mut jobs = self.jobs_of_parts(&run, words(["run"]))?;
        let cases: usize = self.filters.iter().map(|filter| filter.words.len()).sum();
        let cost = estimate_report(self.plan, cases * self.scenes.len());
        jobs.push(Job {
            arguments: words(["report", "--quiet", &run.run()?]),
            inputs: vec![run.run()?],
            outputs: vec![path_word(&run.out.join("report.html"))?],
            ..Job::new("report".to_owned(), cost)
        });
        Ok(jobs)
    }

    /// One run per seed, and the command itself, which reads all of them back.
    fn jobs_of_calibration(&self, runs: u32) -> Result<Vec<Job>, Error> {
        let command = words(["limits", "calibrate"]);
        let (mut jobs, mut inputs) = (Vec::new(), Vec::new());
        let first = self.plan.render.seed;
        for seed in (0..runs).map(|run| first.saturating_add(u64::from(run))) {
            let run = self.folders(Some(seed));
            jobs.extend(self.jobs_of_parts(&run, command.clone())?);
            inputs.push(run.run()?);
        }
        let bounds = self.scenes.iter().map(|scene| {
            let file = format!("{}.bounds.toml", scene.id);
            path_word(&self.plan.out.join(file))
        });
        let last = Job {
            arguments: [command, words_behind()?].concat(),
            inputs,
            outputs: bounds.collect::<Result<_, _>>()?,
            ..Job::last_of(&jobs, "calibrate".to_owned())
        };
        jobs.push(last);
        Ok(jobs)
    }

    fn folders(&self, seed: Option<u64>) -> Folders {
        let out = &self.plan.out;
        let own = |folder: PathBuf| match seed {
            Some(seed) => folder.join(format!("seed_{seed}")),
            None => folder,
        };
        let parts = own(self.args.parts.clone().unwrap_or_else(|| out.join("parts")));
        let truths = self.plan.truths.clone();
        Folders {
            seed,
            truths: truths.unwrap_or_else(|| parts.join("truths")),
            parts,
            out: own(out.clone()),
        }
    }

    /// Truths of every scene, references and filters, and the merge, which records this command line as one of `command`.
    fn jobs_of_parts(&self, run: &Folders, command: Vec<String>) -> Result<Vec<Job>, Error> {
        let mut jobs = Vec::new();
        let mut parts = Vec::new();
        for (scene, costs) in self.scenes.iter().zip(estimate_jobs(self.plan)) {
            let mut inputs = scene.files.clone();
            if let Some(cost) = costs.render.filter(|_| self.plan.truths.is_none()) {
                let truths = self.truth_job(run, scene, cost)?;
                inputs.extend(truths.outputs.clone());
                jobs.push(truths);
            }
            let references = costs.cases(costs.references);
            let mut of_scene = vec![self.case_job(run, scene, None, references)?];
            for filter in &self.filters {
                let cost = costs.cases(filter.words.len() * costs.inputs);
                of_scene.push(self.case_job(run, scene, Some(filter), cost)?);
            }
            for mut job in of_scene {
                job.inputs.splice(0..0, inputs.clone());
                parts.extend(job.outputs.clone());
                jobs.push(job);
            }
        }
        let mut merge = Job::last_of(&jobs, run.name("merge"));
        merge.arguments = words(["truths", "merge", "--quiet"]);
        for part in &parts {
            let folder = Path::new(part).parent().expect("run.json is in a folder");
            merge.arguments.push(path_word(folder)?);
        }
        let program = std::env::args().next();
        (merge.arguments).extend(words(["--out", &path_word(&run.out)?, "--"]));
        (merge.arguments).push(program.unwrap_or_else(|| "shuttertruth".to_owned()));
        (merge.arguments).extend([command, words_behind()?].concat());
        merge.inputs = parts;
        merge.outputs = vec![run.run()?];
        jobs.push(merge);
        Ok(jobs)
    }

    fn truth_job(&self, run: &Folders, scene: &SceneWords, cost: JobCost) -> Result<Job, Error> {
        let mut job = Job::new(run.name(&format!("truths/{}", scene.id)), cost);
        let alignments = self.plan.alignments();
        let names: Vec<&str> = alignments.into_iter().map(Alignment::name).collect();
        job.arguments = words([
            "truths",
            "render",
            "--quiet",
            "--ladders",
            "--alignments",
            &names.join(","),
        ]);
        self.push_own::<RenderArgs>(&mut job, run, scene, &run.truths)?;
        job.inputs = scene.files.clone();
        for frame in 0..self.plan.frames.count {
            let folder = run.truths.join(scene.id.at_frame(frame).folder());
            job.outputs.push(path_word(&folder.join("frame.exr"))?);
            for name in &names {
                // The last file that a render writes of a truth.
                let last = [
                    format!("truth_{name}.exr"),
                    format!("ladder_{name}/n64.exr"),
                ];
                for file in last {
                    job.outputs.push(path_word(&folder.join(file))?);
                }
            }
        }
        Ok(job)
    }

    /// Measures one filter, or the references of all where none is given.
    fn case_job(
        &self,
        run: &Folders,
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
        let folder = run.parts.join(&name);
        let mut job = Job::new(run.name(&name), cost);
        let common = self.plan.common_alignment().name();
        job.arguments = words(["run", "--quiet", "--part", part, "--common", common]);
        for filter in filters {
            let names = filter.words.iter().map(|word| ("--filter", word));
            let overrides = filter.overrides.iter().map(|set| ("--set", set));
            for (option, value) in names.chain(overrides) {
                job.arguments.extend(words([option, value]));
            }
            job.inputs.extend(filter.files.clone());
        }
        // What an engine drew has its truth beside it.
        if scene.is_rendered {
            let truths = path_word(&run.truths)?;
            job.arguments.extend(words(["--truths", &truths]));
            job.inputs.extend(run.truths.is_file().then_some(truths));
        }
        if run.seed.is_some() {
            (job.arguments).extend(words(["--intervals", "--jitter-frames", "0"]));
        }
        self.push_own::<RunArgs>(&mut job, run, scene, &folder)?;
        job.outputs = vec![path_word(&folder.join("run.json"))?];
        Ok(job)
    }

    /// Adds the words that all jobs of a scene have, and the options of this command line.
    fn push_own<A: clap::Args>(
        &self,
        job: &mut Job,
        run: &Folders,
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
        if let Some(seed) = run.seed {
            job.arguments.extend(words(["--seed", &seed.to_string()]));
        }
        push_given::<A>(&mut job.arguments, self.given)
    }
}
