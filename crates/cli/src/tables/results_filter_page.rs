//! Pages of filters beside the kept results, in Markdown: what each is, what it costs, and where it fails.

use std::collections::BTreeMap;
use std::fmt::Write;

use filters::Filter;
use judge::{RankedFilter, ResultScores, Results};
use metrics::Metric;
use tracer::{Location, SceneId, SceneListing, list_scenes};

use super::{cost_text, list_filters, main_results, mean, sealed_of};

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
    let mut page = format!("# {name}\n");
    let shipped = Filter::builtin(name).ok();
    match &shipped {
        Some(filter) => push_facts(&mut page, filter),
        None => page += "\nThis filter is not one of the program's.\n",
    }
    push_scores(&mut page, name, results, sealed);
    push_picture(&mut page, name, results);
    if let Some(filter) = &shipped {
        push_presets(&mut page, filter);
    }
    page
}

fn push_facts(page: &mut String, filter: &Filter) {
    let Filter {
        summary,
        source,
        reach,
        cannot,
        alignment,
        ..
    } = filter;
    let _ = write!(
        page,
        "\n{summary}\n\n- Published: {source}\n- Shutter: {alignment}\n- Reach: {reach}\n- Known limits: {cannot}\n- Files: \
         [shaders/{name}](../shaders/{name})\n",
        name = filter.name
    );
}

/// A row per preset: rank, scores, time, and the scenes that it is worst on.
fn push_scores(page: &mut String, name: &str, results: &Results, sealed: Option<&Results>) {
    let [width, height] = results.size;
    let of = |results: &Results| -> Vec<RankedFilter> {
        let ranked = results.ranking(None).into_iter().flatten();
        ranked.filter(|own| own.filter == name).collect()
    };
    let others = sealed.map(of).unwrap_or_default();
    let _ = write!(
        page,
        "\n## Scores at {width}x{height}\n\n| preset | rank in its shutter | FLIP (95 % CI) | sealed: rank | time | worst scenes |\n|---|---|---|---|---|---|\n"
    );
    for ranked in of(results) {
        let other = others.iter().find(|other| other.name == ranked.name);
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | {} | {} | {} |",
            ranked.name,
            ranked.rank_text(),
            mean(&ranked),
            other.map_or("-".to_owned(), RankedFilter::rank_text),
            results
                .costs
                .get(&ranked.name)
                .map_or("-".to_owned(), cost_text),
            worst_scenes(&ranked.name, results)
        );
    }
    page.push_str("\n[All filters](README.md), with what the columns mean.\n");
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

fn push_picture(page: &mut String, name: &str, results: &Results) {
    let Some(worst) = results.worst_of(name) else {
        return;
    };
    let _ = write!(
        page,
        "\n## Worst picture of its best preset\n\nScenes in which even the one-frame oracle gains nothing are left out: all filters fail alike there.\n\n![truth, output and FLIP of {case} on {scene}](pictures/{file})\n\nTruth, output and FLIP of `{case}` \
         on {scene}{exposes}\n",
        case = worst.name,
        scene = worst.scene,
        file = picture_name(worst),
        exposes = exposes(&worst.scene),
    );
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

fn push_presets(page: &mut String, filter: &Filter) {
    page.push_str("\n## Presets\n\n");
    for preset in &filter.presets {
        let _ = writeln!(page, "- `{}:{}`: {}", filter.name, preset.name, preset.doc);
        let Some(source) = &preset.source else {
            continue;
        };
        if let Some(publication) = &source.publication {
            let _ = writeln!(page, "  - Follows {publication}");
        }
        if let Some(code) = &source.code {
            let _ = writeln!(page, "  - Code: {code}");
        }
        if !source.differs.is_empty() {
            let _ = writeln!(page, "  - Differs: {}", source.differs.join(" "));
        }
    }
}
