//! Summary of a run: the ranking of its filters, and the references.

use frame::Alignment;
use judge::{
    MAX_RANKED, RANK_RULE, RankedFilter, SIDE_EFFECTS_RULE, few_scenes_text, inseparable_text,
    list_summarized, mean_lag, no_gain_text, rank_for_summary,
};
use measure::{Case, ReferencePicture, Run};
use metrics::Metric;
use scene::FrameRate;

use terminal::output::{Text, push_wrapped};

use super::{
    Table, frame_rates_text, input_forms_text, legend_text, list_once, mean_text, range_text,
    twins_text,
};

/// Makes the summary of cases, in at most 40 lines: filters ranked within each shutter, then
/// references.
pub fn ranking_text(run: &Run) -> Text {
    let cases = &run.cases;
    let mut groups = rank_for_summary(cases);
    if groups.is_empty() {
        return "no filter has a FLIP score: nothing moves in these scenes\n".into();
    }
    let presets: Vec<usize> = groups.iter().flatten().map(|row| row.presets).collect();
    let rows = ranked(&groups).count();
    if rows > MAX_RANKED {
        let each = (MAX_RANKED / groups.len()).max(1);
        groups.iter_mut().for_each(|group| shorten(group, each));
    }
    let hidden = rows - ranked(&groups).count();
    let mut text = Text::default();
    for group in &groups {
        if let Some(no_gain) = no_gain_text(group) {
            let shutter = shutter_text(group[0].alignment, group[0].rate);
            push_wrapped(&mut text, 0, format!("{shutter}: {no_gain}"));
        }
    }
    if let Some(inseparable) = inseparable_text(run) {
        push_wrapped(&mut text, 0, inseparable);
    }
    text += ranking_table(cases, &groups).text();
    text += references_text(cases, &groups);
    text += "\n";
    text += legend_text(&notes(&groups));
    let scenes = list_once(list_summarized(cases).into_iter().map(|case| &case.scene));
    let few = few_scenes_text(scenes.len()).filter(|_| rows > 1);
    text += few.map_or(Text::default(), |few| legend_text(&few));
    text += hidden_text(&presets, hidden);
    text += twins_text(cases, &groups);
    text + input_forms_text(cases) + frame_rates_text(cases)
}

/// Keeps the first filters of a shutter, and no blur.
fn shorten(group: &mut Vec<RankedFilter>, count: usize) {
    let mut filters = 0;
    group.retain(|ranked| {
        filters += usize::from(ranked.is_ranked());
        !ranked.is_ranked() || filters <= count
    });
}

/// Goes through the filters that have a rank.
fn ranked(groups: &[Vec<RankedFilter>]) -> impl Iterator<Item = &RankedFilter> {
    groups.iter().flatten().filter(|ranked| ranked.is_ranked())
}

/// Makes the ranking as Markdown.
pub fn ranking_markdown(cases: &[Case]) -> String {
    let groups = rank_for_summary(cases);
    if groups.is_empty() {
        return String::new();
    }
    ranking_table(cases, &groups).markdown()
}

/// Says that filters are shown by the best of their `presets`, a number per filter, and that some
/// are hidden; empty if neither is so.
fn hidden_text(presets: &[usize], hidden: usize) -> Text {
    let are_best = presets.iter().any(|of_filter| *of_filter > 1);
    let presets: usize = presets.iter().sum();
    let note = match (are_best, hidden > 0) {
        (true, true) => {
            format!(
                "Each filter by its best preset; {hidden} filters are left out: --table shows all {presets} presets."
            )
        }
        (true, false) => {
            format!("Each filter by its best preset; --table shows all {presets} presets.")
        }
        (false, true) => {
            format!("{hidden} filters are left out; --table shows all {presets} presets.")
        }
        (false, false) => return Text::default(),
    };
    legend_text(&note)
}

/// Names a group's shutter: `centred shutter`, with the frame rate if it differs from the scene
/// files'.
pub fn shutter_text(alignment: Alignment, rate: Option<FrameRate>) -> String {
    let rate = rate.map_or(String::new(), |rate| format!(", {}", rate.text()));
    format!("{alignment} shutter{rate}")
}

