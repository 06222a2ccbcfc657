//! Inputs that fail on purpose, to test the fuzzer.

use std::time::Duration;

use crate::place::Place;

/// Obeys the first line of the input.
pub fn fail(place: &mut Place, input: &[u8]) -> Option<()> {
    match input.split(|byte| *byte == b'\n').next()? {
        b"panic" => panic!("it panics on purpose"),
        b"crowd" => rayon::in_place_scope(|scope| {
            scope.spawn(|_| panic!("it panics in a crowd"));
        }),
        b"overflow" => {
            std::hint::black_box(endless(1));
        }
        b"hang" => loop {
            std::thread::sleep(Duration::from_secs(1));
        },
        b"allocation" => drop(std::hint::black_box(vec![1_u8; 5 << 30])),
        b"exit" => std::process::exit(7),
        b"canary" => std::fs::remove_file(place.canary()).unwrap(),
        _ => {}
    }
    Some(())
}

/// Calls itself until the stack is full.
#[expect(unconditional_recursion, reason = "it overflows on purpose")]
fn endless(depth: u64) -> u64 {
    std::hint::black_box(endless(std::hint::black_box(depth) + 1)) + depth
}
