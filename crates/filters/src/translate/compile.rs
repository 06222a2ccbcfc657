//! Compilation of a shader by a program on the PATH: to SPIR-V, or to WGSL in the case of WESL.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use super::compiler::{Compiler, MAX_MODULE_BYTES};
use super::language::Language;
use super::sources::Sources;
use crate::FilterError;
use crate::command::collect_environment;
use crate::filter::PassShader;
use crate::printable::escape_controls;

/// Longest time that a compiler may take.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Most of a compiler's words that are read.
const MAX_LOG_BYTES: u64 = 1 << 20;

/// Most of a compiler's words that an error shows.
const MAX_MESSAGE_BYTES: usize = 4096;

/// Arguments of a compiler, and the texts that it saw.
type Compiled = (String, BTreeMap<PathBuf, String>);

/// What this process has compiled.
static COMPILED: Mutex<BTreeMap<Compiled, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Lists the compilers of a pass that are installed, the best first: all of its language, or the one that it chose.
pub(super) fn list_installed(
    language: Language,
    shader: &PassShader,
    path: &Path,
) -> Result<Vec<&'static str>, FilterError> {
    let known = language.compilers().iter().copied();
    // A vertex stage may have another language.
    let chosen =
        (shader.compiler.as_deref()).filter(|chosen| known.clone().any(|it| it == *chosen));
    let wanted: Vec<&str> = known
        .filter(|program| chosen.is_none_or(|chosen| chosen == *program))
        .collect();
    let installed: Vec<&str> = wanted
        .iter()
        .copied()
        .filter(|it| is_installed(it))
        .collect();
    if !installed.is_empty() {
        return Ok(installed);
    }
    let compilers = Compiler::list(language, shader, "");
    let way_out = compilers
        .iter()
        .rev()
        .find(|it| wanted.contains(&it.program))
        .map_or("", |it| it.way_out);
    let (becomes, ending) = match language {
        Language::Wesl => ("WGSL", "wgsl"),
        _ => ("SPIR-V", "spv"),
    };
    Err(FilterError::Folder {
        path: path.to_owned(),
        line: None,
        reason: format!(
            "{} needs {} on the PATH, which is not there; {way_out}; or compile it to {becomes} elsewhere and name the \
             .{ending} file in filter.toml",
            language.name(),
            wanted.join(" or "),
        ),
    })
}

/// Compiles a shader with one of its language's compilers: WESL to WGSL, others to SPIR-V.
pub(super) fn compile(
    folder: &Path,
    text: &str,
    language: Language,
    shader: &PassShader,
    program: &str,
) -> Result<Vec<u8>, FilterError> {
    let path = &folder.join(&shader.file);
    let refuse = |line, reason| FilterError::Folder {
        path: path.to_owned(),
        line,
        reason,
    };
    let compilers = Compiler::list(language, shader, text);
    let compiler = compilers.iter().find(|it| it.program == program);
    let compiler = compiler.expect("the program is one of the language's");
    let sources = Sources::collect(folder, &shader.file, text, language)?;
    let arguments = compiler.arguments.join(" ");
    let key = (
        format!(
            "{} {arguments} {}",
            compiler.program,
            sources.shader.display()
        ),
        sources.texts.clone(),
    );
    let kept = || COMPILED.lock().unwrap_or_else(|broken| broken.into_inner());
    if let Some(module) = kept().get(&key) {
        return Ok(module.clone());
    }
    let module =
        run(compiler, folder, &sources, language).map_err(|(line, reason)| refuse(line, reason))?;
    kept().insert(key, module.clone());
    Ok(module)
}

fn is_installed(program: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let endings = ["", ".exe"];
    std::env::split_paths(&folders)
        .any(|folder| (endings.iter()).any(|end| folder.join(format!("{program}{end}")).is_file()))
}

