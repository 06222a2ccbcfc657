//! Options: the words after `cargo test -p tests --test mutants --`.

use std::path::PathBuf;

use clap::Parser;

/// Measures a mutation score of the limits.
#[derive(Parser)]
#[command(name = "mutants")]
pub struct Options {
    /// Filters with their presets, with commas between them
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "jump_flood:corrected,mcguire:paper,guertin:paper,kino:default"
    )]
    pub filters: Vec<String>,
    /// Names of scenes or patterns, with commas between them
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "fan,railing,two_spheres,roll,crossing"
    )]
    pub scenes: Vec<String>,
    /// Columns and rows of the pictures [default: the size that the shipped limits hold for]
    #[arg(long, value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Samples per pixel of the truths
    #[arg(long = "samples-per-pixel", default_value_t = 64)]
    pub samples: u32,
    /// Mutants of each filter, at most
    #[arg(long, default_value_t = 100)]
    pub count: usize,
    /// Minutes after which no work is begun [default: measure everything]
    #[arg(long)]
    pub minutes: Option<u64>,
    /// Folder of truths and measured mutants
    #[arg(long, default_value = concat!(env!("CARGO_TARGET_TMPDIR"), "/mutants"))]
    pub out: PathBuf,
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once('x');
    let parsed =
        sides.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    parsed.ok_or_else(|| "allowed: columns x rows, such as 160x90".to_owned())
}
