//! Self-test of the fuzzer: it finds the inputs that fail on purpose, and names each kind of failure correctly.

use std::time::Duration;

use clap::Parser;

use crate::campaign::Campaign;
use crate::options::Options;
use crate::seeds::shipped;
use crate::target::find;

/// Panics unless every planted failure is found. The input's lines after the first are words of the expected message.
pub fn check() {
    let planted = find("planted").expect("it is a target");
    let inputs = shipped("tests/fuzz/corpus/planted", "");
    let count = inputs.len() as u64;
    // Long enough to start a process on a busy machine.
    let campaign = Campaign::new(Options::parse_from(["fuzz"]), Duration::from_secs(3));
    campaign.run([(planted, 0..4), (planted, 4..count)].into_iter());
    let found = &campaign.found.lock().unwrap()["planted"];
    let hows: Vec<&str> = found.failures.values().map(|it| it.how.as_str()).collect();
    for input in inputs {
        let input = String::from_utf8(input).expect("it is text");
        let is_found = |how: &&str| input.lines().skip(1).all(|words| how.contains(words));
        // On other systems `ulimit -v` has no effect.
        let is_limited = cfg!(target_os = "linux") || !input.starts_with("allocation");
        assert!(
            !is_limited || hows.iter().any(is_found),
            "the fuzzer did not notice {input}; it found {}",
            hows.join("; ")
        );
    }
    assert_eq!(found.cases, count, "cases after a failure are tried");
}
