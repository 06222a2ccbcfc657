//! Requests of `tune serve` that wait for an answer, and replies to them.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

use filters::{FilterError, Value};
use serde::Deserialize;
use serde_json::json;
use suite::Error;

use super::line_reader::{Line, read_lines};
use crate::output::{print, was_interrupted};

/// Upper limit on requests that wait; more are read later.
const MAX_WAITING: usize = 1024;

/// Upper limit on cancelled requests that have not come yet.
const MAX_CANCELLED: usize = 65_536;

/// Characters of a line that an error shows.
const SHOWN: usize = 200;

/// Time between two looks for Ctrl-C while nothing comes.
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

/// Requests that are not yet answered.
pub struct Inbox {
    lines: Receiver<Line>,
    waiting: VecDeque<ScoreRequest>,
    /// Numbers of cancelled requests.
    pub cancelled: BTreeSet<u64>,
}

/// A candidate to score.
pub struct ScoreRequest {
    /// Number that the answer repeats.
    pub id: u64,
    /// Parameters that differ from the preset.
    pub params: BTreeMap<String, Value>,
    /// Names of the scenes; none for all.
    pub scenes: Option<Vec<String>>,
}

impl Inbox {
    /// Reads standard input from now on.
    pub fn open() -> Self {
        Self::new(read_lines())
    }

    /// Takes its lines from any channel.
    pub fn new(lines: Receiver<Line>) -> Self {
        Self {
            lines,
            waiting: VecDeque::new(),
            cancelled: BTreeSet::new(),
        }
    }

    /// Waits for the next request; none where standard input has ended.
    pub fn next(&mut self) -> Result<Option<ScoreRequest>, Error> {
        self.read()?;
        while self.waiting.is_empty() {
            match self.lines.recv_timeout(PAUSE) {
                Ok(text) => self.take(text)?,
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) if was_interrupted() => {
                    return Err(FilterError::Interrupted.into());
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
        Ok(self.waiting.pop_front())
    }

    /// Takes in all lines that have arrived.
    pub fn read(&mut self) -> Result<(), Error> {
        while self.waiting.len() < MAX_WAITING {
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
            Err(reason) => return print_reply(json!({"error": reason})),
        };
        match serde_json::from_str(&text) {
            Ok(Request::Score { id, params, scenes }) => {
                self.waiting.push_back(ScoreRequest { id, params, scenes });
                Ok(())
            }
            Ok(Request::Cancel { cancel }) if self.cancelled.len() >= MAX_CANCELLED => {
                let reason = format!(
                    "{MAX_CANCELLED} requests that have not come are cancelled already, which is the most"
                );
                print_reply(json!({"id": cancel, "error": reason}))
            }
            Ok(Request::Cancel { cancel }) => {
                self.cancelled.insert(cancel);
                Ok(())
            }
            Err(_) => print_reply(json!({
                "error": format!(
                    "{}: allowed are {{\"id\": 7, \"params\": {{\"samples\": 12}}, \"scenes\": [\"fan\"]}} and \
                     {{\"cancel\": 7}}, each on a line of its own",
                    shorten(&text)
                )
            })),
        }
    }
}

/// Cuts a line to the part that an error shows.
fn shorten(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}..", &text[..end]),
    }
}

/// Prints one reply.
pub fn print_reply(value: serde_json::Value) -> Result<(), Error> {
    print(&format!("{value}\n"))
}
