//! Folders of OBJ files, one per frame, as simulators write them.

use std::fs;
use std::path::{Path, PathBuf};

use frame::FileError;
use measure::Error;

use crate::files::{name_of, refuse};

/// OBJ files of consecutive frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    pub files: Vec<PathBuf>,
    /// Frame of the first file, relative to the instant.
    pub first: f64,
}

impl Series {
    /// Makes a series of a file that does not change.
    pub fn of_one(file: &Path) -> Self {
        Self {
            files: vec![file.to_owned()],
            first: 0.0,
        }
    }

    /// Lists the OBJ files of a folder by the numbers at the ends of their names. The frames of a
    /// sequence lie in their middle.
    pub fn list(folder: &Path, frames: u32) -> Result<Self, Error> {
        let fail = |source| FileError::io(folder, "read", source);
        let mut numbered = Vec::new();
        for entry in fs::read_dir(folder).map_err(fail)? {
            let path = entry.map_err(fail)?.path();
            if path
                .extension()
                .is_some_and(|ending| ending.eq_ignore_ascii_case("obj"))
            {
                let stem = path
                    .file_stem()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let name = stem.trim_end_matches(|letter: char| letter.is_ascii_digit());
                let Ok(number) = stem[name.len()..].parse::<u64>() else {
                    return refuse!(
                        path,
                        "has no number at the end of its name; name the files of a folder by their frames, such as wave_0001.obj"
                    );
                };
                numbered.push((name.to_owned(), number, path));
            }
        }
        numbered.sort();
        if numbered.len() < 2 {
            return refuse!(
                folder,
                "holds {} OBJ files; a folder needs two or more, one per frame, such as wave_0001.obj",
                numbered.len()
            );
        }
        for pair in numbered.windows(2) {
            let [(name, number, path), (next_name, next_number, next)] = pair else {
                continue;
            };
            if name != next_name || number + 1 != *next_number {
                return refuse!(
                    next,
                    "comes after {}; allowed: one name with consecutive numbers, one per frame",
                    name_of(path)
                );
            }
        }
        let before = numbered.len().saturating_sub(frames as usize) / 2;
        Ok(Self {
            files: numbered.into_iter().map(|(_, _, path)| path).collect(),
            first: -(before as f64),
        })
    }

    /// Writes the keys of scene.toml that name the files.
    pub fn keys(&self, files: &[String]) -> String {
        let text = |file: &String| toml::Value::from(file.as_str()).to_string();
        if let [file] = files {
            return format!("mesh = {}\n", text(file));
        }
        let shapes = files.iter().zip(0u32..).map(|(file, number)| {
            let time = self.first + f64::from(number);
            format!("    {{ time = {time:?}, mesh = {} }},\n", text(file))
        });
        format!("shapes = [\n{}]\n", shapes.collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_in_the_order_of_their_numbers() {
        let folder = tempfile::tempdir().unwrap();
        for number in [9, 10, 11, 8, 12] {
            fs::write(folder.path().join(format!("wave{number}.obj")), "").unwrap();
        }
        let series = Series::list(folder.path(), 1).unwrap();
        let names: Vec<String> = series
            .files
            .iter()
            .map(|file| name_of(file).to_string())
            .collect();
        assert_eq!(
            names,
            [
                "wave8.obj",
                "wave9.obj",
                "wave10.obj",
                "wave11.obj",
                "wave12.obj"
            ]
        );
        assert_eq!(series.first, -2.0);
        fs::remove_file(folder.path().join("wave10.obj")).unwrap();
        let refused = Series::list(folder.path(), 1).unwrap_err().to_string();
        assert!(
            refused.contains("wave11.obj: comes after wave9.obj"),
            "{refused}"
        );
    }
}
