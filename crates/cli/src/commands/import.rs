//! The command `import`.

use suite::{Error, ImportPlan, Imported, Motions, import, printable_path};

use super::render_settings::check_exposure;
use crate::arguments::ImportArgs;
use crate::output::print::print;

/// Makes the scene folder and prints what it holds.
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
    print(&format!(
        "{exposes}\n{triangles} triangles, the set's among them\nwritten: {folder}\nnext: shuttertruth run --scenes {}{folder} --out out\n",
        if args.out.is_relative() { "./" } else { "" },
    ))
}
