//! Filter folders that tests change.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use filters::{Blur, Filter, FilterError};
use frame::Size;
use serde::Deserialize;
use tests::text::assert_contains;
use tests::{root, shared_gpu};

/// Prepares the first preset of a filter for pictures of a size, in pixels.
pub fn ready(filter: &Filter, size: impl Into<Size>) -> Result<Blur<'static>, FilterError> {
    let Size { width, height } = size.into();
    let settings = filter.settings(None).unwrap();
    Blur::new(shared_gpu(), filter, &settings, width, height)
}

/// A row of refusals.toml: a text, its replacement, and parts of the message.
#[derive(Deserialize)]
struct Change {
    from: String,
    to: String,
    message: Vec<String>,
}

/// Files of a filter folder, by name.
#[derive(Clone, Default)]
pub struct FilterFiles(BTreeMap<String, Vec<u8>>);

impl FilterFiles {
    /// Reads the files of a folder in tests/fixtures.
    pub fn fixture(folder: &str) -> Self {
        Self::read(&root().join("tests/fixtures").join(folder))
    }

    pub fn read(folder: &Path) -> Self {
        let paths = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path());
        let files = paths.filter(|path| path.is_file()).map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, fs::read(&path).unwrap())
        });
        Self(files.collect())
    }

    pub fn with(mut self, name: &str, content: impl AsRef<[u8]>) -> Self {
        self.0.insert(name.to_owned(), content.as_ref().to_owned());
        self
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.0[name].clone()).unwrap()
    }

    /// Replaces one piece of a file.
    #[track_caller]
    pub fn changed(&self, name: &str, from: &str, to: &str) -> Self {
        let text = self.text(name);
        assert!(text.contains(from), "{name} holds no \"{from}\"");
        self.clone().with(name, text.replacen(from, to, 1))
    }

    /// Writes the folder, and loads it.
    pub fn load(&self) -> Result<Filter, FilterError> {
        let folder = tempfile::tempdir().unwrap();
        for (name, content) in &self.0 {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
        }
        Filter::load(folder.path())
    }

    /// Fails unless each change of a table in refusals.toml is refused with its words.
    #[track_caller]
    pub fn assert_refused(&self, table: &str) {
        let tables: toml::Table = include_str!("refusals.toml").parse().unwrap();
        let files: BTreeMap<String, Vec<Change>> = tables[table].clone().try_into().unwrap();
        for (name, changes) in &files {
            for Change { from, to, message } in changes {
                let Err(error) = self.changed(name, from, to).load() else {
                    panic!("\"{from}\" -> \"{to}\" was accepted");
                };
                assert_contains(&format!("\"{from}\" -> \"{to}\": {error}"), message);
            }
        }
    }
}
