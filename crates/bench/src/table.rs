//! Tables of a bench.

use terminal::output::{Text, push_wrapped};
use terminal::table::{Table, cell, csv_number, csv_table};

use crate::{BASELINE, Bench, CaseCost, GROWTH_FROM, REACHES, Spread};

/// Makes the tables: cost per filter and pass, then cost against blur length.
pub fn bench_table(bench: &Bench) -> Text {
    let about = format!(
        "{} ({}), {}x{}, median (quartiles) of {} rounds by {}",
        bench.adapter.name,
        bench.adapter.backend,
        bench.width,
        bench.height,
        bench.rounds,
        bench.clock_text()
    );
    let mut text = Text::default();
    push_wrapped(&mut text, 0, about);
    text += "\n";
    push_costs(&mut text, bench);
    push_reaches(&mut text, bench);
    text
}

/// Makes the table of costs as Markdown.
pub fn bench_markdown(bench: &Bench) -> String {
    cost_table(bench).markdown()
}

/// Makes all times as CSV: a row per filter, with an empty pass, and one per pass of it.
pub fn bench_csv(bench: &Bench) -> String {
    let titles = "filter pass milliseconds lower_quartile upper_quartile bytes_per_pixel";
    let titles: Vec<&str> = titles.split(' ').collect();
    let row = |filter: &str, pass: &str, seconds: &Spread, bytes: Option<f64>| {
        let times = [
            seconds.median,
            seconds.lower_quartile,
            seconds.upper_quartile,
        ];
        let times = times.map(|time| csv_number(Some(1e3 * time)));
        let mut row = vec![filter.to_owned(), pass.to_owned()];
        row.extend(times);
        row.push(csv_number(bytes));
        row
    };
    let rows = bench.cases.iter().flat_map(|case| {
        let filter = format!("{}:{}", case.filter, case.preset);
        let whole = row(&filter, "", &case.seconds, case.bytes_per_pixel);
        let passes = (case.passes.iter())
            .map(|pass| row(&filter, &pass.entry, &pass.seconds, pass.bytes_per_pixel));
        let passes: Vec<Vec<String>> = passes.collect();
        std::iter::once(whole).chain(passes)
    });
    csv_table(&titles, rows)
}

fn push_costs(text: &mut Text, bench: &Bench) {
    *text += format!("{}\n", bench.frame_text());
    *text += cost_table(bench).text() + "\n";
    let legend = format!(
        "baseline: {BASELINE}. B/px: every texture that a pass reads or writes, counted once per pass. of copy: those bytes per \
         second, as a part of what copying a buffer reached."
    );
    push_wrapped(text, 0, legend);
    *text += "\n";
}

fn cost_table(bench: &Bench) -> Table {
    let mut table = Table::new("filter / pass", ["ms", "x baseline", "B/px", "of copy"]);
    for case in &bench.cases {
        let cells = [
            spread_text(&case.seconds, 1e3),
            cell(case.ratio.as_ref(), |ratio| spread_text(ratio, 1.0)),
            cell(case.bytes_per_pixel, |bytes| format!("{bytes:.0}")),
            cell(case.part_of_copy, |part| format!("{:.0}%", 100.0 * part)),
        ];
        table.push(format!("{}:{}", case.filter, case.preset), cells);
        push_passes(&mut table, case);
    }
    if let Some(copy) = &bench.copy {
        let speed = format!("{:.1} GB/s", copy.bytes_per_second * 1e-9);
        let none = String::new;
        let cells = [spread_text(&copy.seconds, 1e3), none(), none(), speed];
        table.push("copy of a buffer", cells);
    }
    table
}

fn push_passes(table: &mut Table, case: &CaseCost) {
    for pass in &case.passes {
        let times = match pass.iterations {
            1 => String::new(),
            iterations => format!(" x {iterations}"),
        };
        let time = spread_text(&pass.seconds, 1e3);
        let bytes = cell(pass.bytes_per_pixel, |bytes| format!("{bytes:.0}"));
        let name = format!("  {}{times}", pass.entry);
        table.push(name, [time, String::new(), bytes, String::new()]);
    }
}

fn push_reaches(text: &mut Text, bench: &Bench) {
    let last = REACHES[REACHES.len() - 1];
    let reaches = REACHES.iter().map(u32::to_string);
    let growth = format!("{last} / {GROWTH_FROM}");
    let mut table = Table::new("ms at a reach of (pixels)", reaches.chain([growth]));
    for cost in &bench.reaches {
        let times = cost.points.iter().map(|point| {
            cell(point.seconds.as_ref(), |seconds| {
                let digits = if seconds.median < 0.1 { 2 } else { 0 };
                format!("{:.digits$}", 1e3 * seconds.median)
            })
        });
        let growth = cell(cost.growth.as_ref(), |growth| spread_text(growth, 1.0));
        table.push(
            format!("{}:{}", cost.filter, cost.preset),
            times.chain([growth]),
        );
    }
    *text += table.text();
}

fn spread_text(spread: &Spread, factor: f64) -> String {
    let [median, lower, upper] =
        [spread.median, spread.lower_quartile, spread.upper_quartile].map(|value| value * factor);
    let digits = if median < 10.0 { 2 } else { 1 };
    format!("{median:.digits$} ({lower:.digits$}-{upper:.digits$})")
}
