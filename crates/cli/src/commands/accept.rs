//! The command `accept`.

use suite::{Acceptance, Baseline, Error, Run, accept_scores, refuse_failures};

use crate::arguments::AcceptArgs;
use crate::output::print::print;

/// Writes the scores of a finished run into the baseline.
pub fn execute(args: &AcceptArgs) -> Result<(), Error> {
    let in_ci = std::env::var("CI").is_ok_and(|value| value == "true" || value == "1");
    if in_ci && !args.force {
        return Err(Error::Usage(
            "CI is set: a check would accept itself; accept on a machine of your own and commit the baseline, or add --force"
                .to_owned(),
        ));
    }
    let reason = args.reason.trim();
    if reason.is_empty() || reason.contains('\n') {
        return Err(Error::Usage(
            "--reason: needs one line on why these scores are right".to_owned(),
        ));
    }
    let run = Run::read(&args.out.join("run.json"))?;
    refuse_failures(&run.failures)?;
    let old = match args.baseline.exists() {
        true => Some(Baseline::read(&args.baseline)?),
        false => None,
    };
    let baseline = accept_scores(
        &run,
        old,
        &Acceptance {
            only: args.only.as_ref(),
            reason,
            forced: args.force,
        },
    )?;
    baseline.write(&args.baseline)?;
    print(&format!(
        "written: {}\n",
        suite::printable_path(&args.baseline)
    ))
}
