//! Arithmetic without memory, the upper limit of what a second thread gains. It tells a machine that shares its cores from
//! rays that hinder one another.

use std::hint::black_box;

/// Numbers computed side by side: few enough for registers, enough to keep all units busy.
const NUMBERS: usize = 32;
/// Rounds that take about as long as a part of the rays.
const ROUNDS: usize = 450_000;

/// Multiplies and adds in 32 bits. The count is unused but keeps the compiler from dropping the work.
pub fn arithmetic() -> usize {
    let mut numbers: [f32; NUMBERS] = std::array::from_fn(|at| at as f32);
    let factor = black_box(0.999_f32);
    for _ in 0..ROUNDS {
        for number in &mut numbers {
            *number = *number * factor + 1.0;
        }
    }
    black_box(numbers)
        .iter()
        .filter(|number| **number > 0.0)
        .count()
}
