//! Packages of WESL: folders next to a shader, which `import bevy_pbr::render::utils;` names.
//!
//! The compiler knows no packages on a disk, but it knows the path `package::` of the shader's
//! folder. So the copies that it gets name a package by that path.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Rewrites the paths in all texts: of packages, and within a package of that package itself.
pub fn name_packages(base: &Path, texts: &mut BTreeMap<PathBuf, String>) {
    let package_of = |path: &Path| -> Option<String> {
        let below = path.strip_prefix(base).ok()?;
        let mut parts = below.components();
        let first = parts.next()?.as_os_str().to_str()?;
        parts.next().map(|_| first.to_owned())
    };
    let packages: BTreeSet<String> = texts.keys().filter_map(|path| package_of(path)).collect();
    for (path, text) in texts {
        let package = package_of(path);
        *text = rewrite(text, |word| match (&package, word) {
            (Some(package), "package") => Some(format!("package::{package}")),
            (_, word) if packages.contains(word) => Some(format!("package::{word}")),
            _ => None,
        });
    }
}

/// Replaces the first words of paths, `word` in `word::more`.
fn rewrite(text: &str, replace: impl Fn(&str) -> Option<String>) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut written = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_part) {
        let (before, word_on) = rest.split_at(start);
        let end = word_on.find(|c| !is_part(c)).unwrap_or(word_on.len());
        let (word, after) = word_on.split_at(end);
        written += before;
        let is_first = after.trim_start().starts_with("::") && !written.trim_end().ends_with("::");
        match replace(word).filter(|_| is_first) {
            Some(replaced) => written += &replaced,
            None => written += word,
        }
        rest = after;
    }
    written + rest
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::name_packages;

    #[test]
    fn a_package_is_a_folder_beside_the_shader() {
        let texts = [
            (
                "in/blur.wesl",
                "import bevy::render::utils;\nfn f() { bevy :: g(); a::bevy::h(); bevy; }",
            ),
            (
                "in/bevy/render/utils.wesl",
                "import package::maths::PI; import super::x;",
            ),
            ("in/bevy/maths.wesl", "const PI = 3;"),
        ];
        let mut texts = (texts.into_iter())
            .map(|(path, text)| (path.into(), text.to_owned()))
            .collect();
        name_packages(Path::new("in"), &mut texts);
        assert_eq!(
            texts[Path::new("in/blur.wesl")],
            "import package::bevy::render::utils;\nfn f() { package::bevy :: g(); a::bevy::h(); bevy; }"
        );
        assert_eq!(
            texts[Path::new("in/bevy/render/utils.wesl")],
            "import package::bevy::maths::PI; import super::x;"
        );
        assert_eq!(texts[Path::new("in/bevy/maths.wesl")], "const PI = 3;");
    }
}