/// Runs a compiler on copies of the sources. An error has the line that the compiler names.
fn run(
    compiler: &Compiler,
    folder: &Path,
    sources: &Sources,
    language: Language,
) -> Result<Vec<u8>, (Option<usize>, String)> {
    let program = compiler.program;
    let fail = |what: &str, error: std::io::Error| (None, format!("{program}: {what}: {error}"));
    let bench = tempfile::tempdir().map_err(|error| fail("no temporary folder", error))?;
    let copies = bench.path().join("sources");
    (sources.write(&copies)).map_err(|error| fail("its input cannot be written", error))?;
    let input = copies.join(&sources.shader);
    let log = bench.path().join("log.txt");
    let output = bench.path().join(match language {
        Language::Wesl => "shader.wgsl",
        _ => "module.spv",
    });
    let mut include = std::ffi::OsString::from("-I");
    include.push(input.parent().unwrap_or(&copies));
    let words = compiler.arguments.iter().map(|word| match word.as_str() {
        "{in}" => input.clone().into_os_string(),
        "{out}" => output.clone().into_os_string(),
        "{include}" => include.clone(),
        word => word.into(),
    });
    let create =
        |path: &Path| std::fs::File::create(path).map_err(|error| fail("no temporary file", error));
    let errors = create(&log)?;
    // The compiler of WESL prints what it makes; the others print errors there.
    let said = match language {
        Language::Wesl => create(&output)?,
        _ => errors
            .try_clone()
            .map_err(|error| fail("no temporary file", error))?,
    };
    let mut child = Command::new(program)
        .args(words)
        .env_clear()
        .envs(collect_environment(&[]))
        .current_dir(bench.path())
        .stdin(Stdio::null())
        .stdout(said)
        .stderr(errors)
        .spawn()
        .map_err(|error| fail("cannot be started", error))?;
    let start = Instant::now();
    let status = loop {
        match child
            .try_wait()
            .map_err(|error| fail("cannot be waited for", error))?
        {
            Some(status) => break status,
            None if start.elapsed() < TIME_LIMIT => std::thread::sleep(Duration::from_millis(2)),
            None => {
                _ = child.kill();
                _ = child.wait();
                let reason = format!(
                    "{program} took longer than {} s and was stopped",
                    TIME_LIMIT.as_secs()
                );
                return Err((None, reason));
            }
        }
    };
    let is_empty = std::fs::metadata(&output).map_or(true, |output| output.len() == 0);
    if !status.success() || is_empty {
        let mut said = Vec::new();
        let file = std::fs::File::open(&log).map_err(|error| fail("its words are lost", error))?;
        (file.take(MAX_LOG_BYTES).read_to_end(&mut said))
            .map_err(|error| fail("its words are lost", error))?;
        let said = remove_colors(&String::from_utf8_lossy(&said));
        let (line, message) = find_error(&said, &input, &copies, folder);
        return Err((line, format!("{program} refuses it: {message}")));
    }
    frame::read_bounded(&output, MAX_MODULE_BYTES)
        .map_err(|error| (None, format!("{program} wrote no module: {error}")))
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

/// Finds the first line that a compiler names, and tidies what it said.
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
    let lines: Vec<String> = lines.map(|line| escape_controls(&line)).collect();
    (line, shorten(lines))
}

/// Joins what a compiler said. If that is too long, lines with errors come first, and the number of lines that are left out last.
fn shorten(mut lines: Vec<String>) -> String {
    let whole = lines.join("\n");
    if whole.len() <= MAX_MESSAGE_BYTES {
        return whole;
    }
    lines.sort_by_key(|line| !line.to_lowercase().contains("error"));
    let mut shown = String::new();
    let mut rest = lines.iter();
    for line in rest.by_ref() {
        let room = MAX_MESSAGE_BYTES.saturating_sub(shown.len());
        if line.len() > room {
            let ends = line.char_indices().map(|(end, _)| end);
            let end = ends.take_while(|end| *end <= room).last().unwrap_or(0);
            shown += &line[..end];
            break;
        }
        shown += line;
        shown.push('\n');
    }
    format!("{}\n... {} more lines", shown.trim_end(), rest.len())
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
