//! Tables of a bench.

use std::fmt::Write;

use filters::Clock;

use crate::output::wrap::push_wrapped;
use suite::{BASELINE, Bench, CaseCost, GROWTH_FROM, REACHES, ReachCost, Spread};

/// Makes the tables: cost per filter and pass, then cost against reach.
pub fn bench_table(bench: &Bench) -> String {
    let clock = match bench.clock {
        Clock::Timestamps => "the GPU's own clock",
        Clock::WallClock => "wall clock around each pass: the adapter has no timestamps",
    };
    let about = format!(
        "{} ({}), {}x{}, median (quartiles) of {} rounds by {clock}",
        bench.adapter.name, bench.adapter.backend, bench.width, bench.height, bench.rounds
    );
    let mut text = String::new();
    push_wrapped(&mut text, 0, &about);
    text += "\n";
    push_costs(&mut text, bench);
    push_reaches(&mut text, bench);
    text
}

fn push_costs(text: &mut String, bench: &Bench) {
    let _ = writeln!(
        text,
        "panels that move {} pixels\n{:<28}{:>20}{:>18}{:>6}{:>8}",
        bench.speed, "filter / pass", "ms", "x baseline", "B/px", "of copy"
    );
    for case in &bench.cases {
        let _ = writeln!(
            text,
            "{:<28}{:>20}{:>18}{:>6.0}{:>7.0}%",
            filter_name(&case.filter, &case.preset),
            spread_text(&case.seconds, 1e3),
            spread_text(&case.ratio, 1.0),
            case.bytes_per_pixel,
            100.0 * case.part_of_copy
        );
        push_passes(text, case);
    }
    let _ = writeln!(
        text,
        "{:<28}{:>20}{:>18}{:>9.1} GB/s\n\nbaseline: {BASELINE}. B/px: every texture that a pass reads or writes, \
         counted once\nper pass. of copy: those bytes per second, as a part of what copying a buffer\nreached.\n",
        "copy of a buffer",
        spread_text(&bench.copy.seconds, 1e3),
        "",
        bench.copy.bytes_per_second * 1e-9
    );
}

fn push_passes(text: &mut String, case: &CaseCost) {
    for pass in &case.passes {
        let times = match pass.iterations {
            1 => String::new(),
            iterations => format!(" x {iterations}"),
        };
        let _ = writeln!(
            text,
            "{:<28}{:>20}{:>18}{:>6.0}",
            format!("  {}{times}", pass.entry),
            spread_text(&pass.seconds, 1e3),
            "",
            pass.bytes_per_pixel
        );
    }
}

fn push_reaches(text: &mut String, bench: &Bench) {
    let _ = write!(text, "{:<27}", "ms at a reach of (pixels)");
    for pixels in REACHES {
        let _ = write!(text, "{pixels:>6}");
    }
    let last = REACHES[REACHES.len() - 1];
    let _ = writeln!(text, "{:>17}", format!("{last} / {GROWTH_FROM}"));
    for cost in &bench.reaches {
        push_reach(text, cost);
    }
}

fn push_reach(text: &mut String, cost: &ReachCost) {
    let _ = write!(text, "{:<27}", filter_name(&cost.filter, &cost.preset));
    for point in &cost.points {
        let cell = match &point.seconds {
            Some(seconds) if seconds.median < 0.1 => format!("{:.2}", 1e3 * seconds.median),
            Some(seconds) => format!("{:.0}", 1e3 * seconds.median),
            None => "n/a".to_owned(),
        };
        let _ = write!(text, "{cell:>6}");
    }
    let growth = match &cost.growth {
        Some(growth) => spread_text(growth, 1.0),
        None => "n/a".to_owned(),
    };
    let _ = writeln!(text, "{growth:>17}");
}

fn filter_name(filter: &str, preset: &str) -> String {
    format!("{filter}:{preset}")
}

fn spread_text(spread: &Spread, factor: f64) -> String {
    let [median, lower, upper] =
        [spread.median, spread.lower_quartile, spread.upper_quartile].map(|value| value * factor);
    let digits = if median < 10.0 { 2 } else { 1 };
    format!("{median:.digits$} ({lower:.digits$}-{upper:.digits$})")
}
