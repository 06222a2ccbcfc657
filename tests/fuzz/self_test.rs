//! Self-test of the fuzzer: it finds the inputs that fail on purpose, and names each kind of failure correctly.

use std::path::Path;
use std::time::Duration;

use crate::batch::Terms;
use crate::campaign::run;
use crate::failure::How;
use crate::target::find;
use crate::targets::PLANTED;

/// Panics unless every planted failure is found.
pub fn check() {
    let planted = find("planted").expect("it is a target");
    let terms = Terms {
        fixture: Path::new("none"),
        seed: 1,
        // Long enough to start a process on a busy machine.
        limit: Duration::from_secs(3),
    };
    let cases = 0..PLANTED.len() as u64;
    let batches = [(planted, cases.start..2), (planted, 2..cases.end)];
    let found = run(&terms, batches.into_iter(), None);
    let hows = found.hows("planted");
    let is_there = |what: &str, holds: &dyn Fn(&How) -> bool| {
        let all: Vec<String> = hows.iter().map(ToString::to_string).collect();
        assert!(
            hows.iter().any(|how| holds(how)),
            "the fuzzer did not notice {what}; it found {}",
            all.join("; ")
        );
    };
    let text = |how: &How| how.to_string();
    is_there(
        "a panic",
        &|how| matches!(how, How::Panic(text) if text.contains("planted.rs") && text.contains("on purpose")),
    );
    is_there(
        "a panic on another thread",
        &|how| matches!(how, How::Panic(text) if text.contains("in a crowd")),
    );
    is_there("a case without end", &|how| matches!(how, How::Hang(_)));
    is_there("a stack that overflows", &|how| {
        text(how).contains("overflowed its stack")
    });
    is_there("an exit", &|how| text(how).contains("exit code 7"));
    is_there("a file outside the folder that is gone", &|how| {
        text(how).contains("outside the case's folder")
    });
    // On other systems `ulimit -v` has no effect.
    if cfg!(target_os = "linux") {
        is_there("an allocation above the limit", &|how| {
            text(how).contains("memory allocation of")
        });
    }
    assert_eq!(
        found.tallies["planted"].cases,
        PLANTED.len() as u64,
        "cases behind one that fails are tried as well"
    );
}
