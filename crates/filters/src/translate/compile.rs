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

/// Most of a compiler's words that an error shows.
const MAX_MESSAGE_BYTES: usize = 4096;

/// Arguments of a compiler, and the texts that it saw.
type Compiled = (String, BTreeMap<PathBuf, String>);

/// What this process has compiled.
static COMPILED: Mutex<BTreeMap<Compiled, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Compiles a shader with the first compiler of its language that is installed: WESL to WGSL, others to SPIR-V.
pub(super) fn compile(
    folder: &Path,
    text: &str,
    language: Language,
    shader: &PassShader,
) -> Result<Vec<u8>, FilterError> {
    let path = &folder.join(&shader.file);
    let refuse = |line, reason| FilterError::Folder {
        path: path.to_owned(),
        line,
        reason,
    };
    let compilers = Compiler::list(language, shader, text);
    let installed = compilers.iter().find(|it| is_installed(it.program));
    let Some(compiler) = installed else {
        let names: Vec<&str> = compilers.iter().map(|it| it.program).collect();
        let last = compilers.last().expect("the language has a compiler");
        let (becomes, ending) = match language {
            Language::Wesl => ("WGSL", "wgsl"),
            _ => ("SPIR-V", "spv"),
        };
        return Err(refuse(
            None,
            format!(
                "{} needs {} on the PATH, which is not there; {}; or compile it to {becomes} elsewhere and name the \
                 .{ending} file in filter.toml",
                language.name(),
                names.join(" or "),
                last.way_out
            ),
        ));
    };
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
        (file.take(MAX_MESSAGE_BYTES as u64).read_to_end(&mut said))
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
    (line, lines.join("\n"))
}
