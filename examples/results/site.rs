//! The source of the site, a book: every page and file that links lead to from the README, a page
//! per engine, and live cases.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use bench::Bench;
use frame::FileError;
use judge::Results;
use maud::html;
use measure::Error;

use super::page::site_pages;

/// Files of the book that are no pages.
const FILES: [(&str, &str); 4] = [
    ("book.toml", include_str!("site/book.toml")),
    ("site.css", include_str!("site/site.css")),
    ("tables.js", include_str!("site/tables.js")),
    (
        "sort.js",
        include_str!("../../crates/report/src/assets/sort.js"),
    ),
];

/// First line of the first page, below its first sentence.
const WAYS: &str = "**[Try filters in your browser](live/README.md) · [Results](results/README.md) · [Gallery](docs/gallery/README.md) · \
                    [Guides](docs/README.md)**";

/// Page of the live cases.
const LIVE: &str = "# Live cases

Choose a scene, then *Try it* below its pictures. Move a parameter, choose a preset or edit the shader: your graphics card runs the \
filter, and picture, FLIP map and scores follow. This needs a browser with WebGPU. [Read a report](../docs/reading-a-report.md) \
explains the rest of the page.
";

/// Files that a browser shows.
const PICTURES: [&str; 3] = ["png", "jpg", "svg"];

/// A book of Markdown.
pub struct Site {
    /// Texts of the pages by path from the top of the repository.
    pub pages: BTreeMap<String, String>,
    /// Pictures on them.
    pictures: BTreeSet<String>,
}

impl Site {
    /// Collects the pages of the repository at `top`; `scenes` have live cases.
    pub fn collect(top: &Path, scenes: &[&str]) -> Result<Self, Error> {
        let mut made = BTreeMap::from([("live/README.md".to_owned(), live_page(scenes))]);
        let results = top.join("results");
        let cards = Bench::read_all(&results.join("bench"))?;
        for (name, text) in site_pages(&Results::read_all(&results)?, &cards)? {
            made.insert(format!("results/{name}"), text);
        }
        let mut site = Self {
            pages: BTreeMap::new(),
            pictures: BTreeSet::new(),
        };
        let mut due: Vec<String> = made.keys().cloned().collect();
        due.push("README.md".to_owned());
        while let Some(path) = due.pop() {
            if site.pages.contains_key(&path) {
                continue;
            }
            let text = match made.get(&path) {
                Some(text) => text.clone(),
                None => read_page(top, &path)?,
            };
            let text = map_links(&text, |link| {
                let target = resolve(&path, link);
                let end = target.rsplit('.').next().unwrap_or_default();
                if made.contains_key(&target) || !top.join(&target).exists() {
                    link.to_owned()
                } else if PICTURES.contains(&end) {
                    site.pictures.insert(target);
                    link.to_owned()
                } else if end == "md" {
                    due.push(target);
                    link.to_owned()
                } else {
                    // Any other file, and a folder of files, has a page that shows it.
                    due.push(format!("{target}.md"));
                    format!("{}.md", link.trim_end_matches('/'))
                }
            });
            // Browsers complain about a language that the book's highlighter does not know.
            site.pages.insert(path, text.replace("```wgsl", "```c"));
        }
        let first = site.pages.get_mut("README.md").expect("it is a page");
        *first = first.replacen("\n\n|", &format!("\n\n{WAYS}\n\n|"), 1);
        let contents = site.contents();
        site.pages.insert("SUMMARY.md".to_owned(), contents);
        Ok(site)
    }

    /// Makes the table of contents: the groups of docs/README.md, and what they leave out.
    fn contents(&self) -> String {
        let mut listed = BTreeSet::from(["README.md".to_owned()]);
        let mut list = |paths: Vec<String>| -> String {
            let new = |path: &String| self.pages.contains_key(path) && listed.insert(path.clone());
            let paths: Vec<String> = paths.into_iter().filter(new).collect();
            paths.iter().map(|path| self.entry(path)).collect()
        };
        let below = |start: &str| -> Vec<String> {
            let all = self.pages.keys().filter(|path| path.starts_with(start));
            all.cloned().collect()
        };
        let one = |path: &str| vec![path.to_owned()];
        let results = [
            one("results/README.md"),
            below("results/engines/"),
            below("results/findings/"),
            below("results/changes/"),
        ];
        let look = [
            one("live/README.md"),
            results.concat(),
            one("docs/gallery/README.md"),
        ];
        let mut text = "# Contents\n\n[Shuttertruth](README.md)\n\n# Look\n\n".to_owned();
        text += &list(look.concat());
        let guides = "docs/README.md";
        for group in self.pages[guides]
            .split("\n\n")
            .filter(|part| part.starts_with("**"))
        {
            let mut paths = one(guides);
            map_links(group, |link| {
                paths.push(resolve(guides, link));
                link.to_owned()
            });
            let title = group.split("**").nth(1).unwrap_or_default();
            text += &format!("\n# {title}\n\n{}", list(paths));
        }
        text + "\n# More\n\n" + &list(below(""))
    }

