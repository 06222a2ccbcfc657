//! Inputs that fail on purpose, which the fuzzer must notice.

use std::time::Duration;

use super::none;
use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};

/// Inputs, named after what they do.
pub const PLANTED: [&str; 8] = [
    "hang",
    "nothing",
    "panic",
    "crowd",
    "overflow",
    "allocation",
    "exit",
    "canary",
];

/// Target that the fuzzer skips.
pub static TARGET: Target = Target {
    name: "planted",
    share: 0,
    batch: 100,
    shape: Shape::Text,
    tokens: none(),
    seeds: |_| {
        let seeds = PLANTED.iter();
        seeds
            .map(|name| Seed::Bytes(name.as_bytes().to_vec()))
            .collect()
    },
    run,
};

fn run(place: &mut Place, input: &[u8]) {
    match input {
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
        b"canary" => std::fs::remove_file(place.folder.join("../canary.txt")).unwrap(),
        _ => {}
    }
}

/// Calls itself until the stack is full.
#[expect(unconditional_recursion, reason = "it overflows on purpose")]
fn endless(depth: u64) -> u64 {
    std::hint::black_box(endless(std::hint::black_box(depth) + 1)) + depth
}