fn ranking_table(cases: &[Case], groups: &[Vec<RankedFilter>]) -> Table {
    // All groups except those of frame rates have the same scenes.
    let first = groups[0][0].rate;
    let cases = list_summarized(cases).into_iter();
    let cases = cases.filter(|case| case.rate == first);
    let scenes = list_once(cases.map(|case| &case.scene));
    let (title, columns) = match scenes.as_slice() {
        [scene] => (scene.to_string(), 3),
        scenes => (format!("mean over {} scenes", scenes.len()), 5),
    };
    let titles = ["FLIP", "still", "grain", "95 % CI", "worst scene"];
    let mut table = Table::new(title, titles.into_iter().take(columns)).with_words_in(5);
    for group in groups {
        table.push_text(shutter_text(group[0].alignment, group[0].rate));
        for ranked in group {
            let [mean, interval, worst] =
                ranking_cells(ranked, scenes.len(), |value| Metric::FLIP.number(value));
            let [still, grain] = ranked.side_effects.texts();
            let cells = [mean, still, grain, interval, worst];
            table.push(ranked_name(ranked), cells.into_iter().take(columns));
        }
    }
    table
}

/// Formats a filter after its rank: ` 2-4 jimenez:hdrp`. No blur has no rank.
pub fn ranked_name(ranked: &RankedFilter) -> String {
    format!("{:>4} {}", ranked.rank_text(), ranked.shown_name())
}

/// Returns the ranking mean, its interval, and the worst scene.
pub fn ranking_cells(
    ranked: &RankedFilter,
    scenes: usize,
    number: impl Fn(f64) -> String,
) -> [String; 3] {
    let interval = (ranked.interval).map_or("-".to_owned(), |ends| range_text(ends, &number));
    let (scene, worst) = &ranked.worst;
    let mut worst = format!("{scene} {}", number(*worst));
    if ranked.scenes < scenes {
        worst += &format!(" ({} of {scenes} scenes)", ranked.scenes);
    }
    [number(ranked.mean), interval, worst]
}

/// Makes the table of references other than no blur, which the ranking has: one row each, one
/// column per shutter. The last row is the lag of the shutter's middle behind the frame.
fn references_text(cases: &[Case], groups: &[Vec<RankedFilter>]) -> Text {
    let references = || (list_summarized(cases).into_iter()).filter(|case| case.is_reference);
    let others = references().filter(|case| case.reference() != Some(ReferencePicture::Identity));
    let names = list_once(others.map(|case| case.name()));
    if names.is_empty() {
        return Text::default();
    }
    let shutters = groups
        .iter()
        .map(|group| (group[0].alignment, group[0].rate));
    let columns = shutters.clone().map(|(alignment, rate)| match rate {
        None => alignment.to_string(),
        Some(rate) => format!("{alignment} {}", rate.word()),
    });
    let mut table = Table::new("references", columns);
    let of_shutters: Vec<Vec<&Case>> = shutters
        .map(|shutter| {
            let cases = references().filter(|case| (case.alignment, case.rate) == shutter);
            cases.collect()
        })
        .collect();
    let number = |value| Metric::FLIP.number(value);
    let mut push = |name: &str, cells: Vec<String>| {
        table.push_row(true, format!("     {name}"), cells);
    };
    for name in names {
        let mean = |cases: &Vec<&Case>| {
            let cases = cases.iter().filter(|case| case.name() == name);
            mean_text(cases.filter_map(|case| case.estimate(Metric::FLIP)), number)
        };
        push(&name, of_shutters.iter().map(mean).collect());
    }
    let lags: Vec<Option<f64>> = of_shutters.iter().map(|cases| mean_lag(cases)).collect();
    if lags.iter().any(Option::is_some) {
        let text = |lag: &Option<f64>| lag.map_or("-".to_owned(), number);
        push("lag behind the frame", lags.iter().map(text).collect());
    }
    table.text()
}

fn notes(groups: &[Vec<RankedFilter>]) -> String {
    let mut notes = format!("FLIP where anything moves; lower is better. {SIDE_EFFECTS_RULE}");
    if groups.iter().flatten().any(RankedFilter::is_tied) {
        notes += &format!(" {RANK_RULE}");
    }
    if groups.len() > 1 {
        notes += " Compare filters of one shutter only. Across shutters, --table has skill, a rough measure.";
    }
    notes
}