    /// Makes the line of a page: its heading, with those of engines, findings and changes below
    /// results.
    fn entry(&self, path: &str) -> String {
        let parts = ["results/engines/", "results/findings/", "results/changes/"];
        let is_part = parts.iter().any(|start| path.starts_with(start));
        let title = self.pages[path].lines().next().unwrap_or_default();
        let title = title.trim_start_matches("# ");
        format!("{}- [{title}]({path})\n", if is_part { "  " } else { "" })
    }

    /// Writes the book's source to `folder`, from the repository at `top`.
    pub fn write(&self, top: &Path, folder: &Path) -> Result<(), Error> {
        let write = |path: &str, bytes: &[u8]| frame::write_atomically(&folder.join(path), bytes);
        for (name, text) in FILES {
            write(name, text.as_bytes())?;
        }
        for (path, text) in &self.pages {
            write(&format!("src/{path}"), text.as_bytes())?;
        }
        for path in &self.pictures {
            write(&format!("src/{path}"), &read(&top.join(path))?)?;
        }
        Ok(())
    }
}

/// Makes the page of the live cases, with a picture per scene.
fn live_page(scenes: &[&str]) -> String {
    let link = |scene: &&str| {
        let page = format!("report.html#{scene}/kino:default");
        format!("\n## [{scene}]({page})\n\n[![{scene}]({scene}.png)]({page})\n")
    };
    LIVE.to_owned() + &scenes.iter().map(link).collect::<String>()
}

/// Reads a page, or shows the file or the files of the folder that it is named after.
fn read_page(top: &Path, path: &str) -> Result<String, Error> {
    let shown = path.trim_end_matches(".md");
    let show = |name: &str| -> Result<String, Error> {
        let bytes = read(&top.join(name))?;
        let text = String::from_utf8(bytes).unwrap_or_else(|_| "not a text".to_owned());
        Ok(format!("\n{}\n", as_html(text.trim_end())))
    };
    if top.join(path).is_file() {
        let text = read(&top.join(path))?;
        return Ok(String::from_utf8_lossy(&text).into_owned());
    }
    let mut page = format!("# {shown}\n");
    if top.join(shown).is_file() {
        return Ok(page + &show(shown)?);
    }
    // Files of the project, and not what a script fetched next to them.
    let mut git = Command::new("git");
    let listed = git.current_dir(top).args(["ls-files", shown]).output();
    let listed = listed.map_err(|error| FileError::io(Path::new("git"), "run", error))?;
    for name in String::from_utf8_lossy(&listed.stdout).lines() {
        page += &format!("\n## {}\n{}", name[shown.len() + 1..].trim(), show(name)?);
    }
    Ok(page)
}

/// Shows a file's text. Markdown, links and the book's includes have no meaning in it.
pub fn as_html(text: &str) -> String {
    let shown = html! { pre { code."language-text" { (text) } } };
    let shown = shown.into_string().replace('{', "&#123;");
    shown.replace("](", "&#93;(")
}

/// Reads a file.
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    fs::read(path).map_err(|error| FileError::io(path, "read", error))
}

/// Changes the targets of `[words](target)`.
fn map_links(text: &str, mut change: impl FnMut(&str) -> String) -> String {
    let mut parts = text.split("](");
    let mut changed = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (target, rest) = part.split_once(')').unwrap_or((part, ""));
        changed += &format!("]({}){rest}", change(target));
    }
    changed
}

/// Resolves a link on a page to a path from the top of the repository, without the anchor.
fn resolve(page: &str, link: &str) -> String {
    let file = link.split('#').next().unwrap_or_default();
    if file.is_empty() {
        return page.to_owned();
    }
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop();
    for part in file.trim_end_matches('/').split('/') {
        match part {
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}
