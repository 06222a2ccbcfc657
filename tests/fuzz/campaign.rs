//! Batches of cases in worker processes, on all cores.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use crate::batch::{Ended, Failed, Terms, try_cases, try_file};
use crate::failure::{Failure, How, save};
use crate::fixture::Fixture;
use crate::options::{CASES, Input, RunPlan};
use crate::place::Place;
use crate::seeds::read_seeds;
use crate::self_test;
use crate::target::Target;

/// Longest time of a case.
const LIMIT: Duration = Duration::from_secs(60);

/// Failures after which a target is left alone: the same cases would fail again.
const MOST_FAILURES: u64 = 40;

/// Rounds of a campaign by time. Every target adds a part of its share to each.
const PARTS: u64 = 10;

/// Result of one target.
#[derive(Default)]
pub struct Tally {
    /// Number of tried cases.
    pub cases: u64,
    /// Number of failed cases.
    pub failed: u64,
    /// Time of all its workers.
    pub time: Duration,
    /// Time and number of the slowest case that ended.
    pub slowest: (Duration, u64),
}

/// Result of a campaign.
#[derive(Default)]
pub struct Found {
    /// Failures by target and [kind](How::kind).
    pub failures: BTreeMap<(&'static str, String), Failure>,
    /// Results by target.
    pub tallies: BTreeMap<&'static str, Tally>,
}

/// Cases of one target.
pub type Batch = (&'static Target, Range<u64>);

/// Tests the fuzzer itself; then fuzzes, and prints the result.
pub fn execute(plan: &RunPlan) -> ExitCode {
    self_test::check();
    let fixture = Fixture::make();
    let terms = Terms {
        fixture: fixture.path(),
        seed: plan.seed,
        limit: LIMIT,
    };
    let began = Instant::now();
    println!("fuzz: seed {}", plan.seed);
    let found = match plan.time {
        None => run(&terms, once(plan, fixture.path()).into_iter(), None),
        Some(time) => {
            let rounds = (0..).flat_map(|round| part(plan, fixture.path(), round));
            run(&terms, rounds, Some(began + time))
        }
    };
    print!("{}", table(&found));
    for failure in found.failures.values() {
        print!("{}", failure.text(plan.seed));
    }
    let cases: u64 = found.tallies.values().map(|tally| tally.cases).sum();
    let seconds = began.elapsed().as_secs_f64();
    println!(
        "fuzz: {cases} cases in {seconds:.1} s, {} kinds of failure",
        found.failures.len()
    );
    match found.failures.is_empty() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}

/// Tries one input, and prints the result.
pub fn try_one(asked: &Input) -> ExitCode {
    let fixture = Fixture::make();
    let terms = Terms {
        fixture: fixture.path(),
        seed: 0,
        limit: LIMIT,
    };
    let path = asked.path.canonicalize().unwrap_or(asked.path.clone());
    match try_file(asked.target, &path, &terms).failed {
        None => {
            println!("fuzz: {}: it came back", asked.target.name);
            ExitCode::SUCCESS
        }
        Some(Failed { how, .. }) => {
            println!("fuzz: {}: {how}", asked.target.name);
            ExitCode::FAILURE
        }
    }
}

/// Tries batches on all cores until none is left or the time is over.
pub fn run(
    terms: &Terms,
    batches: impl Iterator<Item = Batch> + Send,
    until: Option<Instant>,
) -> Found {
    let batches = Mutex::new(batches);
    let found = Mutex::new(Found::default());
    let next = || match until.is_some_and(|until| Instant::now() >= until) {
        true => None,
        false => batches.lock().unwrap().next(),
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                while let Some((target, cases)) = next() {
                    try_batch(terms, target, cases, &found);
                }
            });
        }
    });
    found.into_inner().unwrap()
}

/// Tries a batch. Every failed case ends a process, and a new one goes on after it.
fn try_batch(terms: &Terms, target: &'static Target, mut cases: Range<u64>, found: &Mutex<Found>) {
    while !cases.is_empty() {
        let failed = |found: &Found| found.tallies.get(target.name).map_or(0, |it| it.failed);
        if failed(&found.lock().unwrap()) >= MOST_FAILURES {
            return;
        }
        let began = Instant::now();
        let Ended { failed, slowest } = try_cases(target, cases.clone(), terms);
        let next = failed.as_ref().map_or(cases.end, |failed| failed.case + 1);
        let mut found = found.lock().unwrap();
        let tally = found.tallies.entry(target.name).or_default();
        tally.cases += next - cases.start;
        tally.time += began.elapsed();
        tally.slowest = tally.slowest.max(slowest);
        if let Some(failed) = failed {
            tally.failed += 1;
            found.add(target, failed);
        }
        cases.start = next;
    }
}

impl Found {
    /// Counts a failure, and keeps the input of the first of its kind.
    fn add(&mut self, target: &'static Target, Failed { case, how, input }: Failed) {
        let key = (target.name, how.kind());
        if let Some(known) = self.failures.get_mut(&key) {
            known.count += 1;
            return;
        }
        eprintln!("fuzz: {}: {how}", target.name);
        let failure = Failure {
            path: save(target, &input),
            target,
            how,
            case,
            count: 1,
        };
        self.failures.insert(key, failure);
    }

    /// Returns how each failure of a target happened.
    pub fn hows(&self, target: &str) -> Vec<&How> {
        let own = self.failures.values();
        own.filter(|failure| failure.target.name == target)
            .map(|failure| &failure.how)
            .collect()
    }
}

/// Returns every seed, and changed ones according to each target's share; slow targets come first.
fn once(plan: &RunPlan, fixture: &Path) -> Vec<Batch> {
    let mut targets = plan.targets.clone();
    targets.sort_by_key(|target| target.batch);
    let count = |target: &Target| {
        let share = (target.share * plan.cases).div_ceil(CASES);
        share.max(seed_count(target, fixture))
    };
    let batches = targets
        .into_iter()
        .flat_map(|target| cut(target, 0..count(target)));
    batches.collect()
}

/// Returns the next part of every target's cases.
fn part(plan: &RunPlan, fixture: &Path, round: u64) -> Vec<Batch> {
    let batches = plan.targets.iter().flat_map(|target| {
        let seeds = seed_count(target, fixture);
        let part = target.share.div_ceil(PARTS);
        let first = match round {
            0 => 0,
            _ => seeds + round * part,
        };
        cut(target, first..seeds + (round + 1) * part)
    });
    batches.collect()
}

fn seed_count(target: &Target, fixture: &Path) -> u64 {
    read_seeds(target, &Place::new(fixture)).len() as u64
}

fn cut(target: &'static Target, cases: Range<u64>) -> Vec<Batch> {
    let end = cases.end;
    let starts = cases.step_by(target.batch as usize);
    starts
        .map(|start| (target, start..(start + target.batch).min(end)))
        .collect()
}

fn table(found: &Found) -> String {
    let mut text = format!(
        "{:<14} {:>7} {:>8} {:>7}  slowest case\n",
        "target", "cases", "seconds", "failed"
    );
    for (name, tally) in &found.tallies {
        let (slowest, case) = tally.slowest;
        text += &format!(
            "{name:<14} {:>7} {:>8.1} {:>7}  {:.2} s, case {case}\n",
            tally.cases,
            tally.time.as_secs_f64(),
            tally.failed,
            slowest.as_secs_f64(),
        );
    }
    text
}
