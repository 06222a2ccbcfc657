//! `shuttertruth import`

use suite::{Error, ImportPlan, Imported, Motions, import, printable_path};

use super::{check_exposure, say};
use crate::arguments::ImportArgs;

/// Makes the scene folder and says what is in it.
pub fn execute(args: &ImportArgs) -> Result<(), Error> {
    check_exposure(args.exposure)?;
    let plan = ImportPlan {
        model: args.model.clone(),
        out: args.out.clone(),
        up: args.up,
        plain: args.plain,
        motions: Motions {
            spin: args.spin,
            slide: args.slide,
            orbit: args.orbit,
        },
        exposure: args.exposure,
    };
    let Imported { exposes, triangles } = import(&plan)?;
    let folder = printable_path(&args.out);
    say(&format!(
        "{exposes}\n{triangles} triangles, the set's among them\nwritten: {folder}\nnext: shuttertruth run --scenes {}{folder} --out out\n",
        if args.out.is_relative() { "./" } else { "" },
    ))
}
