//! Compilers of shading languages: programs on the PATH that write SPIR-V, or WGSL in the case of WESL.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use super::language::Language;
use crate::FilterError;
use crate::command::collect_environment;
use crate::filter::{PassShader, Stage};
use crate::printable::escape_controls;

/// Longest time that a compiler may take.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Most of a compiler's words that an error shows.
const MAX_MESSAGE_BYTES: usize = 4096;

/// First bindings of the registers of HLSL: `b0`, `t0`, `u0` and `s0` are different things.
const REGISTERS: &str =
    "-fvk-b-shift 0 all -fvk-t-shift 100 all -fvk-u-shift 200 all -fvk-s-shift 300 all";

/// Largest module that is read.
pub(super) const MAX_MODULE_BYTES: u64 = 4 << 20;

/// A compiler, as it is called for one shader.
struct Compiler {
    program: &'static str,
    arguments: Vec<String>,
    /// Way to get it.
    way_out: &'static str,
}

impl Compiler {
    /// Returns the compilers of a language, the best first.
    fn list(language: Language, shader: &PassShader) -> Vec<Self> {
        let PassShader { stage, entry, .. } = shader;
        let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<String>>();
        let short = match stage {
            Stage::Compute => "comp",
            Stage::Fragment => "frag",
        };
        match language {
            // GLSL knows no other entry point than `main`.
            Language::Glsl => vec![Self {
                program: "glslangValidator",
                arguments: words(&format!(
                    "{{include}} -V --target-env vulkan1.1 -S {short} -o {{out}} {{in}}"
                )),
                way_out: "install it, for example: apt-get install glslang-tools (Debian, Ubuntu), dnf install glslang \
                          (Fedora), pacman -S glslang (Arch)",
            }],
            Language::Slang | Language::Hlsl => {
                let profile = match stage {
                    Stage::Compute => "cs_6_0",
                    Stage::Fragment => "ps_6_0",
                };
                let stage = match stage {
                    Stage::Compute => "compute",
                    Stage::Fragment => "fragment",
                };
                let slang = Self {
                    program: "slangc",
                    arguments: words(&format!(
                        "{{include}} {{in}} -target spirv -profile spirv_1_3 -entry {entry} -stage {stage} \
                         -fvk-use-entrypoint-name {REGISTERS} -o {{out}}"
                    )),
                    way_out: "install Slang from https://github.com/shader-slang/slang/releases and add it to the PATH",
                };
                let dxc = Self {
                    program: "dxc",
                    arguments: words(&format!(
                        "{{include}} -spirv -fspv-target-env=vulkan1.1 -T {profile} -E {entry} {REGISTERS} -Fo {{out}} {{in}}"
                    )),
                    way_out: "install slangc from https://github.com/shader-slang/slang/releases, or dxc from \
                              https://github.com/microsoft/DirectXShaderCompiler/releases, and add it to the PATH",
                };
                match language {
                    Language::Hlsl => vec![slang, dxc],
                    _ => vec![slang],
                }
            }
            Language::Wesl => {
                let conditions = shader.conditions.iter().map(|name| format!(" -D {name}"));
                let conditions: String = conditions.collect();
                vec![Self {
                    program: "wesl",
                    arguments: words(&format!("compile{conditions} {{in}}")),
                    way_out: "install it with: cargo install wesl-cli@0.4.0",
                }]
            }
            Language::Spirv | Language::Wgsl => Vec::new(),
        }
    }
}

/// What this process has compiled, by arguments and text. Texts that include others are not kept.
static COMPILED: Mutex<BTreeMap<(String, String), Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Compiles a shader with the first compiler of its language that is installed: WESL to WGSL, others to SPIR-V.
pub(super) fn compile(
    path: &Path,
    text: &str,
    language: Language,
    shader: &PassShader,
) -> Result<Vec<u8>, FilterError> {
    let refuse = |line, reason| FilterError::Folder {
        path: path.to_owned(),
        line,
        reason,
    };
    let compilers = Compiler::list(language, shader);
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
    let key = (
        format!("{} {}", compiler.program, compiler.arguments.join(" ")),
        text.to_owned(),
    );
    let kept = || COMPILED.lock().unwrap_or_else(|broken| broken.into_inner());
    if let Some(module) = kept().get(&key) {
        return Ok(module.clone());
    }
    let module =
        run(compiler, path, text, language).map_err(|(line, reason)| refuse(line, reason))?;
    if !text.contains("#include") && !text.contains("import") {
        kept().insert(key, module.clone());
    }
    Ok(module)
}

fn is_installed(program: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let endings = ["", ".exe"];
    std::env::split_paths(&folders)
        .any(|folder| (endings.iter()).any(|end| folder.join(format!("{program}{end}")).is_file()))
}

/// Runs a compiler: on a copy of the text, or on a WESL file itself, whose imports lie beside it. An error has the line that the
/// compiler names.
fn run(
    compiler: &Compiler,
    path: &Path,
    text: &str,
    language: Language,
) -> Result<Vec<u8>, (Option<usize>, String)> {
    let program = compiler.program;
    let fail = |what: &str, error: std::io::Error| (None, format!("{program}: {what}: {error}"));
    let folder = tempfile::tempdir().map_err(|error| fail("no temporary folder", error))?;
    let absolute = std::path::absolute(path).map_err(|error| fail("no folder", error))?;
    let log = folder.path().join("log.txt");
    let (input, output) = match language {
        Language::Wesl => (absolute.clone(), folder.path().join("shader.wgsl")),
        _ => {
            let input = folder.path().join(format!("shader.{}", language.ending()));
            std::fs::write(&input, text)
                .map_err(|error| fail("its input cannot be written", error))?;
            (input, folder.path().join("module.spv"))
        }
    };
    let mut include = std::ffi::OsString::from("-I");
    include.push(absolute.parent().unwrap_or(Path::new(".")));
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
        .current_dir(folder.path())
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
        let (line, message) = find_error(&said, &input, path);
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
fn find_error(said: &str, input: &Path, path: &Path) -> (Option<usize>, String) {
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
        .map(|line| line.replace(&name, &path.display().to_string()));
    let lines: Vec<String> = lines.map(|line| escape_controls(&line)).collect();
    (line, lines.join("\n"))
}
