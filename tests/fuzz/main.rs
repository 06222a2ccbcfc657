//! Hostile and broken input for everything that the program reads: `docs/fuzzing.md`. Limits of
//! time and memory need Linux.

#![cfg(target_os = "linux")]

mod edit;
mod target;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use edit::{Edit, apply, edits};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, RngSeed, TestError, TestRunner};
use rayon::prelude::*;
use serde::Deserialize;
use target::{Program, Target};
use tempfile::TempDir;

/// Edited inputs of each target in each round of a longer run; the tests try one.
const CASES: u32 = 4;

/// Longest input that is edited.
const MAX_LENGTH: usize = 200_000;

const PROGRAM: &str = env!("CARGO_BIN_EXE_shuttertruth");

#[derive(Deserialize)]
struct Targets {
    /// Shell script that makes the fixture.
    setup: String,
    target: Vec<Target>,
}

static TARGETS: LazyLock<Targets> =
    LazyLock::new(|| toml::from_str(include_str!("targets.toml")).expect("targets are TOML"));

/// Makes the fixture.
fn make_fixture() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let programs = Path::new(PROGRAM).parent().unwrap().display();
    let path = format!("{programs}:{}", std::env::var("PATH").unwrap());
    let mut command = Command::new("sh");
    command.args(["-c", &TARGETS.setup]).current_dir(&folder);
    command.env("PATH", path).env("REPOSITORY", tests::root());
    let output = command.output().unwrap();
    assert!(output.status.success(), "{output:?}");
    folder
}

/// Runs edited inputs of a target. Keeps the smallest failing input, and describes it.
fn fuzz(target: &Target, program: &Program, cases: u32, seed: u64) -> Result<(), String> {
    let mut inputs = target.inputs(&program.fixture);
    inputs.retain(|input| input.len() <= MAX_LENGTH);
    let edited = |index: Index, edits: &[Edit]| apply(&inputs[index.index(inputs.len())], edits);
    let config = Config {
        cases,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        max_shrink_iters: 50,
        ..Config::default()
    };
    let mut runner = TestRunner::new(config);
    let result = runner.run(&(any::<Index>(), edits()), |(index, edits)| {
        let result = target.run(&edited(index, &edits), program);
        result.map(|_| ()).map_err(TestCaseError::fail)
    });
    match result {
        Err(TestError::Fail(failure, (index, edits))) => {
            Err(keep(target, &edited(index, &edits), failure.message()))
        }
        result => result.map_err(|error| error.to_string()),
    }
}

/// Writes a failing input below the build folder, and describes the failure.
fn keep(target: &Target, input: &[u8], failure: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    let hash = &blake3::hash(input).to_hex()[..8];
    let path = folder.join(format!("{}_{hash}", target.name));
    fs::create_dir_all(folder).unwrap();
    fs::write(&path, input).unwrap();
    format!("{}: {failure}\n  input: {}\n", target.name, path.display())
}

/// Runs the first inputs of a target without a change. The fixture's must be accepted: otherwise an
/// outdated layout would go unnoticed.
fn try_corpus(target: &Target, program: &Program, most: usize) -> Result<(), String> {
    let has_original = program.fixture.join(&target.file).exists();
    let inputs = target.inputs(&program.fixture);
    for (at, input) in inputs.iter().take(most).enumerate() {
        let is_accepted = target
            .run(input, program)
            .map_err(|failure| keep(target, input, &failure))?;
        if at == 0 && has_original && !is_accepted {
            return Err(keep(target, input, "the fixture's file is refused"));
        }
    }
    Ok(())
}

fn variable(name: &str, default: &str) -> String {
    std::env::var(name).unwrap_or_else(|_| default.to_owned())
}

#[test]
fn hostile_input_ends_in_a_documented_way() {
    let fixture = make_fixture();
    let program = Program {
        path: PROGRAM.into(),
        fixture: fixture.path().to_owned(),
    };
    let names = variable("TARGETS", "");
    let is_chosen =
        |target: &&Target| names.is_empty() || names.split(',').any(|name| name == target.name);
    let chosen: Vec<&Target> = TARGETS.target.iter().filter(is_chosen).collect();
    let is_known = names.is_empty() || chosen.len() == names.split(',').count();
    assert!(is_known, "one of these is no target: {names}");
    let minutes: u64 = variable("MINUTES", "0").parse().unwrap();
    let seed: u64 = variable("SEED", "1").parse().unwrap();
    let began = Instant::now();
    // Of targets that share a corpus, the tests try all its inputs on the first.
    let is_short = minutes == 0 && names.is_empty();
    let is_first = |target: &Target| {
        let mut sharing =
            (TARGETS.target.iter()).filter(|other| other.corpus_name() == target.corpus_name());
        sharing
            .next()
            .is_some_and(|first| first.name == target.name)
    };
    let most = |target: &Target| {
        if is_short && !is_first(target) {
            1
        } else {
            usize::MAX
        }
    };
    let cases = if is_short { 1 } else { CASES };
    let mut failures: Vec<String> = (chosen.par_iter())
        .filter_map(|target| try_corpus(target, &program, most(target)).err())
        .collect();
    for round in 0.. {
        let fuzzed = chosen
            .par_iter()
            .filter_map(|target| fuzz(target, &program, cases, seed + round).err());
        failures.extend(fuzzed.collect::<Vec<_>>());
        if !failures.is_empty() || began.elapsed() >= Duration::from_secs(60 * minutes) {
            break;
        }
    }
    assert!(failures.is_empty(), "{}", failures.concat());
}

#[test]
fn the_fuzzer_notices_each_kind_of_failure() {
    let fixture = tempfile::tempdir().unwrap();
    fs::write(fixture.path().join("input"), "sound words").unwrap();
    let program = Program {
        path: "sh".into(),
        fixture: fixture.path().to_owned(),
    };
    let target = |script: &str| Target {
        name: "planted".to_owned(),
        corpus: None,
        file: "input".to_owned(),
        commands: vec![format!("-c '{script}'")],
        time_limit: Some(1),
    };
    for (script, failure) in [
        ("echo panicked; exit 101", "exit code 101: panicked"),
        ("kill -SEGV $$", "exit code 139"),
        ("exec sleep 5", "exit code 137"),
        ("cat ../canary.txt", "a file outside was read"),
        ("rm ../canary.txt", "a file outside was changed"),
        ("echo > ../../new", "a file outside was changed"),
    ] {
        let noticed = target(script).run(b"", &program).unwrap_err();
        assert!(noticed.contains(failure), "{script}: {noticed}");
    }
    let reading = target("grep nan input && exit 7; exit 2");
    assert!(
        fuzz(&reading, &program, 500, 1)
            .unwrap_err()
            .contains("exit code 7")
    );
    assert_eq!(fuzz(&target("exit 2"), &program, 5, 1), Ok(()));
}
