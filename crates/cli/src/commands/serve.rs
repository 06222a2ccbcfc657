//! `shuttertruth serve`

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

use crate::output::progress::{interrupted, monitor};
use filters::Value;
use serde::Deserialize;
use serde_json::json;
use suite::{Error, Evaluator, Objective, SceneScore, Sharing, evaluate_candidate};

use super::evaluate::changed;
use super::lines::{Line, lines};
use super::measure::scenes;
use super::say;
use super::tune::{claim_and_render, open, select_candidate};
use crate::arguments::ServeArgs;

/// Requests that wait for their turn; what comes on top of them is read later.
const MOST_WAITING: usize = 1024;

/// Cancelled requests that have not come yet.
const MOST_CANCELLED: usize = 65_536;

/// Characters of a line that an error shows.
const SHOWN: usize = 200;

/// Between two looks for Ctrl-C while nothing comes.
const PAUSE: Duration = Duration::from_millis(50);

/// One line of standard input.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, untagged)]
enum Request {
    /// `{"id": 7, "params": {"samples": 12}, "scenes": ["fan"]}`; no `scenes` are all.
    Score {
        id: u64,
        params: BTreeMap<String, Value>,
        #[serde(default)]
        scenes: Option<Vec<String>>,
    },
    /// `{"cancel": 7}`
    Cancel { cancel: u64 },
}

/// Answers until standard input ends and all is answered.
pub fn execute(args: &ServeArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    let scenes = scenes(&candidate.scenes.scenes_dir, &candidate.scenes.scenes)?;
    let gpu = open(&choice, candidate)?;
    // The folder is free again as soon as all is read.
    let (_, rendered) = claim_and_render(&scenes, &choice, candidate, Sharing::Together)?;
    let bleed = candidate.objective.contains(&Objective::Bleed);
    let mut service = Service {
        evaluator: Evaluator::new(
            gpu.as_ref(),
            &choice,
            &rendered,
            bleed,
            monitor(candidate.scenes.quiet),
        )?,
        cost: candidate.objective.contains(&Objective::Cost),
        inbox: Inbox {
            lines: lines(),
            waiting: VecDeque::new(),
            cancelled: BTreeSet::new(),
        },
    };
    let names: Vec<&String> = rendered.iter().map(|scene| &scene.name).collect();
    line(json!({"ready": true, "filter": choice.filter.name, "scenes": names}))?;
    while let Some(request) = service.inbox.next()? {
        service.answer(request)?;
    }
    Ok(())
}

struct Service<'a> {
    evaluator: Evaluator<'a>,
    cost: bool,
    inbox: Inbox,
}

/// Requests that are not yet answered.
struct Inbox {
    lines: Receiver<Line>,
    waiting: VecDeque<Scoring>,
    cancelled: BTreeSet<u64>,
}

/// What is to be scored.
struct Scoring {
    id: u64,
    params: BTreeMap<String, Value>,
    scenes: Option<Vec<String>>,
}

impl Service<'_> {
    /// Scores one candidate, scene by scene, and sums up; a request that cannot be answered gets an error and ends nothing.
    fn answer(&mut self, request: Scoring) -> Result<(), Error> {
        let id = request.id;
        if self.inbox.cancelled.remove(&id) {
            return line(json!({"id": id, "cancelled": true}));
        }
        let known: Vec<String> = (self.evaluator.targets.iter())
            .map(|target| target.scene.name.clone())
            .collect();
        let found = scene_indices(&known, request.scenes).and_then(|scenes| {
            let settings = changed(&self.evaluator.choice, request.params)?;
            let inbox = &mut self.inbox;
            evaluate_candidate(
                &mut self.evaluator,
                &settings,
                &scenes,
                self.cost,
                |scene, score| heard(inbox, id, &known[scene], score),
            )
        });
        match found {
            Ok(answer) => line(json!({"id": id, "done": answer})),
            Err(_) if self.inbox.cancelled.remove(&id) => {
                line(json!({"id": id, "cancelled": true}))
            }
            Err(error) if error.is_interruption() => Err(error),
            Err(error) => line(json!({"id": id, "error": error.to_string()})),
        }
    }
}

