//! `shuttertruth merge`

use suite::{Error, merge};

use super::say;
use crate::arguments::MergeArgs;

/// Joins parts, and says which truths they made.
pub fn execute(args: &MergeArgs) -> Result<(), Error> {
    for merged in merge(&args.parts, &args.out)? {
        say(&format!(
            "{} ({} replicates)\n",
            suite::printable_path(&merged.truth),
            merged.replicates
        ))?;
    }
    Ok(())
}
