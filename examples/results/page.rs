//! The page of kept results, in Markdown.

use std::collections::BTreeMap;

use cli::{list_once, markdown_table, range_text};
use frame::Alignment;
use judge::{RANK_RULE, RankedFilter, ResultCost, Results, SizeComparison, compare_sizes};
use metrics::Metric;
use suite::{Error, MIN_SCENES};
use tracer::{Family, Location, SceneId, SceneListing, list_scenes};

const FAMILIES: [Family; 7] = [
    Family::Translation,
    Family::Rotation,
    Family::Camera,
    Family::Thin,
    Family::Overlap,
    Family::Deforming,
    Family::Limits,
];

/// Makes the page of files of results: one part per size, the one with most scenes first, with its sealed variants beside it.
pub fn results_page(all: &[Results]) -> Result<String, Error> {
    let mut page = HEAD.replace("{RANK_RULE}", RANK_RULE);
    let pages = main_results(all).map_or_else(Vec::new, list_filters);
    for catalogue in sort_catalogues(all) {
        push_size(&mut page, catalogue, sealed_of(all, catalogue), &pages)?;
    }
    Ok(page)
}

/// Finds the results that pages of filters are about: those with most scenes, in the scenes themselves.
pub fn main_results(all: &[Results]) -> Option<&Results> {
    sort_catalogues(all).into_iter().next()
}

fn sort_catalogues(all: &[Results]) -> Vec<&Results> {
    let mut catalogues: Vec<&Results> = all.iter().filter(|own| own.seal.is_none()).collect();
    catalogues.sort_by_key(|own| (std::cmp::Reverse(own.scenes().len()), own.size));
    catalogues
}

/// Lists the filters of results.
pub fn list_filters(results: &Results) -> Vec<&str> {
    list_once(results.scores.iter().map(|own| own.filter.as_str()))
}

/// Finds the sealed variants of results.
pub fn sealed_of<'a>(all: &'a [Results], catalogue: &Results) -> Option<&'a Results> {
    (all.iter()).find(|own| {
        own.seal.is_some() && own.size == catalogue.size && own.adapter == catalogue.adapter
    })
}

const HEAD: &str = "\
# Results

How near each filter comes to the truth, by FLIP where anything moves; lower is better. `cargo run -p cli --example results` writes this
page from the files beside it. Nothing is entered by hand. To enter a filter, add its folder to `shaders/`, run the commands of a part with
`--filter` and its name, and put each run.json into its file:

    cargo run -p cli --example results -- out/results_320x180/run.json

- Compare filters of one shutter only.
- {RANK_RULE}
- *Sealed* are the same scenes with speeds, directions, places, times and colours that follow from a number, as in `fan@seal1`. A preset
  that was fitted to the catalogue falls there. Scores differ from the catalogue's because speeds do: compare the ranks.
- *Time* is that of `shuttertruth bench` at this size, divided by that of `jump_flood:paper` in the same round; a bench.json beside a
  run.json comes along. Ratios on a software adapter say little about ratios on a graphics card.
- A filter's name leads to its page: what it is, where its code comes from, and its worst picture.
- [What the scores mean](../crates/metrics/README.md).
";

fn push_size(
    page: &mut String,
    results: &Results,
    sealed: Option<&Results>,
    pages: &[&str],
) -> Result<(), Error> {
    let [width, height] = results.size;
    let scenes = results.scenes();
    *page += &format!(
        "\n## {width}x{height}, {} scenes\n\nOn {}:\n\n",
        scenes.len(),
        results.adapter.as_deref().unwrap_or("no adapter"),
    );
    for run in std::iter::once(results).chain(sealed) {
        *page += &format!("    {}\n", command(run, &scenes));
    }
    let sealed_groups = sealed.map(|sealed| sealed.ranking(None));
    for group in results.ranking(None) {
        let alignment = group[0].alignment;
        let others = (sealed_groups.iter().flatten()).find(|other| other[0].alignment == alignment);
        *page += &format!("\n### {width}x{height}, {alignment} shutter\n\n");
        *page += &ranking(&group, others.map(Vec::as_slice), &results.costs, pages);
        if let Some(sealed) = sealed {
            push_agreement(page, results, sealed, alignment)?;
        }
        push_families(page, results, &group);
    }
    Ok(())
}

/// Writes the command that makes the run.
fn command(results: &Results, scenes: &[&SceneId]) -> String {
    let [width, height] = results.size;
    let (seal, of_seal) = match results.seal {
        Some(seed) => (format!(" --seal {seed}"), format!("_seal{seed}")),
        None => (String::new(), String::new()),
    };
    let shipped = list_scenes(Location::of_bundle(&catalogue::SCENES))
        .expect("the program's own scenes can be listed");
    let is_there = |listing: &SceneListing| scenes.iter().any(|own| **own == listing.name.as_str());
    let scenes = match shipped.iter().all(is_there) {
        true => String::new(),
        false => {
            let names: Vec<String> = scenes.iter().map(|scene| scene.to_string()).collect();
            format!(" --scenes {}", names.join(","))
        }
    };
    format!(
        "shuttertruth run{scenes}{seal} --size {width}x{height} --samples-per-pixel {} --jitter-frames 0 --filter {} --out out/results_{width}x{height}{of_seal}",
        results.samples_per_pixel,
        list_filters(results).join(",")
    )
}