/// Tells of one scene; false where nobody wants to hear more.
fn heard(inbox: &mut Inbox, id: u64, scene: &str, score: &SceneScore) -> bool {
    let told = line(json!({"id": id, "scene": scene, "flip": score.flip, "bleed": score.bleed}));
    told.is_ok() && inbox.read().is_ok() && !inbox.cancelled.contains(&id)
}

impl Inbox {
    /// The next request; none where standard input has ended.
    fn next(&mut self) -> Result<Option<Scoring>, Error> {
        self.read()?;
        while self.waiting.is_empty() {
            match self.lines.recv_timeout(PAUSE) {
                Ok(text) => self.take(text)?,
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) if interrupted() => {
                    return Err(filters::FilterError::Interrupted.into());
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
        Ok(self.waiting.pop_front())
    }

    /// Takes in whatever has arrived.
    fn read(&mut self) -> Result<(), Error> {
        while self.waiting.len() < MOST_WAITING {
            match self.lines.try_recv() {
                Ok(text) => self.take(text)?,
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => return Ok(()),
            }
        }
        Ok(())
    }

    fn take(&mut self, text: Line) -> Result<(), Error> {
        let text = match text {
            Ok(text) if text.trim().is_empty() => return Ok(()),
            Ok(text) => text,
            Err(reason) => return line(json!({"error": reason})),
        };
        match serde_json::from_str(&text) {
            Ok(Request::Score { id, params, scenes }) => {
                self.waiting.push_back(Scoring { id, params, scenes });
                Ok(())
            }
            Ok(Request::Cancel { cancel }) if self.cancelled.len() >= MOST_CANCELLED => {
                let reason = format!(
                    "{MOST_CANCELLED} requests that have not come are cancelled already, which is the most"
                );
                line(json!({"id": cancel, "error": reason}))
            }
            Ok(Request::Cancel { cancel }) => {
                self.cancelled.insert(cancel);
                Ok(())
            }
            Err(_) => line(json!({
                "error": format!(
                    "{}: allowed are {{\"id\": 7, \"params\": {{\"samples\": 12}}, \"scenes\": [\"fan\"]}} and \
                     {{\"cancel\": 7}}, each on a line of its own",
                    beginning(&text)
                )
            })),
        }
    }
}

fn scene_indices(known: &[String], names: Option<Vec<String>>) -> Result<Vec<usize>, Error> {
    let Some(names) = names else {
        return Ok((0..known.len()).collect());
    };
    let mut seen = BTreeSet::new();
    if let Some(twin) = names.iter().find(|name| !seen.insert(*name)) {
        return Err(Error::Usage(format!(
            "scenes: \"{twin}\" is named twice; allowed: each once"
        )));
    }
    (names.iter())
        .map(|name| {
            let index = known.iter().position(|it| it == name);
            index.ok_or_else(|| {
                Error::Usage(format!(
                    "scenes: \"{name}\" was not loaded; allowed: {}",
                    known.join(", ")
                ))
            })
        })
        .collect()
}

/// As much of a line as an error shows.
fn beginning(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}..", &text[..end]),
    }
}

fn line(value: serde_json::Value) -> Result<(), Error> {
    say(&format!("{value}\n"))
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn a_request_under_way_ends_when_it_is_cancelled_and_no_other_does() {
        let (sender, lines) = channel();
        let mut inbox = Inbox {
            lines,
            waiting: VecDeque::new(),
            cancelled: BTreeSet::new(),
        };
        let score = SceneScore {
            flip: 0.1,
            bleed: None,
        };
        assert!(heard(&mut inbox, 7, "fan", &score));
        sender.send(Ok("{\"cancel\": 8}".to_owned())).unwrap();
        assert!(heard(&mut inbox, 7, "fan", &score));
        sender.send(Ok("{\"cancel\": 7}".to_owned())).unwrap();
        assert!(!heard(&mut inbox, 7, "fan", &score));
    }
}
