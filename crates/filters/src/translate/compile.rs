//! Compilation of a shader by a program on the PATH: to SPIR-V, or from WESL to WGSL.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Duration;

use process::{End, Limits, OutputFile, half_of_memory};

use super::compiler::Compiler;
use super::language::Language;
use super::sources::{MAX_MODULE_BYTES, Sources};
use crate::FilterError;
use crate::command::collect_environment;
use crate::filter::PassShader;

/// Longest time that a compiler may take.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Most bytes of memory that a compiler may use, on a machine that has twice as much. Large shaders
/// of engines take some 100 MB.
const MEMORY_LIMIT: u64 = 2 << 30;

/// Most bytes of a compiler's messages that are read.
const MAX_LOG_BYTES: u64 = 1 << 20;

/// Most bytes of a compiler's messages that an error shows.
const MAX_MESSAGE_BYTES: usize = 4096;

/// Arguments of a compiler, and the texts that it saw.
type Compiled = (String, BTreeMap<PathBuf, String>);

/// What this process has compiled.
static COMPILED: Mutex<BTreeMap<Compiled, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Lists the compilers of a pass that are installed, the best first: all of its language, or the
/// one that it chose.
pub(super) fn list_installed(
    language: Language,
    shader: &PassShader,
    path: &Path,
) -> Result<Vec<&'static Compiler>, FilterError> {
    let known = language.compilers();
    let is_chosen = |compiler: &&Compiler| shader.compiler.as_deref() == Some(compiler.program);
    // A vertex stage may have another language.
    let wanted: Vec<&Compiler> = match known.iter().find(is_chosen) {
        Some(chosen) => vec![chosen],
        None => known.iter().collect(),
    };
    let installed = wanted.iter().copied();
    let installed: Vec<&Compiler> = installed
        .filter(|compiler| is_installed(compiler.program))
        .collect();
    if !installed.is_empty() {
        return Ok(installed);
    }
    let (becomes, ending) = match language {
        Language::Wesl => ("WGSL", "wgsl"),
        _ => ("SPIR-V", "spv"),
    };
    let programs: Vec<&str> = wanted.iter().map(|compiler| compiler.program).collect();
    Err(FilterError::in_file(
        path,
        None,
        format!(
            "{} needs {} on the PATH, which is not there; {}; or compile it to {becomes} elsewhere and name the \
             .{ending} file in filter.toml",
            language.name(),
            programs.join(" or "),
            wanted.last().map_or("", |last| last.way_out),
        ),
    ))
}

/// Compiles a shader with one of its language's compilers: WESL to WGSL, others to SPIR-V.
pub(super) fn compile(
    sources: &Sources,
    shader: &PassShader,
    compiler: &Compiler,
) -> Result<Vec<u8>, FilterError> {
    let words = (compiler.arguments)(shader, sources);
    let defines = shader.defines.iter().map(|define| format!("-D{define}"));
    let words = words.split_whitespace().map(str::to_owned);
    let arguments: Vec<String> = defines.chain(words).collect();
    let key = (
        format!(
            "{} {arguments:?} {}",
            compiler.program,
            sources.shader.display()
        ),
        sources.texts.clone(),
    );
    let cache = || COMPILED.lock().unwrap_or_else(|broken| broken.into_inner());
    if let Some(module) = cache().get(&key) {
        return Ok(module.clone());
    }
    let program = compiler.program;
    let outcome = run(program, &arguments, sources)
        .unwrap_or_else(|error| Outcome::Failed(None, format!("{program}: {error}")));
    let module = match outcome {
        Outcome::Module(module) => module,
        Outcome::Stopped => return Err(FilterError::Interrupted),
        Outcome::Failed(line, reason) => {
            let path = sources.folder.join(&shader.file);
            return Err(FilterError::in_file(&path, line, reason));
        }
    };
    cache().insert(key, module.clone());
    Ok(module)
}

fn is_installed(program: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let endings = ["", ".exe"];
    std::env::split_paths(&folders)
        .any(|folder| (endings.iter()).any(|end| folder.join(format!("{program}{end}")).is_file()))
}

/// End of a compilation.
enum Outcome {
    /// The module.
    Module(Vec<u8>),
    /// The compiler's error, with the line that it names.
    Failed(Option<usize>, String),
    /// The user interrupted the work.
    Stopped,
}

/// Runs a compiler on copies of the sources.
fn run(program: &str, arguments: &[String], sources: &Sources) -> std::io::Result<Outcome> {
    let Sources {
        folder, language, ..
    } = *sources;
    let workplace = tempfile::tempdir()?;
    let copies = workplace.path().join("sources");
    sources.write(&copies)?;
    let input = copies.join(&sources.shader);
    let log = workplace.path().join("log.txt");
    let output = workplace.path().join(match language {
        Language::Wesl => "shader.wgsl",
        _ => "module.spv",
    });
    let mut include = OsString::from("-I");
    include.push(input.parent().unwrap_or(&copies));
    let words = arguments.iter().map(|word| match &word[..] {
        "{in}" => input.clone().into_os_string(),
        "{out}" => output.clone().into_os_string(),
        "{include}" => include.clone(),
        word => word.into(),
    });
    let errors = File::create(&log)?;
    // The compiler of WESL prints its output; the others print errors there.
    let said = match language {
        Language::Wesl => File::create(&output)?,
        _ => errors.try_clone()?,
    };
    let mut command = Command::new(program);
    command
        .args(words)
        .env_clear()
        .envs(collect_environment(&[]))
        .current_dir(workplace.path())
        .stdout(said)
        .stderr(errors);
    let memory = MEMORY_LIMIT.min(half_of_memory());
    let limits = Limits {
        time: TIME_LIMIT,
        memory,
        output: Some(OutputFile {
            path: output.clone(),
            bytes: MAX_MODULE_BYTES,
        }),
        whole_tree: false,
    };
    let end = process::run(command, &limits)?;
    if let Some(outcome) = find_outcome(program, &end, &output, memory) {
        return Ok(outcome);
    }
    let mut said = Vec::new();
    (File::open(&log)?.take(MAX_LOG_BYTES)).read_to_end(&mut said)?;
    let said = remove_colors(&String::from_utf8_lossy(&said));
    let (line, message) = find_error(&said, &input, &copies, folder);
    let reason = format!("{program} refuses it: {message}");
    Ok(Outcome::Failed(line, reason))
}

