//! Counts how many intervals contain the score that infinitely many samples would give, over many
//! seeds, and prints the table of `results/studies/intervals.md`. `cargo run -p shuttertruth --example
//! intervals -- 48 64 4096 railing,flag,fan,two_spheres`

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use filters::{Filter, Gpu};
use measure::{Error, FilterChoice, Monitor, RunPlan, measure_scenes, open_gpu};
use metrics::{Ideal, Interval, Metric};
use scene::load_scene;
use tracer::RenderSettings;

/// One filter per shutter: trailing and centred.
const FILTERS: [(&str, &str); 2] = [("jump_flood", "paper"), ("mcguire", "paper")];
const SIZE: [u32; 2] = [160, 90];
/// Folder of all renders: an interrupted study continues.
const FOLDER: &str = "target/tmp/intervals";
/// Replicates of all truths, and the seed of the converged one.
const REPLICATES: u32 = 8;
const CONVERGED_SEED: u64 = 1_000_000;
/// Limits at these multiples of the converged score: one is broken, one kept.
const LIMITS: [f64; 2] = [0.95, 1.05];

/// What the study asks for.
struct Study {
    seeds: u64,
    samples: u32,
    converged: u32,
    scenes: Vec<String>,
}

/// The scores of one filter on one scene.
struct Subject {
    name: String,
    /// Score without noise, and the measured score with its interval per seed.
    scores: BTreeMap<Metric, (f64, Vec<(f64, Interval)>)>,
}

