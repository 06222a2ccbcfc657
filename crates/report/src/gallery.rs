//! Gallery of a run: a page of Markdown that shows instant, truth, best and worst filter of every scene.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use frame::{read_bounded, write_atomically};

use crate::filter_id::list_scenes;
use suite::{Case, Error, Headline, Run};

/// Largest picture that is copied, in bytes.
const MOST_BYTES: u64 = 1 << 28;

/// A gallery before it is written.
pub struct Gallery {
    /// README.md of the gallery.
    pub page: String,
    /// Pictures: the name in the gallery, and the file that it is copied from.
    pub pictures: Vec<(String, PathBuf)>,
}

/// Makes the gallery of a run whose files lie below `folder`.
pub fn gallery(run: &Run, folder: &Path) -> Gallery {
    let mut pictures = Vec::new();
    let sections: Vec<String> = (list_scenes(run).into_iter())
        .map(|scene| section(run, scene, folder, &mut pictures))
        .collect();
    let truths: Vec<String> = (pictures.iter())
        .filter(|(name, _)| name.ends_with("_truth.png"))
        .map(|(name, _)| format!("![truth]({name})"))
        .collect();
    let page = format!(
        "# Scenes\n\n{}x{} pixels, {} samples per pixel. FLIP is the visible difference from the truth where anything moves; low is \
         good.\n\n{}\n{}",
        run.width,
        run.height,
        run.samples_per_pixel,
        truths.join(" "),
        sections.concat()
    );
    Gallery { page, pictures }
}

impl Gallery {
    /// Copies the pictures into a folder, and writes the page; returns the page's path.
    pub fn write(&self, folder: &Path) -> Result<PathBuf, Error> {
        for (name, source) in &self.pictures {
            let bytes = read_bounded(source, MOST_BYTES)?;
            write_atomically(&folder.join(name), &bytes)?;
        }
        let page = folder.join("README.md");
        write_atomically(&page, self.page.as_bytes())?;
        Ok(page)
    }
}

/// Writes a scene, and notes its pictures.
fn section(run: &Run, scene: &str, folder: &Path, pictures: &mut Vec<(String, PathBuf)>) -> String {
    let mut filters: Vec<(&Case, f64)> = (run.cases.iter())
        .filter(|case| case.scene == scene && !case.bar)
        .filter_map(|case| Some((case, Headline::FLIP.measured(case).value()?)))
        .collect();
    filters.sort_by(|a, b| a.1.total_cmp(&b.1));
    let Some(&(best, error)) = filters.first() else {
        return String::new();
    };
    // Two shutters do not compare.
    let is_rival = |own: &&(&Case, f64)| own.0.alignment == best.alignment;
    let worst = filters.iter().rfind(is_rival);
    let worst = worst.filter(|own| own.0.name() != best.name());
    let own = folder.join(scene);
    let truth = own.join(format!("truth_{}.png", best.alignment));
    let output = |case: &Case| folder.join(&case.folder).join("output.png");
    let mut columns = vec![
        ("instant", "the instant".to_owned(), own.join("frame.png")),
        ("truth", format!("truth, {} shutter", best.alignment), truth),
        (
            "best",
            format!("best: {}, FLIP {error:.3}", best.name()),
            output(best),
        ),
    ];
    columns.extend(worst.map(|(case, error)| {
        (
            "worst",
            format!("worst: {}, FLIP {error:.3}", case.name()),
            output(case),
        )
    }));
    let mut text = format!("\n## {scene}\n\n{}\n\n", best.exposes);
    let titles: Vec<&str> = columns.iter().map(|(_, title, _)| title.as_str()).collect();
    let names: Vec<String> = (columns.iter())
        .map(|(name, title, _)| format!("![{title}]({scene}_{name}.png)"))
        .collect();
    let rule = "---|".repeat(columns.len());
    writeln!(
        text,
        "| {} |\n|{rule}\n| {} |",
        titles.join(" | "),
        names.join(" | ")
    )
    .expect("text takes text");
    let copies = columns.into_iter();
    pictures.extend(copies.map(|(name, _, file)| (format!("{scene}_{name}.png"), file)));
    text
}
