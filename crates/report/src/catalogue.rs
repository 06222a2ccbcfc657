//! The scenes in pictures, as a page of Markdown beside a run's files.

use std::fmt::Write;

use suite::{Case, Run};

/// One section per scene: what it exposes, the instant, the velocity, and per filter the truth, the output and the error.
pub fn catalogue(run: &Run) -> String {
    let mut page = format!(
        "# Scenes\n\n{}x{} pixels, {} samples per pixel. Velocity: the direction as hue, the speed as brightness. Error: LDR-FLIP, black \
         is none. FLIP in the text is its mean where anything moves.\n\nMade by `{}`.\n",
        run.width,
        run.height,
        run.samples_per_pixel,
        command(run),
    );
    let of_filters: Vec<&Case> = run.cases.iter().filter(|case| !case.is_reference).collect();
    for cases in of_filters.chunk_by(|a, b| a.scene == b.scene) {
        page += &section(cases);
    }
    page
}

fn section(cases: &[&Case]) -> String {
    let first = cases[0];
    let scene = &first.scene;
    let mut text = format!(
        "\n## {scene}\n\n{} Family: {}; exposure: {} frames.\n\n| the instant | its velocity |\n|---|---|\n| {} | {} |\n",
        first.exposes,
        first.family.name(),
        first.exposure,
        picture("the instant", &format!("{scene}/frame.png")),
        picture("velocity", &format!("{scene}/velocity.png")),
    );
    for case in cases {
        let folder = case.folder.to_string_lossy().replace('\\', "/");
        let flip = match case.scores.moving.flip.value() {
            Some(value) => format!("{value:.3}"),
            None => "-".to_owned(),
        };
        write!(
            text,
            "\n| the truth ({alignment}) | {name}, FLIP {flip} | its error |\n|---|---|---|\n| {truth} | {output} | {error} |\n",
            alignment = case.alignment,
            name = case.name(),
            truth = picture("the truth", &format!("{scene}/truth_{}.png", case.alignment)),
            output = picture("the output", &format!("{folder}/output.png")),
            error = picture("the error", &format!("{folder}/flip.png")),
        )
        .expect("text takes text");
    }
    text
}

/// Names of scenes may hold an `@`, which Markdown leaves alone, and no spaces.
fn picture(what: &str, path: &str) -> String {
    format!("![{what}]({path})")
}

/// The words of the command line, the program's by its name alone.
fn command(run: &Run) -> String {
    let words = run.command.iter().skip(1).map(String::as_str);
    let words: Vec<&str> = std::iter::once("shuttertruth").chain(words).collect();
    words.join(" ")
}
