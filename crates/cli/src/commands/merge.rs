//! The command `merge`.

use suite::{Error, merge, printable_path};

use crate::arguments::MergeArgs;
use crate::output::print::print;

/// Joins parts and prints the truths that they made.
pub fn execute(args: &MergeArgs) -> Result<(), Error> {
    for merged in merge(&args.parts, &args.out)? {
        print(&format!(
            "{} ({} replicates)\n",
            printable_path(&merged.truth),
            merged.replicates
        ))?;
    }
    Ok(())
}
