//! Files of bounds for one picture size, such as `bounds_1280x720.toml`.

use frame::Size;
use measure::{Error, SIDES};
use scene::Location;

use crate::bounds::{BOUNDS_FILE, BoundsFile, read_bounds_file};

/// Names the file of bounds for pictures of `size`, next to the scenes or to one scene.
pub fn sized_bounds_file(size: Size) -> String {
    format!("bounds_{size}.toml")
}

/// Reads a file of bounds for pictures of `size`: a limit need not name it, and may not name
/// another.
pub(super) fn read_sized_bounds(file: &Location, size: Size) -> Result<BoundsFile, Error> {
    let mut read = read_bounds_file(file)?;
    if let Some(margin) = read.margins.values().next() {
        return Err(Error::Refused(format!(
            "{}: a margin is for pictures of every size; it belongs into {BOUNDS_FILE} next to the scenes",
            margin.place
        )));
    }
    for (metric, bound) in read.tables_mut().flatten() {
        let bound_size = *bound.size.get_or_insert(size);
        if bound_size != size {
            return Err(Error::Refused(format!(
                "{}: {metric}: size = {:?} in a file for {size}; leave the size out, or move the limit to {}",
                bound.place,
                bound_size.sides(),
                sized_bounds_file(bound_size)
            )));
        }
    }
    Ok(read)
}

/// Reads all files of bounds in a folder, in the order of their names. Refuses a file with a
/// similar name, since nothing would read it.
pub(super) fn read_all_bounds(folder: &Location) -> Result<Vec<BoundsFile>, Error> {
    let mut files = Vec::new();
    for file in folder.list().unwrap_or_default() {
        let name = file.path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|name| name.starts_with("bounds") && name.ends_with(".toml"))
        else {
            continue;
        };
        let size = match name {
            BOUNDS_FILE => None,
            _ => Some(size_in_name(name).ok_or_else(|| {
                Error::Refused(format!(
                    "{file}: nothing reads a file of that name; allowed: {BOUNDS_FILE}, and bounds_COLUMNSxROWS.toml for pictures of \
                     one size, with {} to {} columns and rows",
                    SIDES.start(),
                    SIDES.end()
                ))
            })?),
        };
        files.push(match size {
            None => read_bounds_file(&file)?,
            Some(size) => read_sized_bounds(&file, size)?,
        });
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// Returns the size in the name of a file of bounds; none if [`sized_bounds_file`] would not write
/// that name.
fn size_in_name(name: &str) -> Option<Size> {
    let text = name.strip_prefix("bounds_")?.strip_suffix(".toml")?;
    let size: Size = text.parse().ok()?;
    let allowed = size.sides().iter().all(|side| SIDES.contains(side));
    (allowed && sized_bounds_file(size) == name).then_some(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_holds_a_size() {
        assert_eq!(
            size_in_name("bounds_1280x720.toml"),
            Some(Size::new(1280, 720))
        );
        for other in [
            "bounds_0x720.toml",
            "bounds_01280x720.toml",
            "bounds_1280.toml",
            "bounds-1280x720.toml",
            "bounds_1280x720x3.toml",
            "bounds_1280x999999.toml",
        ] {
            assert_eq!(size_in_name(other), None, "{other}");
        }
    }
}
