//! Tables of a comparison of two runs.

use judge::{
    Basis, Change, ChangeKind, MeanChange, RunComparison, SettingChange, rank_changes, score_change,
};
use metrics::Metric;
use report::ChangeCells;

use super::{Table, csv_number, csv_table, list_once};
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
    text += means_text(&compared.means);
    text += changes_text(&compared.changes);
    text + counts(&compared.changes)
}

fn setting_line(setting: &SettingChange) -> String {
    let [first, second] = [&setting.first, &setting.second].map(|value| match value.as_str() {
        "" => "none",
        value => value,
    });
    format!("{}: {first} -> {second}", setting.name)
}

/// Makes the tables of means and of changed cases as Markdown.
pub fn compare_markdown(compared: &RunComparison) -> String {
    let tables = [
        means_table(&compared.means),
        changes_table(&compared.changes),
    ];
    let tables: Vec<String> = tables
        .into_iter()
        .flatten()
        .map(|table| table.markdown())
        .collect();
    tables.join("\n")
}

/// Makes all changes as CSV.
pub fn compare_csv(compared: &RunComparison) -> String {
    let titles = "scene filter metric first second change low high verdict";
    let titles: Vec<&str> = titles.split(' ').collect();
    let rows = compared.changes.iter().map(|change| {
        let of_score = |worse: f64| Some(score_change(change.metric, worse));
        let mut ends = change
            .interval
            .map(|ends| ends.map(|end| score_change(change.metric, end)));
        if let Some(ends) = &mut ends {
            ends.sort_by(f64::total_cmp);
        }
        vec![
            change.scene.to_string(),
            change.filter.to_string(),
            change.metric.name(),
            csv_number(Some(change.estimates[0])),
            csv_number(Some(change.estimates[1])),
            csv_number(of_score(change.estimate())),
            csv_number(ends.map(|ends| ends[0])),
            csv_number(ends.map(|ends| ends[1])),
            change.kind.label().to_owned(),
        ]
    });
    csv_table(&titles, rows)
}

/// Makes the table of means; one line names the filters that changed on no scene.
fn means_text(means: &[MeanChange]) -> Text {
    let mut text = means_table(means).map_or(Text::default(), |table| table.text());
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

/// Makes the table of means that changed; none if none did.
fn means_table(means: &[MeanChange]) -> Option<Table> {
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
    (!filter.is_empty()).then_some(table)
}

/// Makes the table of cases, largest changes first.
fn changes_text(changes: &[Change]) -> Text {
    let Some(table) = changes_table(changes) else {
        return Text::default();
    };
    let mut text = Text::from("\n") + table.text();
    let ranked = rank_changes(changes);
    if ranked.len() > CASES {
        let more = ranked.len() - CASES;
        let note = format!("and {more} cases more: --csv, --json or --html show them\n");
        text += faint(&note);
    }
    text
}

/// Makes the table of the cases that changed most; none if none did.
fn changes_table(changes: &[Change]) -> Option<Table> {
    let ranked = rank_changes(changes);
    if ranked.is_empty() {
        return None;
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
    Some(table)
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
