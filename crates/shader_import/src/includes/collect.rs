//! Files that a compiler sees: a shader and what it includes or imports, all from the filter's
//! folder.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use super::directives::list_includes;
use super::plain_text::make_plain;
use crate::fault::FileFault;
use crate::glsl::{allow_includes, keep_section};
use crate::hlsl::{refuse_if_used, strip_root};
use crate::language::Language;
use crate::shader_file::{ShaderFile, Stage};
use crate::sources::{MAX_MODULE_BYTES, ReadFile, Sources};
use crate::wesl::name_packages;

/// Upper limit on files of one shader.
const MAX_FILES: usize = 256;

/// Upper limit on the depth of folders that are searched for modules.
const MAX_DEPTH: usize = 8;

/// Reads a shader of a filter's folder, with its `text`, and the files that it needs.
pub fn collect<'a>(
    folder: &'a Path,
    ShaderFile { path, stage, .. }: &ShaderFile,
    text: &str,
    language: Language,
    read_file: ReadFile,
) -> Result<Sources<'a>, FileFault> {
    let is_name = |part: &Component| matches!(part, Component::Normal(_));
    let shader: PathBuf = path.components().filter(is_name).collect();
    let base = folder_of(&shader).to_owned();
    let mut collector = Collector {
        stage: *stage,
        sources: Sources {
            folder,
            language,
            read_file,
            texts: BTreeMap::new(),
            shader: shader.clone(),
        },
    };
    let endings: &[&str] = match language {
        Language::Slang => &["slang"],
        Language::Wesl => &["wesl", "wgsl"],
        _ => &[],
    };
    if !endings.is_empty() {
        collector.add_modules(&base, endings, 0)?;
    }
    collector.sources.texts.insert(shader, text.to_owned());
    match language {
        Language::Wesl => name_packages(&base, &mut collector.sources.texts),
        _ => collector.resolve_all(&base)?,
    }
    Ok(collector.sources)
}

/// Sources, collected so far.
struct Collector<'a> {
    sources: Sources<'a>,
    stage: Stage,
}

