//! Folder where a worker's cases run.

use std::fs;
use std::os::unix::fs::FileTypeExt;
use std::path::{Path, PathBuf};

use crate::fixture;

/// Content of a file next to a case's folder, which no case may change.
pub const CANARY: &str = "this file belongs to nobody's run";

/// Temporary folder.
pub struct Place {
    _keep: tempfile::TempDir,
    /// Folder of the cases.
    pub folder: PathBuf,
    /// Name of the target.
    pub target: &'static str,
    /// Files that the program wrote before the first case.
    pub fixture: PathBuf,
}

impl Place {
    /// Makes an empty folder.
    pub fn new(target: &'static str, fixture: &Path) -> Self {
        let mut made = tempfile::Builder::new();
        let keep = made.prefix("shuttertruth-fuzz-").tempdir();
        let keep = keep.expect("a folder for temporary files");
        // Deep enough for inputs that contain `../../`.
        let folder = keep.path().join("a/b/c/case");
        fs::create_dir_all(&folder).unwrap();
        let place = Self {
            _keep: keep,
            folder,
            target,
            fixture: fixture.to_owned(),
        };
        fs::write(place.canary(), CANARY).unwrap();
        place
    }

    /// Returns the path of a file that no case may change.
    pub fn canary(&self) -> PathBuf {
        self.folder.with_file_name("canary.txt")
    }

    /// Writes a file below the folder and returns its path.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, content).unwrap();
        path
    }

    /// Copies a file or folder of the fixture to `name` below the cases' folder, once.
    pub fn copy(&self, name: &str) -> PathBuf {
        let own = self.folder.join(name);
        if !own.exists() {
            fixture::copy(&self.fixture.join(name), &own);
        }
        own
    }

    /// Panics if a case changed a file next to its folder.
    pub fn check(&self) {
        let found = fs::read_to_string(self.canary()).unwrap_or_default();
        assert!(
            found == CANARY,
            "a file outside the case's folder was changed"
        );
        // Inputs name devices as output files, and tests of CI run as root.
        let device = fs::metadata("/dev/null").map(|found| found.file_type());
        let is_device = device.is_ok_and(|kind| kind.is_char_device());
        assert!(is_device, "/dev/null was replaced");
    }
}

/// Joins the last three lines of a file that are not empty.
pub fn last_lines(path: &Path) -> String {
    let text = fs::read(path).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    let lines: Vec<&str> = lines.collect();
    lines[lines.len().saturating_sub(3)..].join(" ")
}