/// Finds what came of a compilation; none if the compiler's messages say why it failed. `memory` is
/// the limit, in bytes.
fn find_outcome(program: &str, end: &End, output: &Path, memory: u64) -> Option<Outcome> {
    let reason = match end {
        End::Stopped => return Some(Outcome::Stopped),
        End::OutOfTime => {
            let seconds = TIME_LIMIT.as_secs();
            format!("{program} took longer than {seconds} s and was stopped")
        }
        End::TooLarge => format!(
            "{program} wrote more than {MAX_MODULE_BYTES} bytes, the most that a module may have, and was stopped"
        ),
        // No exit code means a signal: the system killed the compiler, or an allocation failed.
        End::Exited(status) if status.code().is_none() => {
            let most = memory >> 20;
            format!(
                "{program} ended with {status}; it may use {most} MiB of memory; simplify the shader"
            )
        }
        End::Exited(status) => {
            let is_empty = std::fs::metadata(output).map_or(true, |output| output.len() == 0);
            return (status.success() && !is_empty).then(|| read_module(program, output));
        }
    };
    Some(Outcome::Failed(None, reason))
}

/// Reads the module that a compiler wrote.
fn read_module(program: &str, output: &Path) -> Outcome {
    match frame::read_bounded(output, MAX_MODULE_BYTES) {
        Ok(module) => Outcome::Module(module),
        Err(error) => Outcome::Failed(None, format!("{program} wrote no module: {error}")),
    }
}

/// Removes the sequences that colour a terminal.
fn remove_colors(said: &str) -> String {
    let mut parts = said.split("\u{1b}[");
    let plain = parts.next().unwrap_or_default().to_owned();
    parts.fold(plain, |plain, part| {
        let end = part.find(|c: char| c.is_ascii_alphabetic());
        plain + end.map_or("", |end| &part[end + 1..])
    })
}

/// Finds the first line that a compiler names, and tidies its messages.
fn find_error(said: &str, input: &Path, copies: &Path, folder: &Path) -> (Option<usize>, String) {
    let name = input.display().to_string();
    let of_line = |line: &str| -> Option<usize> {
        let after = line.split_once(&name)?.1;
        let digits = after.trim_start_matches([':', '(']);
        let end = digits
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(digits.len());
        digits[..end].parse().ok()
    };
    let line = said.lines().find_map(of_line);
    let lines = (said.lines().map(str::trim_end))
        .filter(|line| !line.is_empty() && *line != name)
        .map(|line| line.replace(&copies.display().to_string(), &folder.display().to_string()));
    let lines = lines.map(|line| line.replace('\t', " "));
    (line, shorten(lines.collect()))
}

/// Joins a compiler's messages. If they are too long, lines with errors come first, and the number
/// of omitted lines last.
fn shorten(mut lines: Vec<String>) -> String {
    let mut said = lines.join("\n");
    if said.len() <= MAX_MESSAGE_BYTES {
        return said;
    }
    lines.sort_by_key(|line| !line.to_lowercase().contains("error"));
    said = lines.join("\n");
    let mut ends = (0..=MAX_MESSAGE_BYTES).rev();
    let end = ends.find(|end| said.is_char_boundary(*end));
    said.truncate(end.unwrap_or(0));
    let left = lines.len() - said.lines().count();
    format!("{}\n... {left} more lines", said.trim_end())
}

#[cfg(test)]
mod tests {
    use super::{MAX_MESSAGE_BYTES, shorten};

    #[test]
    fn errors_come_first_in_what_is_cut() {
        let notes = |count: usize| (0..count).map(|n| format!("note {n}: ö{}", "-".repeat(50)));
        let few: Vec<String> = notes(3).chain(["an Error".to_owned()]).collect();
        assert_eq!(shorten(few.clone()), few.join("\n"));
        let many: Vec<String> = notes(500)
            .chain(["E0001: error: no such name".into()])
            .collect();
        let said = shorten(many);
        let start = "E0001: error: no such name\nnote 0: ö---";
        assert!(said.starts_with(start), "{said}");
        assert!(said.len() < MAX_MESSAGE_BYTES + 30);
        assert!(said.ends_with(" more lines"), "{said}");
        // One line that is too long shows its beginning.
        let said = shorten(vec!["ä".repeat(5000), "error".repeat(2000)]);
        assert!(said.starts_with("errorerror"), "{said}");
        assert!(said.ends_with("errore\n... 1 more lines"), "{said}");
    }
}