impl Collector<'_> {
    /// Resolves what each file names, and adds new files, until there are none.
    fn resolve_all(&mut self, base: &Path) -> Result<(), FileFault> {
        let mut waiting: Vec<PathBuf> = self.sources.texts.keys().cloned().collect();
        while let Some(file) = waiting.pop() {
            let mut text = make_plain(&self.sources.texts[&file]);
            if self.sources.language == Language::Glsl {
                text = keep_section(&text, self.stage);
            }
            let (mut text, included) = self.resolve(&file, base, &text)?;
            if self.sources.language == Language::Glsl && !included.is_empty() {
                text = allow_includes(&text);
            }
            self.sources.texts.insert(file, text);
            for place in included {
                if !self.sources.texts.contains_key(&place) {
                    self.read(&place)?;
                    waiting.push(place);
                }
            }
        }
        Ok(())
    }

    /// Rewrites a plain text so that each `#include` names a copy as seen from the file itself:
    /// there every compiler looks first. Returns the files that it names, too.
    fn resolve(
        &self,
        file: &Path,
        base: &Path,
        text: &str,
    ) -> Result<(String, Vec<PathBuf>), FileFault> {
        let mut lines: Vec<String> = text.split('\n').map(str::to_owned).collect();
        let mut places = Vec::new();
        for include in list_includes(text) {
            let refuse = |reason: String| self.sources.fault(file, include.line, reason);
            let Some(path) = include.path.as_deref() else {
                return Err(refuse(
                    "#include names its file by a macro; allowed: the path itself, in quotes"
                        .into(),
                ));
            };
            let place = self
                .find(file, base, path, include.is_module)
                .map_err(refuse)?;
            let lead = place
                .as_ref()
                .map(|place| lead_from(folder_of(file), place));
            match (lead, include.is_module) {
                (Some(lead), false) => {
                    lines[include.line - 1] = format!("#include \"{lead}\"");
                }
                // A condition may leave it out.
                (None, false) => {
                    lines[include.line - 1] = refuse_if_used(path);
                }
                (Some(lead), true) => {
                    let quoted = format!("\"{path}\"");
                    let lead = if path.ends_with(".slang") {
                        &lead[..]
                    } else {
                        lead.trim_end_matches(".slang")
                    };
                    // The path may be in a line after the word.
                    let mut rest = lines.iter_mut().skip(include.line - 1);
                    if let Some(line) = rest.find(|line| line.contains(&quoted)) {
                        *line = line.replace(&quoted, &format!("\"{lead}\""));
                    }
                }
                (None, true) if path.contains("..") => {
                    return Err(refuse(format!(
                        "imports \"{path}\", which is no file of this filter"
                    )));
                }
                // A file of the program's copies, or no file.
                (None, true) => {}
            }
            places.extend(place);
        }
        Ok((lines.join("\n"), places))
    }

    fn leads_out(&self, path: &str) -> String {
        format!(
            "includes \"{path}\", which is outside the filter's folder {}; copy the file into the folder and name the copy",
            self.sources.folder.display()
        )
    }

    /// Finds a file next to the one that names it, or next to the shader; none if neither exists. A
    /// module's name may lack its ending.
    fn find(
        &self,
        by: &Path,
        base: &Path,
        path: &str,
        is_module: bool,
    ) -> Result<Option<PathBuf>, String> {
        let leads_out = || self.leads_out(path);
        let path = strip_root(path);
        let folder = folder_of(by);
        let ending = if is_module { ".slang" } else { "" };
        let named = format!("{path}{ending}");
        for (from, path) in [
            (folder, path),
            (folder, &named),
            (base, path),
            (base, &named),
        ] {
            let place = join(from, path).ok_or_else(leads_out)?;
            let candidate = self.sources.folder.join(&place);
            if candidate.is_file() {
                return if stays_below(self.sources.folder, &candidate) {
                    Ok(Some(place))
                } else {
                    Err(leads_out())
                };
            }
        }
        Ok(None)
    }

    /// Adds every file with one of these endings in a folder and those below it.
    fn add_modules(
        &mut self,
        below: &Path,
        endings: &[&str],
        depth: usize,
    ) -> Result<(), FileFault> {
        let path = self.sources.folder.join(below);
        let listed = std::fs::read_dir(&path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let mut entries = listed.map_err(|error| {
            self.sources
                .fault(below, None, format!("cannot be read: {error}"))
        })?;
        entries.sort_by_key(std::fs::DirEntry::file_name);
        for entry in entries {
            let name = below.join(entry.file_name());
            let (path, ending) = (
                entry.path(),
                name.extension().and_then(|extension| extension.to_str()),
            );
            let is_module = ending.is_some_and(|ending| endings.contains(&ending));
            if is_module && path.is_file() {
                if !stays_below(self.sources.folder, &path) {
                    return Err(self.sources.fault(
                        &name,
                        None,
                        "is a link to a file outside of the filter's folder; copy the file in its place",
                    ));
                }
                self.read(&name)?;
            } else if entry.file_type().is_ok_and(|kind| kind.is_dir()) && depth < MAX_DEPTH {
                self.add_modules(&name, endings, depth + 1)?;
            }
        }
        Ok(())
    }

    fn read(&mut self, place: &Path) -> Result<(), FileFault> {
        let bytes = (self.sources.read_file)(&self.sources.folder.join(place), MAX_MODULE_BYTES)
            .map_err(|reason| self.sources.fault(place, None, reason))?;
        let text = String::from_utf8(bytes).map_err(|_| {
            self.sources
                .fault(place, None, "is not UTF-8; save it as UTF-8")
        })?;
        self.sources.texts.insert(place.to_owned(), text);
        if self.sources.texts.len() > MAX_FILES {
            Err(self.sources.fault(
                place,
                None,
                format!(
                    "is one of more than {MAX_FILES} files of a shader in {}; leave files out that it does not need",
                    self.sources.language.name()
                ),
            ))
        } else {
            Ok(())
        }
    }
}

/// Joins a path as an include names it to a folder within the filter's; none if it leads out.
fn join(from: &Path, path: &str) -> Option<PathBuf> {
    let path = path.replace('\\', "/");
    if path.starts_with('/') || path.contains(':') {
        return None;
    }
    let mut joined = from.to_owned();
    for part in Path::new(&path).components() {
        match part {
            Component::Normal(name) => joined.push(name),
            Component::CurDir => {}
            Component::ParentDir if joined.pop() => {}
            _ => return None,
        }
    }
    Some(joined)
}

/// Returns the path from one folder to a file, both within the filter's folder.
fn lead_from(from: &Path, to: &Path) -> String {
    let shared = from.components().zip(to.components());
    let shared = shared.take_while(|(a, b)| a == b).count();
    let up = from.components().skip(shared).map(|_| "..".to_owned());
    let down = to.components().skip(shared);
    let down = down.map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

fn folder_of(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}

/// Returns true for a file that is in a folder once links are followed.
pub fn stays_below(folder: &Path, file: &Path) -> bool {
    match (folder.canonicalize(), file.canonicalize()) {
        (Ok(folder), Ok(file)) => file.starts_with(folder),
        _ => false,
    }
}
