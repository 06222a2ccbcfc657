//! Tables of a comparison of two runs.

use judge::{Basis, Change, ChangeKind, MeanChange, RunComparison, SettingChange, rank_changes};
use metrics::Metric;
use report::ChangeCells;

use super::{Table, list_once};
use terminal::output::{Text, bad, count_text, doubtful, faint, good, push_wrapped};

/// Upper limit on changed cases in the table; `--json` and the page show all.
const CASES: usize = 12;

/// Makes the tables: settings, cases of only one run, means over scenes, changed cases, counts.
pub fn compare_table(compared: &RunComparison) -> Text {
    let mut text = Text::default();
    for setting in &compared.settings {
        push_wrapped(&mut text, 0, setting_line(setting));
    }
    let sides = [
        (&compared.only_in_first, &compared.runs[0]),
        (&compared.only_in_second, &compared.runs[1]),
    ];
    for (cases, run) in sides {
        if !cases.is_empty() {
            push_wrapped(&mut text, 0, format!("only in {run}:"));
            for case in cases {
                push_wrapped(&mut text, 2, case);
            }
        }
    }
    text += means_table(&compared.means);
    text += changes_table(&compared.changes);
    text + counts(&compared.changes)
}

fn setting_line(setting: &SettingChange) -> String {
    let [first, second] = [&setting.first, &setting.second].map(|value| match value.as_str() {
        "" => "none",
        value => value,
    });
    format!("{}: {first} -> {second}", setting.name)
}

/// Makes the table of means; one line names the filters that changed on no scene.
fn means_table(means: &[MeanChange]) -> Text {
    let mut table = change_table("mean over scenes");
    let mut filter = "";
    for mean in means.iter().filter(|mean| mean.kind != ChangeKind::Same) {
        if filter != mean.filter {
            filter = &mean.filter;
            let scenes = count_text(mean.scenes, "scene", "scenes");
            table.push_text(format!("{filter}, {scenes}"));
        }
        push_change(&mut table, mean.metric, mean.kind, mean.into());
    }
    let mut text = match filter {
        "" => Text::default(),
        _ => table.text(),
    };
    let mut same = list_once(means.iter().map(|mean| mean.filter.as_str()));
    same.retain(|filter| {
        let mut changes = means.iter().filter(|mean| mean.filter == *filter);
        changes.all(|mean| mean.kind == ChangeKind::Same)
    });
    if !same.is_empty() {
        let line = format!("nothing changed of: {}", same.join(", "));
        push_wrapped(&mut text, 0, line);
    }
    text
}

/// Makes the table of cases, largest changes first.
fn changes_table(changes: &[Change]) -> Text {
    let ranked = rank_changes(changes);
    if ranked.is_empty() {
        return Text::default();
    }
    let mut table = change_table("scene / filter");
    for (scene, filter) in ranked.iter().take(CASES) {
        table.push_text(format!("{scene} / {filter}"));
        let of_case =
            (changes.iter()).filter(|change| change.scene == **scene && change.filter == **filter);
        for change in of_case.filter(|change| change.kind.is_decided()) {
            push_change(&mut table, change.metric, change.kind, change.into());
        }
    }
    let mut text = Text::from("\n") + table.text();
    if ranked.len() > CASES {
        let more = ranked.len() - CASES;
        let note = format!("and {more} cases more: --json or --html show them\n");
        text += faint(&note);
    }
    text
}

fn change_table(title: &str) -> Table {
    Table::new(title, ["first", "second", "change", "95 % CI"]).with_words_in(3)
}

fn push_change(table: &mut Table, metric: Metric, kind: ChangeKind, cells: ChangeCells) {
    let change = match kind {
        ChangeKind::Better => good(&cells.change),
        ChangeKind::Worse => bad(&cells.change),
        _ => doubtful(&cells.change),
    };
    table.push(
        metric.name(),
        [
            cells.first.into(),
            cells.second.into(),
            change,
            cells.interval.into(),
        ],
    );
}

fn counts(changes: &[Change]) -> Text {
    let words: Vec<String> = (ChangeKind::OF_SCORES.iter())
        .map(|kind| {
            let count = changes.iter().filter(|change| change.kind == *kind).count();
            format!("{count} {}", kind.label())
        })
        .collect();
    let mut text = Text::from("\n");
    let line = format!("{} scores compared: {}", changes.len(), words.join(", "));
    push_wrapped(&mut text, 0, line);
    let by_floor = (changes.iter())
        .filter(|change| change.basis == Basis::Floor && change.kind != ChangeKind::Same)
        .count();
    if by_floor > 0 {
        let note = format!(
            "{by_floor} of them told from noise by their floors alone, which is coarse: the truths' replicates or the \
             pictures (output.exr) are not beside run.json"
        );
        push_wrapped(&mut text, 0, note);
    }
    text
}
