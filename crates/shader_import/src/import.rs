//! A shader in any language, compiled and read as a module of naga.

use std::path::Path;

use naga::AddressSpace;

use crate::compile::{compile, list_installed};
use crate::compiler::Compiler;
use crate::fault::{FileFault, ImportError};
use crate::hlsl::cut_hlsl;
use crate::includes::collect;
use crate::language::{Language, SHADER_LAB};
use crate::open_module::{OpenModule, PUSH_CONSTANTS};
use crate::shader_file::{Pictures, ShaderFile, Stage};
use crate::sources::{ReadFile, Sources};
use crate::spirv::FindFormat;
use crate::{glsl, hlsl, spirv, wgsl};

/// A shader to import.
pub struct Import<'a> {
    /// What filter.toml says about it.
    pub shader: &'a ShaderFile,
    /// The filter's folder, which holds all that it includes.
    pub folder: &'a Path,
    /// Path of its file, for messages.
    pub path: &'a Path,
    /// Content of its file.
    pub bytes: &'a [u8],
    /// Pictures that it reads and writes.
    pub pictures: Pictures,
    /// Reader of the files that it includes.
    pub read_file: ReadFile,
}

impl<'a> Import<'a> {
    /// Lists the compilers of the shader that are installed, the best first; none for a language
    /// that needs no compiler.
    ///
    /// # Errors
    /// Its language is unknown, or no compiler of it is installed.
    pub fn list_installed(&self) -> Result<Vec<&'static Compiler>, FileFault> {
        let language = self.language()?;
        if language.compilers().is_empty() {
            return Ok(Vec::new());
        }
        list_installed(language, self.shader, self.path)
    }

    /// Compiles the shader to SPIR-V, or to WGSL if it is WESL. SPIR-V and WGSL stay as they are. A
    /// language that `compiler` does not support uses the first of its own.
    ///
    /// # Errors
    /// A file is missing or unfit, or the compiler refuses the shader.
    pub fn compile(&self, compiler: Option<&Compiler>) -> Result<Vec<u8>, ImportError> {
        let language = self.language()?;
        if language == Language::Spirv {
            return Ok(self.bytes.to_vec());
        }
        let text = self.text()?;
        if language == Language::Wgsl {
            return Ok(self.bytes.to_vec());
        }
        let installed = list_installed(language, self.shader, self.path)?;
        let is_known =
            |known: &&Compiler| compiler.is_some_and(|compiler| compiler.program == known.program);
        let compiler = installed.iter().copied().find(is_known);
        let compiler = compiler.unwrap_or(installed[0]);
        let sources = self.collect(&text)?;
        let foreign = match language {
            Language::Glsl => glsl::find_foreign(&sources, self.shader, self.pictures),
            Language::Hlsl => hlsl::find_foreign(&sources, self.shader),
            _ => None,
        };
        if let Some(fault) = foreign {
            return Err(fault.into());
        }
        compile(&sources, self.shader, compiler)
    }

    fn language(&self) -> Result<Language, FileFault> {
        Language::of_shader(self.shader, self.path)
    }

    /// Reads the text; of ShaderLab, only the HLSL of its pass.
    fn text(&self) -> Result<String, FileFault> {
        let text = std::str::from_utf8(self.bytes).map_err(|error| {
            let place = error.valid_up_to();
            let reason = format!("is not UTF-8 from byte {place} on; save it as UTF-8");
            FileFault::new(self.path, None, reason)
        })?;
        let ending = self.shader.path.extension();
        if ending.is_some_and(|ending| ending == SHADER_LAB) {
            cut_hlsl(text, self.shader.shader_pass.as_ref())
                .map_err(|reason| FileFault::new(self.path, None, reason))
        } else {
            Ok(text.to_owned())
        }
    }

    fn collect(&self, text: &str) -> Result<Sources<'a>, FileFault> {
        collect(
            self.folder,
            self.shader,
            text,
            self.language()?,
            self.read_file,
        )
    }
}

/// A macro or a condition that no text of a shader names.
pub struct IdleName {
    /// Key of filter.toml.
    pub key: &'static str,
    /// The name.
    pub name: String,
}

/// Finds a macro or a condition of the first stage that none of a pass's stages names.
///
/// # Errors
/// A file is missing or unfit.
pub fn find_idle_name(stages: &[Import]) -> Result<Option<IdleName>, FileFault> {
    let shader = stages[0].shader;
    let macros = shader.defines.iter().map(|define| {
        let (name, _) = define.split_once('=').expect("a macro has a value");
        ("defines", name)
    });
    let conditions = shader
        .conditions
        .iter()
        .map(|name| ("conditions", &name[..]));
    let mut idle: Vec<(&str, &str)> = macros.chain(conditions).collect();
    if idle.is_empty() {
        return Ok(None);
    }
    for stage in stages {
        for text in stage.collect(&stage.text()?)?.texts.values() {
            // Names may be made of parts.
            idle.retain(|(_, name)| !text.contains("##") && !has_word(text, name));
        }
    }
    Ok(idle.first().map(|(key, name)| IdleName {
        key,
        name: (*name).to_owned(),
    }))
}

/// Returns true if a text holds a name as a whole word.
fn has_word(text: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.split(|c| !is_part(c)).any(|word| word == name)
}

/// Reads a compiled shader. `constants` are values of specialisation constants, by name or number,
/// which SPIR-V gets here.
///
/// # Errors
/// naga refuses it, or would change what it does.
pub fn read(
    shader: &ShaderFile,
    path: &Path,
    compiled: &[u8],
    constants: &[(String, f64)],
    find_format: &FindFormat,
) -> Result<OpenModule, FileFault> {
    let wgsl = || {
        Ok::<_, FileFault>(OpenModule {
            module: wgsl::read(path, &String::from_utf8_lossy(compiled))?,
            ..OpenModule::default()
        })
    };
    let mut open = match Language::of_shader(shader, path)? {
        Language::Wgsl => wgsl()?,
        Language::Wesl => wgsl().map_err(|fault| in_compiled(path, &fault))?,
        language => {
            let is_vertex = shader.stage == Stage::Vertex;
            spirv::read(compiled, language, is_vertex, constants, find_format)
                .map_err(|reason| FileFault::new(path, None, reason))?
        }
    };
    for (_, variable) in open.module.global_variables.iter_mut() {
        if variable.space == AddressSpace::Immediate {
            variable.space = AddressSpace::Uniform;
            variable.binding = Some(PUSH_CONSTANTS);
        }
    }
    Ok(open)
}

/// Explains a fault in WGSL made from WESL, which has other lines than the file.
fn in_compiled(path: &Path, fault: &FileFault) -> FileFault {
    let reason = format!("after its imports and conditions: {}", fault.reason);
    FileFault::new(path, None, reason)
}
