//! The command `import`.

use std::path::Path;

use engine::{ImportPlan, Imported, Motions, import};
use store::printable_path;
use suite::Error;

use super::render_settings::check_exposure;
use crate::arguments::ImportArgs;
use crate::output::print::print;

/// Makes the scene folder and prints what it holds.
pub fn execute(args: &ImportArgs) -> Result<(), Error> {
    check_exposure(args.exposure)?;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => Path::new("out").join(args.model.file_stem().unwrap_or(args.model.as_os_str())),
    };
    let plan = ImportPlan {
        model: args.model.clone(),
        out: out.clone(),
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
    let folder = printable_path(&out);
    print(&format!(
        "{exposes}\n{triangles} triangles, the set's among them\nwritten: {folder}\nnext: shuttertruth run --scenes {}{folder}\n",
        if out.is_relative() { "./" } else { "" },
    ))
}
