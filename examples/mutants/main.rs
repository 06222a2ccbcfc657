//! Changes shipped kernels in small ways, and counts the changes that the limits notice: `make
//! mutants` prints `results/studies/mutation.txt`.

mod bench;
mod mutant;
mod table;

use bench::Bench;
use measure::Error;
use table::{format_score, format_table};

/// Filters and presets with required limits.
const FILTERS: [(&str, &str); 3] = [
    ("jump_flood", "corrected"),
    ("mcguire", "paper"),
    ("guertin", "paper"),
];

fn main() -> Result<(), Error> {
    let mut bench = Bench::open()?;
    let mut all = Vec::new();
    for (filter, preset) in FILTERS {
        let verdicts = bench.judge_mutants(filter, preset)?;
        print!("{}", format_score(&format!("{filter}:{preset}"), &verdicts));
        all.extend(verdicts);
    }
    println!("\n{}", format_table(&all));
    Ok(())
}
