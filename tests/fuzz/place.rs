//! Folder that a worker's cases run in.

use std::fs;
use std::os::unix::fs::FileTypeExt;
use std::path::{Path, PathBuf};

use filters::Gpu;
use suite::FilterChoice;

use crate::fixture;
use crate::targets::Service;

/// Content of a file beside the folder of a case, which no case may change.
pub const CANARY: &str = "this file belongs to nobody's run";

/// Temporary folder, and values that stay from case to case.
pub struct Place {
    _keep: tempfile::TempDir,
    /// Folder of the cases.
    pub folder: PathBuf,
    /// Files that the program wrote before the first case.
    pub fixture: PathBuf,
    /// Adapter, opened once.
    pub gpu: Option<Gpu>,
    /// Running `serve`.
    pub service: Option<Service>,
    /// All built-in filters, loaded once.
    pub filters: Vec<FilterChoice>,
    canary: PathBuf,
}

impl Place {
    /// Makes an empty folder.
    pub fn new(fixture: &Path) -> Self {
        let keep = tempfile::Builder::new()
            .prefix("shuttertruth-fuzz-")
            .tempdir()
            .expect("a folder for temporary files");
        // Deep enough for inputs that contain `../../`.
        let folder = keep.path().join("a/b/c/case");
        fs::create_dir_all(&folder).unwrap();
        let canary = keep.path().join("a/b/c/canary.txt");
        fs::write(&canary, CANARY).unwrap();
        Self {
            _keep: keep,
            folder,
            fixture: fixture.to_owned(),
            gpu: None,
            service: None,
            filters: Vec::new(),
            canary,
        }
    }

    /// Writes a file below the folder and returns its path.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, content).unwrap();
        path
    }

    /// Copies a folder of the fixture to `name` below the cases' folder, once.
    pub fn copy(&self, name: &str) -> PathBuf {
        let own = self.folder.join(name);
        if !own.exists() {
            fixture::copy(&self.fixture.join(name), &own);
        }
        own
    }

    /// Copies a folder of the fixture again.
    pub fn copy_again(&self, name: &str) -> PathBuf {
        let _ = fs::remove_dir_all(self.folder.join(name));
        self.copy(name)
    }

    /// Panics if a case changed a file beside its folder.
    pub fn check(&self) {
        let found = fs::read_to_string(&self.canary).unwrap_or_default();
        assert_eq!(
            found, CANARY,
            "a file outside the case's folder was changed"
        );
        // Inputs name devices as output files, and tests of CI run as root.
        let device = fs::metadata("/dev/null").map(|found| found.file_type());
        assert!(
            device.is_ok_and(|kind| kind.is_char_device()),
            "/dev/null was replaced"
        );
    }
}