/// The coverage of one score's intervals.
struct Coverage {
    metric: Metric,
    /// Share of the intervals that contain the converged score.
    held: f64,
    /// Factor by which the half widths are larger than 95 % coverage needs.
    wide: f64,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let Some(study) = parse(&words) else {
        eprintln!(
            "give seeds, samples per pixel, those of the converged truth, and scenes: 48 64 4096 railing,flag,fan,two_spheres"
        );
        return ExitCode::from(2);
    };
    match measure(&study) {
        Ok(subjects) => {
            print_study(&study, &subjects);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn parse(words: &[String]) -> Option<Study> {
    let [seeds, samples, converged, scenes] = words else {
        return None;
    };
    Some(Study {
        seeds: seeds.parse().ok()?,
        samples: samples.parse().ok()?,
        converged: converged.parse().ok()?,
        scenes: scenes.split(',').map(str::to_owned).collect(),
    })
}

fn measure(study: &Study) -> Result<Vec<Subject>, Error> {
    let choices = FILTERS.map(|(filter, preset)| {
        let filter = Filter::load(&Path::new("shaders").join(filter))?;
        FilterChoice::new(filter, preset)
    });
    let choices = choices.into_iter().collect::<Result<Vec<_>, _>>()?;
    let gpu = open_gpu(&choices, None, Monitor::SILENT)?;
    let mut subjects = Vec::new();
    for scene in &study.scenes {
        let run = |samples, seed| run(scene, &choices, (samples, seed), gpu.as_ref());
        let converged = run(study.converged, CONVERGED_SEED)?;
        let mut scene_subjects: Vec<Subject> =
            (converged.cases.iter().filter(|case| !case.is_reference))
                .map(|case| Subject {
                    name: format!("{scene}, {}", case.filter_id()),
                    scores: (Metric::all().into_iter())
                        .filter_map(|metric| Some((metric, (case.estimate(metric)?, Vec::new()))))
                        .collect(),
                })
                .collect();
        for seed in 1..=study.seeds {
            let measured = run(study.samples, seed)?;
            let cases = measured.cases.iter().filter(|case| !case.is_reference);
            for (subject, case) in scene_subjects.iter_mut().zip(cases) {
                for (metric, (_, seeds)) in &mut subject.scores {
                    let score = case.scores.get(*metric).value();
                    seeds.extend(score.zip(case.intervals.get(metric).copied()));
                }
            }
            eprintln!("{scene}: seed {seed} of {}", study.seeds);
        }
        subjects.extend(scene_subjects);
    }
    Ok(subjects)
}

/// Measures the filters on a scene as `check` does.
fn run(
    scene: &str,
    choices: &[FilterChoice],
    (samples_per_pixel, seed): (u32, u64),
    gpu: Option<&Gpu>,
) -> Result<measure::Run, Error> {
    let [width, height] = SIZE;
    let plan = RunPlan {
        scenes: vec![load_scene(Path::new("scenes").join(scene), None)?],
        filters: choices
            .iter()
            .map(|choice| choice.scaled_to(width))
            .collect(),
        render: RenderSettings {
            width,
            height,
            samples_per_pixel,
            replicates: REPLICATES,
            seed,
            ..RenderSettings::default()
        },
        out: PathBuf::from(FOLDER).join(format!("{samples_per_pixel}_{seed}")),
        intervals: true,
        ladders: false,
        ..RunPlan::default()
    };
    plan.check()?;
    measure_scenes(&plan, gpu, Vec::new())
}

/// Counts the intervals of every score that noise changes and all seeds have.
fn count_coverage(study: &Study, subject: &Subject) -> Vec<Coverage> {
    let all = subject.scores.iter();
    let changed = all.filter(|(_, (_, seeds))| {
        seeds.len() as u64 == study.seeds && seeds.iter().any(|(value, _)| *value != seeds[0].0)
    });
    changed
        .map(|(&metric, (converged, seeds))| {
            let holds = seeds
                .iter()
                .filter(|(_, interval)| interval.holds(*converged));
            Coverage {
                metric,
                held: holds.count() as f64 / seeds.len() as f64,
                wide: 1.0 / needed_width(*converged, seeds),
            }
        })
        .collect()
}

/// Returns the factor on all half widths with which 95 % of the intervals would just contain the
/// converged score.
fn needed_width(converged: f64, seeds: &[(f64, Interval)]) -> f64 {
    let factor = |interval: &Interval| {
        let middle = 0.5 * (interval.low + interval.high);
        (converged - middle).abs() / (0.5 * (interval.high - interval.low)).max(f64::MIN_POSITIVE)
    };
    let mut factors: Vec<f64> = seeds.iter().map(|(_, interval)| factor(interval)).collect();
    factors.sort_by(f64::total_cmp);
    let rank = (0.95 * factors.len() as f64).ceil() as usize;
    factors[rank - 1]
}

fn print_study(study: &Study, subjects: &[Subject]) {
    println!(
        "{} seeds, {} samples per pixel, converged: {}\n",
        study.seeds, study.samples, study.converged
    );
    println!(
        "| scene and filter | scores | 93 to 97 % | below 90 % | over 97 % | twice too wide |"
    );
    println!("|---|---|---|---|---|---|");
    let mut details = String::new();
    let mut all = [0; 5];
    for subject in subjects {
        let coverages = count_coverage(study, subject);
        let count = |is: &dyn Fn(&Coverage) -> bool| {
            coverages.iter().filter(|coverage| is(coverage)).count()
        };
        let counts = [
            coverages.len(),
            count(&|coverage| (0.93..=0.97).contains(&coverage.held)),
            count(&|coverage| coverage.held < 0.9),
            count(&|coverage| coverage.held > 0.97),
            count(&|coverage| coverage.wide > 2.0),
        ];
        print_row(&subject.name, counts);
        all = std::array::from_fn(|at| all[at] + counts[at]);
        let low = coverages.iter().filter(|coverage| coverage.held < 0.9);
        let low: Vec<String> = low
            .map(|coverage| format!("{} {:.0}", coverage.metric, 100.0 * coverage.held))
            .collect();
        details += &format!("- {}: {}\n", subject.name, list(&low));
    }
    print_row("all", all);
    println!("\nBelow 90 %, with the percentage that contain the converged score:\n\n{details}");
    print_limits(subjects);
}

fn print_row(name: &str, counts: [usize; 5]) {
    let cells = counts.map(|count| count.to_string());
    println!("| {name} | {} |", cells.join(" | "));
}

fn list(words: &[String]) -> String {
    match words {
        [] => "none".to_owned(),
        _ => words.join(", "),
    }
}

/// Prints how limits near the converged FLIP are judged: the first should break, the second be
/// kept, and none break at its own value.
fn print_limits(subjects: &[Subject]) {
    let metric: Metric = "flip_moving".parse().expect("it is a metric");
    let all: Vec<(f64, Interval)> = (subjects.iter())
        .filter_map(|subject| subject.scores.get(&metric))
        .flat_map(|(converged, seeds)| {
            seeds
                .iter()
                .map(move |(_, interval)| (*converged, *interval))
        })
        .collect();
    assert_eq!(metric.ideal(), Ideal::Lowest, "limits are highest scores");
    let share = |is: &dyn Fn(&(f64, Interval)) -> bool| {
        100.0 * all.iter().filter(|pair| is(pair)).count() as f64 / all.len() as f64
    };
    let [low, high] = LIMITS;
    println!("| limit on `flip_moving` | verdict | share |");
    println!("|---|---|---|");
    let row = |limit: &str, verdict: &str, share: f64| {
        println!("| {limit} | {verdict} | {share:.1} % |");
    };
    let [lower, higher] = LIMITS.map(|limit| format!("{limit} times the converged score"));
    let breaks = |pair: &(f64, Interval), limit: f64| pair.1.low > limit * pair.0;
    row(&lower, "breaks", share(&|pair| breaks(pair, low)));
    let keeps = |(converged, interval): &(f64, Interval)| interval.high < high * converged;
    row(&higher, "is kept", share(&keeps));
    row(
        "the converged score",
        "breaks",
        share(&|pair| breaks(pair, 1.0)),
    );
}