/// Makes the table of a shutter's filters, with their ranks in the sealed variants and their costs. Names of filters with a page lead
/// there.
fn ranking(
    group: &[RankedFilter],
    sealed: Option<&[RankedFilter]>,
    costs: &BTreeMap<String, ResultCost>,
    pages: &[&str],
) -> String {
    let mut titles = vec!["rank", "filter", "FLIP (95 % CI)"];
    if sealed.is_some() {
        titles.extend(["sealed: rank", "FLIP (95 % CI)"]);
    }
    if !costs.is_empty() {
        titles.push("time");
    }
    titles.push(match sealed {
        Some(_) => "worst scene of the catalogue",
        None => "worst scene",
    });
    let row = |ranked: &RankedFilter| {
        let name = format!("`{}`", ranked.name);
        let name = match pages.contains(&ranked.filter.as_str()) {
            true => format!("[{name}]({}.md)", ranked.filter),
            false => name,
        };
        let mut cells = vec![ranked.rank_text(), name, mean(ranked)];
        if let Some(sealed) = sealed {
            let other = sealed.iter().find(|other| other.name == ranked.name);
            cells.extend([RankedFilter::rank_text, mean].map(|text| or_dash(other, text)));
        }
        if !costs.is_empty() {
            cells.push(or_dash(costs.get(&ranked.name), cost_text));
        }
        let (scene, worst) = &ranked.worst;
        cells.push(format!("{scene} {}", Metric::FLIP.number(*worst)));
        cells
    };
    markdown_table(&titles, group.iter().map(row))
}

/// Fills a cell; a dash where there is nothing.
pub fn or_dash<T>(value: Option<T>, text: impl FnOnce(T) -> String) -> String {
    value.map_or("-".to_owned(), text)
}

/// `0.47 (0.40 to 0.53)`: median and quartiles.
pub fn cost_text(cost: &ResultCost) -> String {
    let ResultCost { median, low, high } = cost;
    match low == high {
        true => format!("{median:.2}"),
        false => format!("{median:.2} ({low:.2} to {high:.2})"),
    }
}

pub fn mean(ranked: &RankedFilter) -> String {
    let number = |value| Metric::FLIP.number(value);
    let interval = ranked
        .interval
        .map(|ends| format!(" ({})", range_text(ends, number)));
    number(ranked.mean) + &interval.unwrap_or_default()
}

/// Says whether the sealed variants order the filters as the catalogue does.
fn push_agreement(
    page: &mut String,
    results: &Results,
    sealed: &Results,
    alignment: Alignment,
) -> Result<(), Error> {
    let compared = compare_sizes(&[results, sealed], Metric::FLIP)?;
    let mut of_shutter = compared.iter().filter(|own| own.alignment == alignment);
    let Some(SizeComparison { agreement, .. }) = of_shutter.next() else {
        return Ok(());
    };
    let own = &agreement[0];
    let interval = (own.interval)
        .map(|[low, high]| format!(" (95 % CI {low:.2} to {high:.2})"))
        .unwrap_or_default();
    *page += &format!(
        "\nKendall's tau of the catalogue's order and the sealed variants' is {:.2}{interval}. Both order {} pairs of filters alike; {} pairs are turned round.\n",
        own.tau,
        own.alike,
        own.reversed.len()
    );
    for turned in &own.reversed {
        *page += &format!(
            "`{}` is better than `{}` on the catalogue, and worse on the sealed variants.\n",
            turned.better_here, turned.better_at_largest
        );
    }
    Ok(())
}

/// The mean of each filter over the scenes of each family, with its rank there if the scenes are enough to order filters.
fn push_families(page: &mut String, results: &Results, group: &[RankedFilter]) {
    let alignment = group[0].alignment;
    let families: Vec<(Family, Vec<RankedFilter>)> = (FAMILIES.into_iter())
        .filter_map(|family| {
            let mut groups = results.ranking(Some(family)).into_iter();
            Some((family, groups.find(|own| own[0].alignment == alignment)?))
        })
        .collect();
    if families.len() < 2 {
        return;
    }
    let names = (families.iter())
        .map(|(family, ranked)| format!("{} ({})", family.name(), ranked[0].scenes));
    let titles: Vec<String> = std::iter::once("filter".to_owned()).chain(names).collect();
    let titles: Vec<&str> = titles.iter().map(String::as_str).collect();
    let cell = |own: &RankedFilter| match own.scenes >= MIN_SCENES {
        true => format!("{}, {}", mean(own), own.rank_text()),
        false => Metric::FLIP.number(own.mean),
    };
    let row = |ranked: &RankedFilter| {
        let of_family = |(_, family): &(Family, Vec<RankedFilter>)| {
            let own = family.iter().find(|own| own.name == ranked.name);
            own.map_or_else(String::new, cell)
        };
        let cells = families.iter().map(of_family);
        std::iter::once(format!("`{}`", ranked.name))
            .chain(cells)
            .collect()
    };
    *page += &format!(
        "\nMean FLIP per family, with its number of scenes; where there are {MIN_SCENES} or more, with its 95 % CI and the rank. Fewer order nothing:\n\n{}",
        markdown_table(&titles, group.iter().map(row))
    );
}
