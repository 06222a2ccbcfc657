//! Locations of scenes and their files: on disk, or in a program.

use std::fmt;
use std::io;
use std::path::{Component, Path, PathBuf};

use frame::{FileError, read_bounded};

/// Folder of files that a program contains.
#[derive(Debug)]
pub struct Bundle {
    /// Name of the folder, which begins the paths of its files in messages.
    pub name: &'static str,
    /// Lists the paths of all files below the folder, with `/` between their parts.
    pub list: fn() -> Vec<&'static str>,
    /// Unpacks the file of a path; none if there is no such file.
    pub unpack: fn(&str) -> Option<Vec<u8>>,
}

/// Folder or file, on disk or in a [`Bundle`].
#[derive(Clone, Debug)]
pub struct Location {
    /// Path on disk; in a bundle it begins with the bundle's name.
    pub path: PathBuf,
    /// Bundle that contains it; none on disk.
    pub bundle: Option<&'static Bundle>,
}

impl Location {
    /// The whole of a bundle.
    pub fn of_bundle(bundle: &'static Bundle) -> Self {
        Self {
            path: bundle.name.into(),
            bundle: Some(bundle),
        }
    }

    /// The location of another path in the same store.
    pub fn at(&self, path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            bundle: self.bundle,
        }
    }

    /// The location of a name below this folder.
    pub fn join(&self, name: impl AsRef<Path>) -> Self {
        self.at(&self.path.join(name))
    }

    /// The path, if it is on disk.
    pub fn on_disk(&self) -> Option<&Path> {
        self.bundle.is_none().then_some(self.path.as_path())
    }

    /// Returns whether this is a folder.
    pub fn is_dir(&self) -> bool {
        match self.bundle {
            None => self.path.is_dir(),
            Some(bundle) => self
                .name_in(bundle)
                .is_some_and(|name| below(bundle, &name).next().is_some()),
        }
    }

    /// Returns whether this is a file.
    pub fn is_file(&self) -> bool {
        match self.bundle {
            None => self.path.is_file(),
            Some(bundle) => self
                .name_in(bundle)
                .is_some_and(|name| (bundle.list)().contains(&name.as_str())),
        }
    }

    /// Returns whether there is anything, readable or not.
    pub fn exists(&self) -> bool {
        match self.bundle {
            None => self.path.exists(),
            Some(_) => self.is_file() || self.is_dir(),
        }
    }

    /// Lists the content of a folder, in no order.
    pub fn list(&self) -> io::Result<Vec<Self>> {
        let Some(bundle) = self.bundle else {
            let entries = std::fs::read_dir(&self.path)?;
            return entries
                .map(|entry| entry.map(|entry| self.at(&entry.path())))
                .collect();
        };
        let name = self.name_in(bundle).ok_or(io::ErrorKind::NotFound)?;
        let mut names: Vec<&str> = below(bundle, &name)
            .map(|rest| rest.split('/').next().unwrap_or(rest))
            .collect();
        names.dedup();
        Ok(names.into_iter().map(|name| self.join(name)).collect())
    }

    /// Reads a file of at most `limit` bytes.
    ///
    /// # Errors
    /// Fails if there is no such file, if it is not a regular file, or if it is larger than
    /// `limit`.
    pub fn read(&self, limit: u64) -> Result<Vec<u8>, FileError> {
        let Some(bundle) = self.bundle else {
            return read_bounded(&self.path, limit);
        };
        let contents = self.name_in(bundle).and_then(|name| (bundle.unpack)(&name));
        let missing = || FileError::io(&self.path, "read", io::ErrorKind::NotFound.into());
        let bytes = contents.ok_or_else(missing)?;
        if bytes.len() as u64 <= limit {
            Ok(bytes)
        } else {
            let reason = format!("has {} bytes; allowed: up to {limit}", bytes.len());
            Err(FileError::foreign(&self.path, reason))
        }
    }

    /// The name in the bundle, with `/` between its parts; empty for the bundle itself. None for a
    /// path that leaves it.
    fn name_in(&self, bundle: &Bundle) -> Option<String> {
        let path = self.path.strip_prefix(bundle.name).ok()?;
        let parts: Option<Vec<&str>> = (path.components())
            .map(|part| match part {
                Component::Normal(part) => part.to_str(),
                _ => None,
            })
            .collect();
        Some(parts?.join("/"))
    }
}

/// Lists the paths of files below a folder of a bundle, relative to that folder.
fn below<'a>(bundle: &Bundle, folder: &'a str) -> impl Iterator<Item = &'static str> + use<'a> {
    (bundle.list)().into_iter().filter_map(move |path| {
        if folder.is_empty() {
            Some(path)
        } else {
            path.strip_prefix(folder)?.strip_prefix('/')
        }
    })
}

impl fmt::Display for Location {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.path.display().fmt(formatter)
    }
}

impl<P: AsRef<Path>> From<P> for Location {
    fn from(path: P) -> Self {
        Self {
            path: path.as_ref().to_owned(),
            bundle: None,
        }
    }
}

impl From<&Location> for Location {
    fn from(location: &Location) -> Self {
        location.clone()
    }
}
