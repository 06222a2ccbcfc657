//! Bench of filters: the time of every pass, its memory traffic, and how both grow with the reach.

mod command;
mod costs;
mod file;
mod page;
mod panels;
mod spread;
mod table;
mod timing;

use std::collections::BTreeMap;

use filters::{AdapterDescription, Clock, Value};
use serde::{Deserialize, Serialize};

pub use self::command::{BenchArgs, execute};
pub use self::page::add_costs;
pub use self::spread::Spread;
pub use self::table::bench_table;
pub use self::timing::{BenchPlan, bench};

/// Version of the layout of `bench.json`.
pub const BENCH_FORMAT: u32 = 1;

/// Filter and preset that other times are divided by.
pub const BASELINE: &str = "jump_flood:paper";

/// Exposure of the frames, in frames: trails are as long as the motion.
pub const EXPOSURE: f64 = 1.0;

/// Motion of the main table, in pixels per frame: where the published jump flood begins to cut
/// trails.
pub const SPEED: u32 = 32;

/// Reaches whose cost is measured, in pixels.
pub const REACHES: [u32; 6] = [8, 16, 32, 64, 128, 256];

/// Reach, in pixels, that the longest one is compared with.
pub const GROWTH_FROM: u32 = 16;

/// A finished bench: `bench.json`. Durations are in seconds.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bench {
    /// [`BENCH_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Adapter that the filters ran on.
    pub adapter: AdapterDescription,
    /// Clock of the durations.
    pub clock: Clock,
    /// Steps of the clock in seconds, if a browser rounds it.
    pub clock_step: Option<f64>,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rounds of timing.
    pub rounds: u32,
    /// Scene with the frame that a browser timed; none for the moving panels.
    pub scene: Option<String>,
    /// Exposure of the panels, in frames.
    pub exposure: Option<f64>,
    /// Motion of the panels of `cases`, in pixels per frame.
    pub speed: Option<u32>,
    /// Speed of the adapter's memory; a browser does not measure it, nor the traffic.
    pub copy: Option<CopyCost>,
    /// Costs of every filter preset, with the preset's own parameters.
    pub cases: Vec<CaseCost>,
    /// Costs of every filter preset by reach.
    pub reaches: Vec<ReachCost>,
}

/// A copy from one buffer to another, larger than caches.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CopyCost {
    /// Bytes read and written.
    pub bytes: u64,
    /// Time of one copy.
    pub seconds: Spread,
    /// Bytes over median time.
    pub bytes_per_second: f64,
}

/// One filter preset.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CaseCost {
    /// Filter name.
    pub filter: String,
    /// The preset.
    pub preset: String,
    /// Every parameter's value.
    pub parameters: BTreeMap<String, Value>,
    /// Picture width that the preset was made for, from which values in pixels were scaled; none if
    /// the preset names none, or values were left as written.
    #[serde(default)]
    pub reference_width: Option<u32>,
    /// Time of all passes.
    pub seconds: Spread,
    /// Ratio to the time of [`BASELINE`] in the same round, if that was timed.
    pub ratio: Option<Spread>,
    /// Memory traffic of all passes; see [`filters::PassTime::bytes`].
    pub bytes_per_pixel: Option<f64>,
    /// Bytes over median time.
    pub bytes_per_second: Option<f64>,
    /// Bytes per second, relative to the copy's.
    pub part_of_copy: Option<f64>,
    /// Passes in the order of their runs.
    pub passes: Vec<PassCost>,
}

/// One pass with all its iterations.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PassCost {
    /// Entry point of the kernel.
    pub entry: String,
    /// Runs of the pass.
    pub iterations: usize,
    /// Time of all iterations.
    pub seconds: Spread,
    /// Memory traffic of all iterations.
    pub bytes_per_pixel: Option<f64>,
}

/// The cost of one filter preset at every reach.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ReachCost {
    /// Filter name.
    pub filter: String,
    /// The preset.
    pub preset: String,
    /// Parameter that was set for each reach; none if nothing limits the filter's reach.
    pub parameter: Option<String>,
    /// Costs at each of [`REACHES`].
    pub points: Vec<ReachPoint>,
    /// Time at the longest reach, relative to [`GROWTH_FROM`] in the same round; none if either
    /// cannot be set.
    pub growth: Option<Spread>,
}

/// The cost at one reach.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ReachPoint {
    /// Motion in pixels per frame that the filter is set to cover.
    pub pixels: u32,
    /// Time of all passes; none if the parameter's range does not reach this far.
    pub seconds: Option<Spread>,
    /// Value of the parameter that was set.
    pub value: Option<Value>,
    /// Passes in the order of their runs; empty if nothing was timed.
    pub passes: Vec<PassCost>,
}
