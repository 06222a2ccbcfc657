//! Targets: files that inputs replace, and the commands that read them.

use std::fs;
use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use flate2::read::GzDecoder;
use serde::Deserialize;
use walkdir::WalkDir;

/// Content of a file next to a case's folder, which no case may change or show.
const CANARY: &str = "unreadable_canary";

/// Documented exit codes.
const CODES: [i32; 5] = [0, 1, 2, 3, 4];

/// Exit code of a command that reached its time limit.
const KILLED: i32 = 137;

/// Unpacks an input that repeats itself.
fn unpack(content: &[u8]) -> Vec<u8> {
    let mut unpacked = Vec::new();
    let read = GzDecoder::new(content).read_to_end(&mut unpacked);
    read.expect("the corpus can be unpacked");
    unpacked
}

#[derive(Deserialize)]
pub struct Target {
    pub name: String,
    /// Folder of its inputs, if not its name.
    pub corpus: Option<String>,
    /// The file that an input replaces.
    pub file: String,
    /// Commands that read the file; none if the input is a command line.
    pub commands: Vec<String>,
    /// Seconds that a command may take, if not 60. A command line that takes longer is no failure.
    pub time_limit: Option<u32>,
}

/// The fuzzed program and its files.
pub struct Program {
    pub path: PathBuf,
    /// Folder that each case copies.
    pub fixture: PathBuf,
}

impl Target {
    /// Returns the name of the folder of its inputs.
    pub fn corpus_name(&self) -> &str {
        self.corpus.as_ref().unwrap_or(&self.name)
    }

    /// Returns the file's content in the fixture, and the inputs of the corpus.
    pub fn inputs(&self, fixture: &Path) -> Vec<Vec<u8>> {
        let folder = tests::root().join("tests/fuzz/corpus");
        let folder = folder.join(self.corpus_name());
        let mut inputs: Vec<Vec<u8>> = fs::read(fixture.join(&self.file)).into_iter().collect();
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        paths.sort();
        for path in paths {
            let content = fs::read(&path).unwrap();
            inputs.push(match path.extension() {
                Some(_) => unpack(&content),
                None => content,
            });
        }
        inputs
    }

    /// Runs the commands on an input in a folder of their own. Returns whether they accept it, or
    /// an error that describes a failure.
    pub fn run(&self, input: &[u8], program: &Program) -> Result<bool, String> {
        let outer = tempfile::tempdir().unwrap();
        // Deep enough for inputs that contain `../../`.
        let folder = outer.path().join("a/b/c/case");
        fs::create_dir_all(folder.parent().unwrap()).unwrap();
        let mut copy = Command::new("cp");
        let copied = copy.arg("-r").args([&program.fixture, &folder]).status();
        assert!(copied.unwrap().success());
        let canary = folder.with_file_name("canary.txt");
        fs::write(&canary, CANARY).unwrap();
        self.write(input, &folder, &canary);
        let mut is_accepted = true;
        for words in self.list_commands(input) {
            let (code, printed) = program.run(&words, &folder, self.time_limit.unwrap_or(60));
            let is_slow_line = code == KILLED && self.commands.is_empty();
            if !CODES.contains(&code) && !is_slow_line {
                return Err(format!("exit code {code}: {}", printed.trim()));
            }
            if printed.contains(CANARY) {
                return Err(format!("a file outside was read: {printed}"));
            }
            is_accepted &= code <= 1;
        }
        let outside = WalkDir::new(outer.path()).into_iter();
        let outside = outside.filter_entry(|entry| entry.path() != folder);
        let files =
            outside.filter(|entry| entry.as_ref().is_ok_and(|file| !file.file_type().is_dir()));
        if files.count() != 1 || fs::read_to_string(&canary).ok().as_deref() != Some(CANARY) {
            return Err("a file outside was changed".to_owned());
        }
        Ok(is_accepted)
    }

    /// Splits the commands, or an input that is a command line, into words.
    fn list_commands(&self, input: &[u8]) -> Vec<Vec<String>> {
        if self.commands.is_empty() {
            let text = String::from_utf8_lossy(input);
            let words = text.lines().map(|word| word.replace('\0', ""));
            return vec![words.filter(|word| word != "/").collect()];
        }
        let commands = self.commands.iter();
        commands
            .map(|line| shlex::split(line).expect("words"))
            .collect()
    }

    /// Writes an input in place of the file. In a text, `@canary@` stands for the canary, and a
    /// line `//// NAME` begins another file.
    fn write(&self, input: &[u8], folder: &Path, canary: &Path) {
        let path = folder.join(&self.file);
        let Ok(text) = std::str::from_utf8(input) else {
            return fs::write(path, input).unwrap();
        };
        // Compilers work on copies, where a path that begins at the root leads there.
        let canary = format!("{}{}", "../".repeat(12), canary.display());
        let text = text.replace("@canary@", &canary);
        let mut parts = text.split("//// ");
        fs::write(&path, parts.next().unwrap_or_default()).unwrap();
        for (name, part) in parts.filter_map(|part| part.split_once('\n')) {
            if ["top.h", "p/near.h", "p/q/deep.h"].contains(&name) {
                let path = path.with_file_name(name);
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(path, part).unwrap();
            }
        }
    }
}

impl Program {
    /// Runs a command with limits on its time, in seconds, and on its address space. Returns its
    /// exit code and what it prints.
    fn run(&self, words: &[String], folder: &Path, time_limit: u32) -> (i32, String) {
        let script = format!("ulimit -v 4194304; exec timeout -s KILL {time_limit} \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command.args(["-c", &script]).arg(&self.path).args(words);
        command.current_dir(folder).env("RUST_BACKTRACE", "0");
        let output = command.output().unwrap();
        let signal = || KILLED - 9 + output.status.signal().unwrap_or_default();
        let code = output.status.code().unwrap_or_else(signal);
        let printed = [output.stdout, output.stderr].concat();
        (code, String::from_utf8_lossy(&printed).into_owned())
    }
}
