//! Tables of a finished run: the score of a filter, and its survivors.

use std::collections::BTreeMap;
use std::fmt::Write;

use judge::number;
use tests::mutants::Operator;

use crate::bench::Bench;
use crate::limits::Limits;
use crate::subject::Subject;
use crate::verdict::{NOTICEABLE, Reason, Size, Verdict};

/// Formats the score of one filter, and its survivors.
pub fn format_subject(
    bench: &Bench,
    subject: &Subject,
    limits: &Limits,
    verdicts: &[Verdict],
) -> String {
    let mut text = String::new();
    let render = &bench.render;
    let shipped = limits.values().filter(|limits| limits.are_shipped).count();
    let _ = writeln!(
        text,
        "{} at {}x{}, {} samples per pixel: {} scenes, shipped limits on {shipped}, calibrated ones on {}\n",
        subject.name,
        render.width,
        render.height,
        render.samples_per_pixel,
        limits.len(),
        limits.len() - shipped,
    );
    text += &format_counts(verdicts);
    text += &format_score(verdicts);
    text += &format_survivors(subject, verdicts);
    text + "\n"
}

/// Formats the counts and the score of all filters together.
pub fn format_total(verdicts: &[Verdict]) -> String {
    format!(
        "all filters\n\n{}{}",
        format_counts(verdicts),
        format_score(verdicts)
    )
}

/// Formats killed mutants and all of them, by operator and by the size of the change.
fn format_counts(verdicts: &[Verdict]) -> String {
    let mut text = format!(
        "{:12} {:>8} {:>10} {:>10} {:>10} {:>10} {:>10}\n",
        "killed of", "mutants", "no picture", "same", "below 1", "1 to 3", "above 3"
    );
    let groups = (Operator::ALL.into_iter())
        .map(|operator| (operator.name(), Some(operator)))
        .chain([("all", None)]);
    for (name, operator) in groups {
        let own: Vec<&Verdict> = (verdicts.iter())
            .filter(|verdict| operator.is_none_or(|own| own == verdict.mutant.mutant.operator))
            .collect();
        let failed = own
            .iter()
            .filter(|verdict| verdict.failure.is_some())
            .count();
        let _ = write!(text, "{name:12} {:>8} {failed:>10}", own.len());
        for size in Size::ALL {
            let [killed, all] = count(&own, size);
            let cell = match (size, all) {
                (_, 0) => "-".to_owned(),
                (Size::None, _) => all.to_string(),
                _ => format!("{killed}/{all}"),
            };
            let _ = write!(text, " {cell:>10}");
        }
        text += "\n";
    }
    text
}

/// Counts the killed mutants with a change of that size, and all.
fn count(verdicts: &[&Verdict], size: Size) -> [usize; 2] {
    let own = || {
        let decided = verdicts.iter().filter(|verdict| verdict.is_decided);
        decided.filter(move |verdict| verdict.failure.is_none() && verdict.size() == Some(size))
    };
    [
        own().filter(|verdict| verdict.killed.is_some()).count(),
        own().count(),
    ]
}

fn format_score(verdicts: &[Verdict]) -> String {
    let all: Vec<&Verdict> = verdicts.iter().collect();
    let [killed, noticeable] = count(&all, Size::Noticeable);
    let mut text = match noticeable {
        0 => "\nscore: no mutant changes the picture by more than three noise floors\n".to_owned(),
        _ => format!(
            "\nscore: {killed} of {noticeable} mutants that change the picture by more than {NOTICEABLE} noise floors are killed \
             ({:.1} %)\n",
            100.0 * killed as f64 / noticeable as f64
        ),
    };
    let open = verdicts
        .iter()
        .filter(|verdict| !verdict.is_decided)
        .count();
    if open > 0 {
        let _ = writeln!(
            text,
            "{open} mutants are not counted, because the time ended before every scene was tried"
        );
    }
    text
}

/// Lists the survivors, those with the largest change first.
fn format_survivors(subject: &Subject, verdicts: &[Verdict]) -> String {
    let mut survivors: Vec<&Verdict> = (verdicts.iter())
        .filter(|verdict| verdict.failure.is_none() && verdict.killed.is_none())
        .filter(|verdict| verdict.is_decided)
        .collect();
    survivors.sort_by(|a, b| {
        let floors = |verdict: &Verdict| {
            verdict
                .change
                .as_ref()
                .map_or(0.0, |(change, _)| change.floors)
        };
        floors(b).total_cmp(&floors(a))
    });
    let mut text = String::new();
    for reason in Reason::ALL {
        let own: Vec<&&Verdict> = (survivors.iter())
            .filter(|verdict| verdict.reason() == Some(reason))
            .collect();
        if !own.is_empty() {
            let _ = writeln!(text, "\n{}", reason.title());
            text.extend(own.iter().map(|verdict| format_survivor(subject, verdict)));
        }
    }
    text
}

fn format_survivor(subject: &Subject, verdict: &Verdict) -> String {
    let mutant = &verdict.mutant;
    let mut text = format!("  {}:{}\n", subject.file, mutant.name);
    let _ = writeln!(text, "      {}", mutant.mutant.line(&subject.kernels));
    if let Some((change, scene)) = &verdict.change
        && change.share > 0.0
    {
        let error = verdict
            .error
            .map(|error| format!(", {error:.3} times the squared error"));
        let _ = writeln!(
            text,
            "      {} noise floors on {scene}, {:.2} % of the pixels{}",
            number(change.floors),
            100.0 * change.share,
            error.unwrap_or_default()
        );
    }
    let mut by_metric: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (metric, scene) in &verdict.noticed_by {
        by_metric.entry(metric).or_default().push(scene.to_string());
    }
    if !by_metric.is_empty() {
        let noticed = by_metric
            .iter()
            .map(|(metric, scenes)| format!("{metric} on {}", scenes.join(", ")));
        let _ = writeln!(
            text,
            "      calibrated limits would notice: {}",
            noticed.collect::<Vec<_>>().join("; ")
        );
    }
    text
}
