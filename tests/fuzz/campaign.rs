//! Batches of cases in worker processes, on all cores.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use rayon::iter::{ParallelBridge, ParallelIterator};

use crate::options::Options;
use crate::place::Place;
use crate::seeds::Seeds;
use crate::target::{SHARES, Target};
use crate::worker_process::{Ended, PANICKED, try_cases};
use crate::{fixture, self_test};

/// Longest time of a case.
const LIMIT: Duration = Duration::from_secs(60);

/// Failures after which a target is skipped: the same cases would fail again.
const MAX_FAILURES: u64 = 40;

/// Cases of one target.
pub type Batch = (&'static Target, Range<u64>);

/// Result of one target.
#[derive(Default)]
pub struct Tally {
    /// Number of tried cases.
    pub cases: u64,
    failed: u64,
    /// Time of all its workers.
    time: Duration,
    /// Time and number of the slowest case that ended.
    slowest: (Duration, u64),
    /// The first failure of each kind.
    pub failures: BTreeMap<String, Failure>,
}

/// First input that failed in one way.
pub struct Failure {
    /// Description: a panic with its place, the last words of the process, or its time.
    pub how: String,
    case: u64,
    /// Number of inputs that failed the same way.
    count: u64,
}

/// Settings, and their results.
pub struct Campaign {
    options: Options,
    /// Longest time of a case.
    limit: Duration,
    /// Results by target.
    pub found: Mutex<BTreeMap<&'static str, Tally>>,
}

/// Tests the fuzzer itself; then fuzzes, and prints the result.
pub fn execute(mut options: Options) -> ExitCode {
    self_test::check();
    let fixture = fixture::make();
    options.fixture = fixture.path().to_owned();
    let began = Instant::now();
    println!("fuzz: seed {}", options.seed);
    let campaign = Campaign::new(options, LIMIT);
    let Options { cases, minutes, .. } = campaign.options;
    let is_over = || minutes.is_some_and(|limit| began.elapsed().as_secs_f64() > 60.0 * limit);
    let rounds = minutes.map_or(1, |_| u64::MAX);
    let batches = (0..rounds).flat_map(|round| campaign.list_batches(cases, round));
    campaign.run(batches.take_while(|_| !is_over()));
    campaign.print(began.elapsed())
}

impl Campaign {
    /// Starts without results.
    pub fn new(options: Options, limit: Duration) -> Self {
        Self {
            options,
            limit,
            found: Mutex::default(),
        }
    }

    /// Lists the cases of a round: in the first round the unchanged seeds, in each changed ones by the targets' shares.
    fn list_batches(&self, cases: u64, round: u64) -> Vec<Batch> {
        let mut batches = Vec::new();
        for target in self.options.chosen() {
            let place = Place::new(target.name, &self.options.fixture);
            let seeds = Seeds::read(target, &self.options, &place).count();
            let part = match &self.options.input {
                Some(_) => 0,
                None => (target.share * cases).div_ceil(SHARES),
            };
            let first = if round == 0 { 0 } else { seeds + round * part };
            let end = seeds + (round + 1) * part;
            let starts = (first..end).step_by(target.batch() as usize);
            batches.extend(starts.map(|start| (target, start..end.min(start + target.batch()))));
        }
        batches
    }

    /// Tries batches on all cores.
    pub fn run(&self, batches: impl Iterator<Item = Batch> + Send) {
        (batches.par_bridge()).for_each(|(target, cases)| self.try_batch(target, cases));
    }

    /// Tries a batch. Every failed case ends a process, and a new one continues after it.
    fn try_batch(&self, target: &'static Target, mut cases: Range<u64>) {
        let is_hopeless = || {
            let found = self.found.lock().unwrap();
            (found.get(target.name)).is_some_and(|tally| tally.failed >= MAX_FAILURES)
        };
        while !cases.is_empty() && !is_hopeless() {
            let began = Instant::now();
            let Ended { failed, slowest } = try_cases(target, &cases, &self.options, self.limit);
            let next = failed.as_ref().map_or(cases.end, |(case, _)| case + 1);
            let mut found = self.found.lock().unwrap();
            let tally = found.entry(target.name).or_default();
            tally.cases += next - cases.start;
            tally.time += began.elapsed();
            tally.slowest = tally.slowest.max(slowest);
            if let Some((case, how)) = failed {
                tally.failed += 1;
                let kind = tally.failures.entry(kind(&how));
                let failure = kind.or_insert_with(|| self.keep(target, case, how));
                failure.count += 1;
            }
            cases.start = next;
        }
    }

    /// Keeps the input of a failure below the build folder, under the hash of its bytes, and prints how to try it again.
    fn keep(&self, target: &'static Target, case: u64, how: String) -> Failure {
        let place = Place::new(target.name, &self.options.fixture);
        let input = Seeds::read(target, &self.options, &place).make(&place, case);
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join("fuzz")
            .join(target.name);
        let path = folder.join(&blake3::hash(&input).to_hex()[..16]);
        fs::create_dir_all(folder).expect("the build folder can be written");
        fs::write(&path, input).expect("the build folder can be written");
        let path = path.display();
        let words = format!("--targets {} --input {path}", target.name);
        let again = format!("cargo test --workspace --locked --test fuzz -- {words}");
        let how = format!("{how}\n  input: {path}\n  again: {again}");
        eprintln!("fuzz: {}: {how}", target.name);
        Failure {
            how,
            case,
            count: 0,
        }
    }

    /// Prints a line for each target, and a paragraph for each kind of failure.
    fn print(&self, time: Duration) -> ExitCode {
        let found = self.found.lock().unwrap();
        println!("target           cases  seconds  failed  slowest case");
        for (name, tally) in found.iter() {
            let Tally { cases, failed, .. } = tally;
            let (seconds, (slowest, case)) = (tally.time.as_secs_f64(), tally.slowest);
            println!(
                "{name:<14} {cases:>7} {seconds:>8.1} {failed:>7}  {slowest:.2?}, case {case}"
            );
        }
        let (mut cases, mut kinds) = (0, 0);
        for (name, tally) in found.iter() {
            cases += tally.cases;
            kinds += tally.failures.len();
            for Failure { how, case, count } in tally.failures.values() {
                let seed = self.options.seed;
                println!(
                    "fuzz: {name}: {count} inputs; the first is case {case} of seed {seed}: {how}"
                );
            }
        }
        let seconds = time.as_secs_f64();
        println!("fuzz: {cases} cases in {seconds:.1} s, {kinds} kinds of failure");
        ExitCode::from(u8::from(kinds > 0))
    }
}

/// Returns a text that is equal for failures of one kind: the place of a panic, or the words without their numbers.
fn kind(how: &str) -> String {
    match how.starts_with(PANICKED) {
        true => how.split(": ").next().unwrap_or_default().to_owned(),
        false => how.chars().filter(|c| !c.is_ascii_digit()).collect(),
    }
}
