//! The process that cases run in. Its end does not end the fuzzer.

use std::any::Any;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::Mutex;

use crate::mutation::mutate;
use crate::options::{Inputs, Work};
use crate::place::Place;
use crate::random::Random;
use crate::seeds::{Seed, changeable, read_seeds};
use crate::target::Target;

/// Prefix of every line for the parent.
pub const MARK: &str = "@fuzz ";

/// Characters of a panic's message that are reported.
const LONGEST: usize = 400;

/// The last panic, in one line.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Tries inputs one by one and reports each to the parent; ends at the first panic.
pub fn work(work: &Work) -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(ToString::to_string);
        let message = panic_message(panic.payload());
        let line = format!("{}: {message}", place.unwrap_or_default());
        let line: String = line.replace('\n', " ").chars().take(LONGEST).collect();
        *PANIC.lock().unwrap() = line;
    }));
    let mut place = Place::new(&work.fixture);
    match &work.inputs {
        Inputs::File(path) => {
            let input = std::fs::read(path).expect("the input can be read");
            try_input(work.target, &mut place, 0, &input)
        }
        Inputs::Made { seed, cases, kept } => {
            let seeds = read_seeds(work.target, &place);
            for case in cases.clone() {
                let input = make_input(work.target, &place, &seeds, *seed, case);
                std::fs::write(kept, &input).expect("an input can be kept");
                let tried = try_input(work.target, &mut place, case, &input);
                if tried != ExitCode::SUCCESS {
                    return tried;
                }
            }
            ExitCode::SUCCESS
        }
    }
}

fn panic_message(payload: &dyn Any) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or(payload.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}

/// Makes the input of a case: first the seeds as they are, then changed ones.
fn make_input(target: &Target, place: &Place, seeds: &[Seed], seed: u64, case: u64) -> Vec<u8> {
    match seeds.get(case as usize) {
        Some(Seed::Bytes(bytes)) => bytes.clone(),
        Some(Seed::Made(make)) => make(),
        None => {
            let mut random = Random::of_case(seed, target.name, case);
            mutate(target, place, &changeable(seeds), &mut random)
        }
    }
}

fn try_input(target: &Target, place: &mut Place, case: u64, input: &[u8]) -> ExitCode {
    say(&format!("begin {case}"));
    let tried = catch_unwind(AssertUnwindSafe(|| {
        (target.run)(place, input);
        place.check();
    }));
    match tried {
        Ok(()) => {
            say(&format!("done {case}"));
            ExitCode::SUCCESS
        }
        Err(_) => {
            let panic = PANIC.lock().map(|line| line.clone()).unwrap_or_default();
            say(&format!("panic {panic}"));
            ExitCode::from(101)
        }
    }
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
