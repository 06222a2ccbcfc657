//! Tables of a finished run: the score of a filter, and its survivors.

use std::collections::BTreeMap;

use judge::number;
use tests::mutants::Operator;

use crate::study::Study;
use crate::subject::Subject;
use crate::verdict::{NOTICEABLE, Reason, SIZES, Verdict};

pub fn format_subject(study: &Study, verdicts: &[Verdict]) -> String {
    let (subject, render, limits) = (study.subject, &study.bench.render, &study.limits);
    let shipped = limits.values().filter(|limits| limits.are_shipped).count();
    format!(
        "{} at {}x{}, {} samples per pixel: {} scenes, shipped limits on {shipped}, calibrated ones on {}\n\n{}{}{}\n",
        subject.name,
        render.width,
        render.height,
        render.samples_per_pixel,
        limits.len(),
        limits.len() - shipped,
        format_counts(verdicts),
        format_score(verdicts),
        format_survivors(subject, verdicts),
    )
}

pub fn format_total(verdicts: &[Verdict]) -> String {
    format!(
        "all filters\n\n{}{}",
        format_counts(verdicts),
        format_score(verdicts)
    )
}

/// Formats the numbers of killed and of all mutants, by operator and by the size of the change.
fn format_counts(verdicts: &[Verdict]) -> String {
    let mut text = format!("{:12} {:>8} {:>10}", "killed of", "mutants", "no picture");
    text.extend(SIZES.map(|size| format!(" {size:>10}")));
    let groups = (Operator::ALL.into_iter())
        .map(|operator| (operator.name(), Some(operator)))
        .chain([("all", None)]);
    for (name, operator) in groups {
        let of_group = |verdict: &&Verdict| {
            operator.is_none_or(|operator| operator == verdict.mutant.mutant.operator)
        };
        let own: Vec<&Verdict> = verdicts.iter().filter(of_group).collect();
        let failed = own.iter().filter(|it| it.failure.is_some()).count();
        text += &format!("\n{name:12} {:>8} {failed:>10}", own.len());
        for size in SIZES {
            let cell = match (size, count(&own, size)) {
                (_, [_, 0]) => "-".to_owned(),
                ("same", [_, all]) => all.to_string(),
                (_, [killed, all]) => format!("{killed}/{all}"),
            };
            text += &format!(" {cell:>10}");
        }
    }
    text + "\n"
}

fn count(verdicts: &[&Verdict], size: &str) -> [usize; 2] {
    let own = || {
        let decided = (verdicts.iter()).filter(|it| it.is_decided && it.failure.is_none());
        decided.filter(|it| it.reason().is_some_and(|reason| reason.names()[0] == size))
    };
    [
        own().filter(|verdict| verdict.killed.is_some()).count(),
        own().count(),
    ]
}

fn format_score(verdicts: &[Verdict]) -> String {
    let all: Vec<&Verdict> = verdicts.iter().collect();
    let [killed, noticeable] = count(&all, SIZES[3]);
    let mut text = match noticeable {
        0 => "\nscore: no mutant changes the picture by more than three noise floors\n".to_owned(),
        _ => format!(
            "\nscore: {killed} of {noticeable} mutants that change the picture by more than {NOTICEABLE} noise floors are killed \
             ({:.1} %)\n",
            100.0 * killed as f64 / noticeable as f64
        ),
    };
    let open = verdicts.iter().filter(|it| !it.is_decided).count();
    if open > 0 {
        text += &format!(
            "{open} mutants are not counted, because the time ended before every scene was tried\n"
        );
    }
    text
}

/// Lists the survivors, largest change first.
fn format_survivors(subject: &Subject, verdicts: &[Verdict]) -> String {
    let mut survivors: Vec<&Verdict> = (verdicts.iter())
        .filter(|it| it.failure.is_none() && it.killed.is_none() && it.is_decided)
        .collect();
    let floors = |it: &Verdict| it.change.as_ref().map_or(0.0, |(change, _)| change.floors);
    survivors.sort_by(|a, b| floors(b).total_cmp(&floors(a)));
    let mut text = String::new();
    for reason in Reason::ALL {
        let own = survivors.iter().filter(|it| it.reason() == Some(reason));
        let own: Vec<String> = own.map(|it| format_survivor(subject, it)).collect();
        if !own.is_empty() {
            text += &format!("\n{}\n{}", reason.names()[1], own.concat());
        }
    }
    text
}

fn format_survivor(subject: &Subject, verdict: &Verdict) -> String {
    let mutant = &verdict.mutant;
    let line = mutant.mutant.line(&subject.kernels);
    let mut text = format!("  {}:{}\n      {line}\n", subject.file, mutant.name);
    if let Some((change, scene)) = &verdict.change
        && change.share > 0.0
    {
        let error = (verdict.error).map(|error| format!(", {error:.3} times the squared error"));
        text += &format!(
            "      {} noise floors on {scene}, {:.2} % of the pixels{}\n",
            number(change.floors),
            100.0 * change.share,
            error.unwrap_or_default()
        );
    }
    let mut by_metric: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (metric, scene) in &verdict.noticed_by {
        by_metric.entry(metric).or_default().push(scene.to_string());
    }
    let noticed = (by_metric.iter()).map(|(metric, on)| format!("{metric} on {}", on.join(", ")));
    let noticed = noticed.collect::<Vec<_>>().join("; ");
    if !noticed.is_empty() {
        text += &format!("      calibrated limits would notice: {noticed}\n");
    }
    text
}
