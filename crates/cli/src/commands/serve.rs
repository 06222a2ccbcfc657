//! The command `tune serve`.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, Read};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use clap::Args;
use filters::{FilterError, Value};
use serde::Deserialize;
use serde_json::json;
use suite::Error;
use tracer::TraceError;
use tune::{Evaluation, Evaluator, Objective, SceneScore, evaluate_candidate};

use super::evaluate::change_settings;
use crate::arguments::CandidateArgs;
use crate::output::{print, was_interrupted};

/// Upper limit on the bytes of a line.
const LONGEST_LINE: usize = 1 << 20;
/// Upper limit on waiting requests; more are read later.
const MAX_WAITING: usize = 1024;
/// Upper limit on cancellations of requests that have not come yet.
const MAX_CANCELLED: usize = 65_536;
/// Characters of a line that an error shows.
const SHOWN: usize = 200;
/// Time between two checks for Ctrl-C while no line comes.
const PAUSE: Duration = Duration::from_millis(50);

#[derive(Debug, Args)]
pub struct ServeArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
}

/// One line of standard input.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, untagged)]
enum Request {
    Score(ScoreRequest),
    /// `{"cancel": 7}`
    Cancel {
        cancel: u64,
    },
}

/// A candidate to score: `{"id": 7, "params": {"samples": 12}, "scenes": ["fan"]}`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScoreRequest {
    /// Number that the answer repeats.
    id: u64,
    /// Parameters that differ from the preset.
    params: BTreeMap<String, Value>,
    /// Names of the scenes; none for all.
    #[serde(default)]
    scenes: Option<Vec<String>>,
}

/// Numbers of cancelled requests.
#[derive(Clone, Default)]
struct Cancelled(Arc<Mutex<BTreeSet<u64>>>);

impl Cancelled {
    fn lock(&self) -> MutexGuard<'_, BTreeSet<u64>> {
        self.0.lock().expect("nothing panics while it is locked")
    }
}

