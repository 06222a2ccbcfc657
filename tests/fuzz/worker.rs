//! The process of the cases. Its end does not end the fuzzer.

use std::io::Write;
use std::ops::Range;
use std::process::ExitCode;

use crate::options::Options;
use crate::place::Place;
use crate::seeds::Seeds;

/// Prefix of every line for the parent.
pub const MARK: &str = "@fuzz ";

/// Tries inputs one by one and reports each to the parent; ends at the first panic.
pub fn work(options: &Options, cases: Range<u64>) -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        say(&panic.to_string().replace('\n', " "));
    }));
    let target = options.targets[0];
    let mut place = Place::new(target.name, &options.fixture);
    let seeds = Seeds::read(target, options, &place);
    for case in cases {
        let input = seeds.make(&place, case);
        say(&format!("begin {case}"));
        let read = (target.run)(&mut place, &input);
        let is_refused = read.is_none() && seeds.is_valid(case);
        assert!(!is_refused, "a valid seed was refused");
        place.check();
        say("done");
    }
    ExitCode::SUCCESS
}

fn say(line: &str) {
    let mut out = std::io::stdout().lock();
    // If the parent is gone, nobody reads the line.
    if writeln!(out, "{MARK}{line}")
        .and_then(|()| out.flush())
        .is_err()
    {
        std::process::exit(0);
    }
}
