//! Two finished runs of the same cases: what changed, and whether it is more than noise.

mod change;
mod margin;
mod mean;
mod noise;
mod pairing;
mod settings;
mod side;

use serde::Serialize;
use tracer::Watch;

use crate::{Error, PROGRAM};

pub use change::{Basis, Change, ChangeKind, rank_changes};
pub use mean::{MeanChange, MeanKind};
pub use pairing::{Pair, pairs, subject};
pub use settings::SettingChange;
pub use side::Side;

use mean::means;
use noise::changes;
use pairing::{check_comparable, only_in};
use settings::settings;

/// Version of the layout of what `compare --json` prints.
pub const COMPARE_FORMAT: u32 = 1;

/// All that two runs have to say about one another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// [`COMPARE_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: &'static str,
    /// The first run.json and the second one.
    pub runs: [String; 2],
    /// Settings in which the runs differ.
    pub settings: Vec<SettingChange>,
    /// Cases of the first run that the second one lacks: `fan / jump_flood:paper`.
    pub only_in_first: Vec<String>,
    /// Cases of the second run that the first one lacks.
    pub only_in_second: Vec<String>,
    /// Per filter that both have, and per metric, the mean over scenes; bars are left out.
    pub means: Vec<MeanChange>,
    /// Per case that both have, and per metric, in the order of the first run.
    pub changes: Vec<Change>,
}

/// Compares two runs. Reads, where they are there, the replicates of the truths and the pictures of what changed, to tell
/// changes from noise; writes nothing. `watch` hears of every pair of cases.
pub fn compare_runs(first: &Side, second: &Side, watch: Watch) -> Result<Compared, Error> {
    let pairs = pairs(&first.run, &second.run);
    check_comparable(first, second, &pairs)?;
    let changes = changes([first, second], &pairs, watch)?;
    Ok(Compared {
        format: COMPARE_FORMAT,
        program: PROGRAM,
        runs: [first, second].map(|side| side.path.display().to_string()),
        settings: settings(&first.run, &second.run, &pairs),
        only_in_first: only_in(&first.run, &second.run),
        only_in_second: only_in(&second.run, &first.run),
        means: means(&changes),
        changes,
    })
}
