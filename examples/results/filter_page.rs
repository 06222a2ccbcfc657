//! Pages of filters beside the kept results, in Markdown: what each is, what it costs, and where it fails.

use std::collections::BTreeMap;

use cli::markdown_table;
use filters::Filter;
use judge::{RankedFilter, ResultScores, Results};
use metrics::Metric;
use tracer::{Location, SceneId, SceneListing, list_scenes};

use super::page::{cost_text, list_filters, main_results, mean, or_dash, sealed_of};

/// Number of scenes that a page names for each preset, the worst first.
const WORST: usize = 3;

/// Makes a page per filter from files of results, by the name of its file: `mcguire.md`.
pub fn results_filter_pages(all: &[Results]) -> BTreeMap<String, String> {
    let Some(results) = main_results(all) else {
        return BTreeMap::new();
    };
    let filters = list_filters(results);
    let sealed = sealed_of(all, results);
    (filters.into_iter())
        .map(|filter| (format!("{filter}.md"), page(filter, results, sealed)))
        .collect()
}

/// Names the file of a case's picture: `mcguire_tuned_fan.png`.
pub fn picture_name(case: &ResultScores) -> String {
    format!("{}_{}.png", case.name.replace(':', "_"), case.scene)
}

fn page(name: &str, results: &Results, sealed: Option<&Results>) -> String {
    let shipped = Filter::builtin(name).ok();
    let facts = shipped.as_ref().map_or(
        "\nThis filter is not one of the program's.\n".to_owned(),
        facts,
    );
    let scores = scores(name, results, sealed);
    let presets = shipped.as_ref().map_or(String::new(), presets);
    format!(
        "# {name}\n{facts}{scores}{}{presets}",
        picture(name, results)
    )
}

fn facts(filter: &Filter) -> String {
    let Filter {
        name,
        summary,
        source,
        reach,
        cannot,
        alignment,
        ..
    } = filter;
    format!(
        "\n{summary}\n\n- Published: {source}\n- Shutter: {alignment}\n- Reach: {reach}\n- Known limits: {cannot}\n- Files: \
         [shaders/{name}](../shaders/{name})\n"
    )
}

/// Makes a row per preset: rank, scores, time, and the scenes that it is worst on.
fn scores(name: &str, results: &Results, sealed: Option<&Results>) -> String {
    let [width, height] = results.size;
    let of = |results: &Results| -> Vec<RankedFilter> {
        let ranked = results.ranking(None).into_iter().flatten();
        ranked.filter(|own| own.filter == name).collect()
    };
    let others = sealed.map(of).unwrap_or_default();
    let titles = [
        "preset",
        "rank in its shutter",
        "FLIP (95 % CI)",
        "sealed: rank",
        "time",
        "worst scenes",
    ];
    let row = |ranked: RankedFilter| {
        let other = others.iter().find(|other| other.name == ranked.name);
        vec![
            format!("`{}`", ranked.name),
            ranked.rank_text(),
            mean(&ranked),
            or_dash(other, RankedFilter::rank_text),
            or_dash(results.costs.get(&ranked.name), cost_text),
            worst_scenes(&ranked.name, results),
        ]
    };
    format!(
        "\n## Scores at {width}x{height}\n\n{}\n[All filters](README.md), with what the columns mean.\n",
        markdown_table(&titles, of(results).into_iter().map(row))
    )
}

/// `fan 0.136, wires 0.110`
fn worst_scenes(name: &str, results: &Results) -> String {
    let own = results.scores.iter().filter(|own| own.name == name);
    let mut errors: Vec<(&SceneId, f64)> = own
        .filter_map(|own| Some((&own.scene, own.score(Metric::FLIP)?)))
        .collect();
    errors.sort_by(|a, b| b.1.total_cmp(&a.1));
    let texts: Vec<String> = (errors.iter().take(WORST))
        .map(|(scene, error)| format!("{scene} {}", Metric::FLIP.number(*error)))
        .collect();
    texts.join(", ")
}

fn picture(name: &str, results: &Results) -> String {
    let text = |worst: &ResultScores| {
        format!(
            "\n## Worst picture of its best preset\n\nScenes in which even the one-frame oracle gains nothing are left out: all filters fail alike there.\n\n![truth, output and FLIP of {case} on {scene}](pictures/{file})\n\nTruth, output and FLIP of `{case}` \
             on {scene}{exposes}\n",
            case = worst.name,
            scene = worst.scene,
            file = picture_name(worst),
            exposes = exposes(&worst.scene),
        )
    };
    results.worst_of(name).map_or(String::new(), text)
}

/// What a scene of the program's exposes, as the end of a sentence.
fn exposes(scene: &SceneId) -> String {
    let listed: Vec<SceneListing> = list_scenes(Location::of_bundle(&catalogue::SCENES))
        .expect("the program's own scenes can be listed");
    match listed.into_iter().find(|own| *scene == own.name.as_str()) {
        Some(own) => format!(". {}", own.exposes),
        None => ".".to_owned(),
    }
}

fn presets(filter: &Filter) -> String {
    let mut text = "\n## Presets\n\n".to_owned();
    for preset in &filter.presets {
        text += &format!("- `{}:{}`: {}\n", filter.name, preset.name, preset.doc);
        let Some(source) = &preset.source else {
            continue;
        };
        if let Some(publication) = &source.publication {
            text += &format!("  - Follows {publication}\n");
        }
        if let Some(code) = &source.code {
            text += &format!("  - Code: {code}\n");
        }
        if !source.differs.is_empty() {
            text += &format!("  - Differs: {}\n", source.differs.join(" "));
        }
    }
    text
}
