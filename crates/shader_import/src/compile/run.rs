//! Run of a compiler on copies of a shader, in a folder that holds nothing else.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Duration;

use process::{End, Limits, OutputFile, collect_environment, half_of_memory};

use super::messages::{find_error, remove_colors};
use crate::compiler::Compiler;
use crate::fault::ImportError;
use crate::language::Language;
use crate::shader_file::ShaderFile;
use crate::sources::{MAX_MODULE_BYTES, Sources};

/// Longest time that a compiler may take.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Most bytes of memory that a compiler may use, on a machine that has twice as much. Large shaders
/// of engines take some 100 MB.
const MEMORY_LIMIT: u64 = 2 << 30;

/// Most bytes of a compiler's messages that are read.
const MAX_LOG_BYTES: u64 = 1 << 20;

/// Call of a compiler, and the texts that it saw.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Call {
    program: &'static str,
    arguments: Vec<String>,
    shader: PathBuf,
    texts: BTreeMap<PathBuf, String>,
}

/// What this process has compiled.
static COMPILED: Mutex<BTreeMap<Call, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Compiles a shader with one of its language's compilers: WESL to WGSL, others to SPIR-V.
pub fn compile(
    sources: &Sources,
    shader: &ShaderFile,
    compiler: &Compiler,
) -> Result<Vec<u8>, ImportError> {
    let words = (compiler.arguments)(shader, sources);
    let defines = shader.defines.iter().map(|define| format!("-D{define}"));
    let words = words.split_whitespace().map(str::to_owned);
    let call = Call {
        program: compiler.program,
        arguments: defines.chain(words).collect(),
        shader: sources.shader.clone(),
        texts: sources.texts.clone(),
    };
    let cache = || COMPILED.lock().unwrap_or_else(|broken| broken.into_inner());
    if let Some(module) = cache().get(&call) {
        return Ok(module.clone());
    }
    let program = compiler.program;
    let outcome = run(program, &call.arguments, sources)
        .unwrap_or_else(|error| Outcome::Failed(None, format!("{program}: {error}")));
    let module = match outcome {
        Outcome::Module(module) => module,
        Outcome::Stopped => return Err(ImportError::Interrupted),
        Outcome::Failed(line, reason) => {
            return Err(sources.fault(&shader.path, line, reason).into());
        }
    };
    cache().insert(call, module.clone());
    Ok(module)
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
    let errors = File::create(&log)?;
    // The compiler of WESL prints its output; the others print errors there.
    let said = match language {
        Language::Wesl => File::create(&output)?,
        _ => errors.try_clone()?,
    };
    let mut command = Command::new(program);
    command
        .args(fill_in(arguments, &input, &output))
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
    if let Some(outcome) = find_failure(program, &end, memory) {
        return Ok(outcome);
    }
    let is_written = std::fs::metadata(&output).is_ok_and(|output| output.len() > 0);
    if is_written && matches!(end, End::Exited(status) if status.success()) {
        let module = (sources.read_file)(&output, MAX_MODULE_BYTES);
        return Ok(module.map_or_else(
            |reason| Outcome::Failed(None, format!("{program} wrote no module: {reason}")),
            Outcome::Module,
        ));
    }
    let mut said = Vec::new();
    (File::open(&log)?.take(MAX_LOG_BYTES)).read_to_end(&mut said)?;
    let said = remove_colors(&String::from_utf8_lossy(&said));
    let (line, message) = find_error(&said, &input, &copies, folder);
    let reason = format!("{program} refuses it: {message}");
    Ok(Outcome::Failed(line, reason))
}

/// Replaces the words of a command line that stand for files; includes are next to `input`.
fn fill_in(arguments: &[String], input: &Path, output: &Path) -> Vec<OsString> {
    let folder = input.parent().expect("a shader is in a folder");
    let mut include = OsString::from("-I");
    include.push(folder);
    let words = arguments.iter().map(|word| match &word[..] {
        "{in}" => input.into(),
        "{out}" => output.into(),
        "{include}" => include.clone(),
        word => word.into(),
    });
    words.collect()
}

/// Finds why a compilation failed, or that it was stopped; none if the compiler ended by itself.
/// `memory` is the limit, in bytes.
fn find_failure(program: &str, end: &End, memory: u64) -> Option<Outcome> {
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
        End::Exited(_) => return None,
    };
    Some(Outcome::Failed(None, reason))
}
