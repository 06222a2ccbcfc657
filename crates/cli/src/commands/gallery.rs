//! The command `gallery`.

use std::path::Path;

use report::write_gallery;
use suite::{Error, Run, printable_path};

use crate::arguments::GalleryArgs;
use crate::output::print::print;

/// Writes the gallery of a finished run.
pub fn execute(args: &GalleryArgs) -> Result<(), Error> {
    let path = match args.run.is_dir() {
        true => args.run.join("run.json"),
        false => args.run.clone(),
    };
    let run = Run::read(&path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    write_gallery(&run, folder, &args.out)?;
    let page = args.out.join("README.md");
    print(&format!("written: {}\n", printable_path(&page)))
}