/// Answers requests until standard input ends and all are answered.
pub fn execute(args: &ServeArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = candidate.select()?;
    let [bleed, cost] =
        [Objective::Bleed, Objective::Cost].map(|own| candidate.objective.contains(&own));
    candidate.score(&choice, bleed, None, |evaluator| {
        let cancelled = Cancelled::default();
        let (sender, requests) = sync_channel(MAX_WAITING);
        let reader = cancelled.clone();
        std::thread::spawn(move || read_requests(std::io::stdin().lock(), &reader, &sender));
        let names = scene_names(evaluator);
        print_reply(&json!({"ready": true, "filter": choice.filter.name, "scenes": names}))?;
        loop {
            match requests.recv_timeout(PAUSE) {
                Ok(Ok(request)) => answer_request(evaluator, request, cost, &cancelled)?,
                Ok(Err(reason)) => print_reply(&json!({"error": reason}))?,
                Err(RecvTimeoutError::Timeout) if was_interrupted() => {
                    return Err(FilterError::Interrupted.into());
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
        }
    })
}

/// Reads lines while other work goes on: sends requests, reports malformed lines, and cancels requests at once.
fn read_requests(
    mut input: impl BufRead,
    cancelled: &Cancelled,
    sender: &SyncSender<Result<ScoreRequest, String>>,
) {
    let mut has_ended = false;
    while !has_ended {
        let request = match read_line(&mut input) {
            Ok(line) if line.is_empty() => return,
            Ok(line) if line.trim_ascii().is_empty() => continue,
            Ok(line) => parse_line(line.strip_suffix(b"\n").unwrap_or(&line)),
            Err(error) => {
                has_ended = true;
                Err(format!("standard input cannot be read: {error}"))
            }
        };
        let item = match request {
            Ok(Request::Score(request)) => Ok(request),
            Ok(Request::Cancel { cancel }) => {
                let mut cancelled = cancelled.lock();
                if cancelled.len() < MAX_CANCELLED {
                    cancelled.insert(cancel);
                    continue;
                }
                Err(format!(
                    "{{\"cancel\": {cancel}}}: {MAX_CANCELLED} requests that have not come are cancelled already, which is the most"
                ))
            }
            Err(reason) => Err(reason),
        };
        has_ended |= sender.send(item).is_err();
    }
}

/// Reads the next line, or its beginning if it is too long; returns nothing at the end of the input.
fn read_line(input: &mut impl BufRead) -> std::io::Result<Vec<u8>> {
    let mut line = Vec::new();
    let most = LONGEST_LINE as u64 + 1;
    input.by_ref().take(most).read_until(b'\n', &mut line)?;
    if line.len() > LONGEST_LINE && !line.ends_with(b"\n") {
        input.skip_until(b'\n')?;
    }
    Ok(line)
}

fn parse_line(line: &[u8]) -> Result<Request, String> {
    if line.len() > LONGEST_LINE {
        return Err(format!(
            "a line has more than {LONGEST_LINE} bytes, which is the most; it was left out"
        ));
    }
    let text = std::str::from_utf8(line).map_err(|error| {
        let byte = error.valid_up_to() + 1;
        format!("a line is not UTF-8 from its byte {byte} on; it was left out")
    })?;
    serde_json::from_str(text).map_err(|_| {
        let shown = match text.char_indices().nth(SHOWN) {
            None => text.to_owned(),
            Some((end, _)) => format!("{}..", &text[..end]),
        };
        format!(
            "{shown}: allowed are {{\"id\": 7, \"params\": {{\"samples\": 12}}, \"scenes\": [\"fan\"]}} and {{\"cancel\": 7}}, \
             each on a line of its own"
        )
    })
}

/// Scores one candidate scene by scene, and sums up. A request that cannot be answered gets an error and ends nothing.
fn answer_request(
    evaluator: &mut Evaluator,
    request: ScoreRequest,
    cost: bool,
    cancelled: &Cancelled,
) -> Result<(), Error> {
    let id = request.id;
    // The lock must not be held meanwhile.
    let is_cancelled = cancelled.lock().contains(&id);
    let found = match is_cancelled {
        true => Err(TraceError::Cancelled.into()),
        false => score_request(evaluator, request, cost, cancelled),
    };
    print_reply(&match found {
        Ok(answer) => json!({"id": id, "done": answer}),
        Err(_) if cancelled.lock().remove(&id) => json!({"id": id, "cancelled": true}),
        Err(error) if error.is_interruption() => return Err(error),
        Err(error) => json!({"id": id, "error": error.to_string()}),
    })
}

fn score_request(
    evaluator: &mut Evaluator,
    request: ScoreRequest,
    cost: bool,
    cancelled: &Cancelled,
) -> Result<Evaluation, Error> {
    let known = scene_names(evaluator);
    let scenes = scene_indices(&known, request.scenes)?;
    let settings = change_settings(&evaluator.choice, request.params)?;
    evaluate_candidate(evaluator, &settings, &scenes, cost, |scene, score| {
        report_scene(cancelled, request.id, &known[scene], score)
    })
}

/// Reports the scores of one scene; false if the request was cancelled or nobody reads.
fn report_scene(cancelled: &Cancelled, id: u64, scene: &str, score: &SceneScore) -> bool {
    let reply = json!({"id": id, "scene": scene, "flip": score.flip, "bleed": score.bleed});
    print_reply(&reply).is_ok() && !cancelled.lock().contains(&id)
}

fn print_reply(reply: &serde_json::Value) -> Result<(), Error> {
    print(&format!("{reply}\n"))
}

fn scene_names(evaluator: &Evaluator) -> Vec<String> {
    let targets = evaluator.targets.iter();
    targets.map(|target| target.scene.name.clone()).collect()
}

fn scene_indices(known: &[String], names: Option<Vec<String>>) -> Result<Vec<usize>, Error> {
    let Some(names) = names else {
        return Ok((0..known.len()).collect());
    };
    let mut indices = Vec::new();
    for name in &names {
        match known.iter().position(|it| it == name) {
            Some(index) if indices.contains(&index) => {
                refuse!("scenes: \"{name}\" is named twice; allowed: each once")
            }
            Some(index) => indices.push(index),
            None => refuse!(
                "scenes: \"{name}\" was not loaded; allowed: {}",
                known.join(", ")
            ),
        }
    }
    Ok(indices)
}

#[test]
fn a_request_under_way_ends_when_it_is_cancelled_and_no_other_does() {
    let cancelled = Cancelled::default();
    let (sender, _requests) = sync_channel(1);
    let score = SceneScore {
        flip: 0.1,
        bleed: None,
    };
    for (line, goes_on) in [
        ("\n", true),
        ("{\"cancel\": 8}", true),
        ("{\"cancel\": 7}", false),
    ] {
        read_requests(line.as_bytes(), &cancelled, &sender);
        assert_eq!(report_scene(&cancelled, 7, "fan", &score), goes_on);
    }
}

#[test]
fn a_line_of_the_allowed_length_is_read_and_the_last_one_needs_no_end() {
    let long = "x".repeat(LONGEST_LINE);
    let input = format!("{long}\n{long}y\nlast");
    let mut input = input.as_bytes();
    let lines = [(); 3].map(|()| read_line(&mut input).unwrap());
    assert!(read_line(&mut input).unwrap().is_empty());
    let is_too_long = lines.map(|line| {
        let found = parse_line(line.strip_suffix(b"\n").unwrap_or(&line));
        found.is_err_and(|reason| reason.contains("more than 1048576 bytes"))
    });
    assert_eq!(is_too_long, [false, true, false]);
}

#[test]
fn no_more_requests_are_cancelled_ahead_than_allowed() {
    let cancelled = Cancelled::default();
    cancelled.lock().extend(1..MAX_CANCELLED as u64);
    let (sender, requests) = sync_channel(2);
    let lines = "{\"cancel\": 70000}\n{\"cancel\": 70001}";
    read_requests(lines.as_bytes(), &cancelled, &sender);
    drop(sender);
    let refused: Vec<_> = requests.iter().filter_map(Result::err).collect();
    assert_eq!(refused.len(), 1);
    assert!(refused[0].contains("70001"), "{}", refused[0]);
}
