//! A reader of a page, who writes its files and runs its commands in a folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tests::root;

use crate::sandbox::read_below;

/// A copy of the repository files that the guides' commands need.
pub struct Reader {
    folder: tempfile::TempDir,
}

impl Reader {
    /// Makes the folder, with the program on the PATH and the guide's filter in `my_blur`.
    pub fn new() -> Self {
        let reader = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        for folder in ["scenes", "examples"] {
            for (name, bytes) in read_below(&root().join(folder)) {
                reader.write(Path::new(folder).join(name), bytes);
            }
        }
        for name in ["Makefile", "Cargo.toml"] {
            fs::copy(root().join(name), reader.path(name)).unwrap();
        }
        fs::create_dir(reader.path("bin")).unwrap();
        let program = env!("CARGO_BIN_EXE_shuttertruth");
        std::os::unix::fs::symlink(program, reader.path("bin/shuttertruth")).unwrap();
        let kernel = read_below(&root().join("examples/first_blur/wgsl"));
        for (name, bytes) in kernel {
            reader.write(Path::new("my_blur").join(name), bytes);
        }
        reader
    }

    fn path(&self, below: &str) -> PathBuf {
        self.folder.path().join(below)
    }

    /// Writes a file, and its parent folders.
    pub fn write(&self, path: impl AsRef<Path>, bytes: impl AsRef<[u8]>) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    /// Runs a line of shell.
    pub fn run(&self, line: &str) -> Output {
        let path = std::env::var("PATH").unwrap();
        let path = format!("{}:{path}", self.path("bin").display());
        let mut command = Command::new("sh");
        command.args(["-c", line]).current_dir(self.folder.path());
        // `accept` refuses to work in CI.
        command.env("PATH", path).env_remove("CI");
        // The first machine of an array.
        command.env("SLURM_ARRAY_TASK_ID", "0");
        command.output().unwrap()
    }
}
