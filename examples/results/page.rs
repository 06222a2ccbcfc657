//! The page of kept results, in Markdown: engines' shipped presets, and the ranking of all presets.
//! On the site each engine has a page.

use bench::Bench;
use cli::{markdown_table, range_text};
use frame::Alignment;
use judge::{
    RANK_RULE, RankedFilter, ResultScores, Results, SIDE_EFFECTS_RULE, SideEffects, SizeComparison,
    compare_sizes,
};
use measure::{Error, IDENTITY, escape_markdown, markdown_code};
use metrics::Metric;
use scene::SceneId;

use super::change::Change;
use super::engines::{Engine, Measured, Shape, list_engines, measured};

/// Characters of a line of the page.
const WIDTH: usize = 135;

/// Finds the results for the page: those with most scenes, without seals.
pub fn main_results(all: &[Results]) -> Option<&Results> {
    let catalogues = all.iter().filter(|results| results.seal.is_none());
    catalogues.max_by_key(|results| results.scenes().len())
}

/// Makes the page from files of results: engines' shipped presets, and each shutter's presets next
/// to their ranks in the sealed variants.
pub fn results_page(all: &[Results], cards: &[Bench]) -> Result<String, Error> {
    Kept::new(all, cards, false)?.page()
}

/// Makes the pages of the site by path below results: the one above with longer tables, and one per
/// engine.
pub fn site_pages(all: &[Results], cards: &[Bench]) -> Result<Vec<(String, String)>, Error> {
    let kept = Kept::new(all, cards, true)?;
    let mut pages = vec![("README.md".to_owned(), kept.page()?)];
    for entry in measured(&kept.groups) {
        let section = kept.section(&entry);
        let table = kept.engine_table(std::slice::from_ref(&entry));
        let shape = &entry.engine.shape;
        let text = format!(
            "{section}\n{table}\n[Try it on five scenes](../../live/report.html#fan/{shape}) · [All results](../README.md)\n"
        );
        let text = text.trim_start().replacen("###", "#", 1);
        let from_below = |text: String, folder: &str| {
            text.replace(&format!("]({folder}/"), &format!("](../{folder}/"))
        };
        let text = (["findings", "changes", "pictures"].into_iter()).fold(text, from_below);
        pages.push((entry.engine.page_name(), text.replace("](engines/", "](")));
    }
    Ok(pages)
}

/// The files of results that make the page.
struct Kept<'a> {
    results: &'a Results,
    sealed: Option<&'a Results>,
    /// Presets of each shutter.
    groups: Vec<Vec<RankedFilter>>,
    /// The program's own, of most presets.
    bench: &'a Bench,
    /// Those of readers.
    of_browsers: Vec<&'a Bench>,
    /// True on the site.
    is_site: bool,
}

impl<'a> Kept<'a> {
    fn new(all: &'a [Results], cards: &'a [Bench], is_site: bool) -> Result<Self, Error> {
        let (of_browsers, benches): (Vec<&Bench>, Vec<&Bench>) =
            (cards.iter()).partition(|card| card.scene.is_some());
        let longest = benches.into_iter().max_by_key(|bench| bench.cases.len());
        let results =
            main_results(all).ok_or_else(|| Error::Refused("no file of results".to_owned()))?;
        let sealed = all.iter().find(|candidate| {
            candidate.seal.is_some()
                && candidate.size == results.size
                && candidate.adapter == results.adapter
        });
        Ok(Self {
            results,
            sealed,
            groups: results.ranking(),
            bench: longest.ok_or_else(|| Error::Refused("no bench of the program".to_owned()))?,
            of_browsers,
            is_site,
        })
    }

    fn page(&self) -> Result<String, Error> {
        let Self { results, bench, .. } = self;
        let mut rule = RANK_RULE.to_owned();
        if self.groups.iter().any(|group| has_effects(group)) {
            rule += &format!(" {SIDE_EFFECTS_RULE}");
        }
        let settings = [
            ("{SCENES}", results.scenes().len().to_string()),
            ("{SIZE}", results.size.to_string()),
            ("{SAMPLES}", results.samples_per_pixel.to_string()),
            (
                "{ADAPTER}",
                escape_markdown(results.adapter.as_deref().unwrap_or_default()),
            ),
            ("{RANK_RULE}", rule),
            ("{CARD}", escape_markdown(&bench.adapter.name)),
            ("{TIMED_SIZE}", format!("{}x{}", bench.width, bench.height)),
        ];
        let fill = |text: &str| {
            (settings.iter()).fold(text.to_owned(), |text, (key, value)| {
                text.replace(key, value)
            })
        };
        let mut page = fill(HEAD) + &self.engines() + &times(&self.of_browsers);
        page += &fill(PRESETS);
        let sealed_groups = self.sealed.map(Results::ranking).unwrap_or_default();
        for group in &self.groups {
            let alignment = group[0].alignment;
            let others = (sealed_groups.iter()).find(|other| other[0].alignment == alignment);
            page += &format!("\n### Presets of a {alignment} shutter\n\n");
            page += &self.ranking(group, others.map_or(&[][..], Vec::as_slice));
            if let Some(sealed) = self.sealed {
                page += &agreement(results, sealed, alignment)?;
            }
        }
        Ok(wrap(&(page + &fill(COMMANDS))))
    }

    /// Makes a table of the engines and, unless each has a page, a section for each.
    fn engines(&self) -> String {
        let all = measured(&self.groups);
        let mut text = self.engine_table(&all);
        let is_worse = |entry: &&Measured| {
            let shape = entry.shape.as_ref();
            shape.is_some_and(|shape| shape.ranked.mean > shape.none)
        };
        let worse: Vec<&str> = (all.iter())
            .filter(is_worse)
            .map(|entry| entry.engine.name.as_str())
            .collect();
        if !worse.is_empty() {
            text += &format!("\nWorse than no blur: {}.\n", worse.join(", "));
        }
        text += &unscored(&all);
        if !self.is_site {
            text.extend(all.iter().map(|entry| self.section(entry)));
        }
        text
    }

    fn engine_table(&self, engines: &[Measured]) -> String {
        let number = |value: f64| Metric::FLIP.number(value);
        let row = |entry: &Measured| -> Vec<String> {
            let engine = &entry.engine;
            let scored = |of: &dyn Fn(&Shape) -> Option<String>| {
                let shape = entry.shape.as_ref();
                shape.and_then(of).unwrap_or("-".to_owned())
            };
            vec![
                format!("{}, {}", self.link(engine), markdown_code(&engine.shape)),
                engine.length.to_string(),
                escape_markdown(&engine.states),
                scored(&|shape| Some(shape.ranked.alignment.to_string())),
                engine.at_180.to_string(),
                scored(&|shape| Some(number(shape.ranked.mean))),
                scored(&|shape| Some(number(shape.none))),
                (entry.gain.as_ref()).map_or("-".to_owned(), |gain| gain.mean().to_owned()),
                find_time(self.bench, &engine.shape),
                engine.default.text().to_owned(),
            ]
        };
        let titles = [
            "engine ships",
            "length",
            "states",
            "shutter",
            "at 180",
            "FLIP",
            "no blur",
            "change gains",
            "time",
            "off by default",
        ];
        markdown_table(&titles, engines.iter().map(row))
    }

    /// Names an engine, with a link to its page if it has one.
    fn link(&self, engine: &Engine) -> String {
        if self.is_site {
            format!(
                "[{}]({})",
                escape_markdown(&engine.name),
                engine.page_name()
            )
        } else {
            escape_markdown(&engine.name)
        }
    }

    /// Describes an engine below a heading, with its worst picture.
    fn section(&self, entry: &Measured) -> String {
        let engine = &entry.engine;
        let mut text = format!("\n### {}\n\n{}", engine.name, engine.wrong);
        if let (Some(Change { by, set }), Some(gain)) = (&engine.change, &entry.gain) {
            text += &format!(
                " {by}: `{set}` alone gains {} in FLIP over {}. [The search](changes/{}).",
                gain.text, gain.over, gain.page
            );
        }
        if let Some(finding) = &engine.finding {
            text += &format!(" [The lines of code](findings/{finding}.md).");
        }
        text += &format!("\n\n{}\n", provenance(engine));
        if let Some(worst) = self.results.worst_of(&engine.shape) {
            let file = picture_name(worst);
            let scene = escape_markdown(&worst.scene.to_string());
            let shape = &engine.shape;
            text += &format!("\n![truth, {shape} and FLIP on {scene}](pictures/{file})\n");
        }
        text
    }

    /// Makes the table of a shutter's presets, with their ranks in the sealed variants.
    fn ranking(&self, group: &[RankedFilter], sealed: &[RankedFilter]) -> String {
        let has_effects = has_effects(group);
        let engines = list_engines();
        let row = |ranked: &RankedFilter| {
            let other = sealed.iter().find(|other| other.name == ranked.name);
            let (scene, worst) = self.worst(ranked);
            let linked = engines.iter().filter(|engine| engine.shape == ranked.name);
            let links: Vec<String> = linked.map(|engine| self.link(engine)).collect();
            let bold = if self.is_site && !links.is_empty() {
                "**"
            } else {
                ""
            };
            let none = if ranked.filter == IDENTITY {
                ", no blur"
            } else {
                ""
            };
            let mut row = vec![
                ranked.rank_text(),
                format!("{bold}{}{bold}{none}", markdown_code(&ranked.name)),
                mean(ranked),
            ];
            if has_effects {
                row.extend(ranked.side_effects.texts());
            }
            row.extend([
                other.map_or("-".to_owned(), RankedFilter::rank_text),
                format!(
                    "{} {}",
                    escape_markdown(&scene.to_string()),
                    Metric::FLIP.number(worst)
                ),
            ]);
            if self.is_site {
                let time = find_time(self.bench, &ranked.name);
                row.extend([self.bleed(ranked), time, links.join(", ")]);
            }
            row
        };
        markdown_table(&self.ranking_titles(has_effects), group.iter().map(row))
    }

    /// Finds the scene where a preset gains the least of what one frame allows, and its FLIP there;
    /// else where its FLIP is worst.
    fn worst<'r>(&'r self, ranked: &'r RankedFilter) -> (&'r SceneId, f64) {
        let gained = (self.results.worst_of(&ranked.name))
            .filter(|score| score.score(Metric::SKILL).is_some())
            .and_then(|score| Some((&score.scene, score.score(Metric::FLIP)?)));
        gained.unwrap_or((&ranked.worst.0, ranked.worst.1))
    }

    /// Lists the titles of that table.
    fn ranking_titles(&self, has_effects: bool) -> Vec<&'static str> {
        let mut titles = vec!["rank", "preset", "FLIP (95 % CI)"];
        if has_effects {
            titles.extend(["still", "grain"]);
        }
        titles.extend(["sealed", "worst scene"]);
        if self.is_site {
            titles.extend(["bleed", "time", "default of"]);
        }
        titles
    }

    /// Returns the mean bleed of a preset over the scenes that have one.
    fn bleed(&self, ranked: &RankedFilter) -> String {
        let scores = self.results.scores.iter();
        let of_preset =
            scores.filter(|score| score.name == ranked.name && score.alignment == ranked.alignment);
        let scores: Vec<f64> = of_preset
            .filter_map(|score| score.score(Metric::Bleed))
            .collect();
        match scores.len() {
            0 => "-".to_owned(),
            count => Metric::Bleed.number(scores.iter().sum::<f64>() / count as f64),
        }
    }
}

/// Returns whether results have changes where nothing moves, and grain; those of older runs have
/// none.
fn has_effects(group: &[RankedFilter]) -> bool {
    let mut filters = group.iter();
    filters.any(|filter| filter.side_effects != SideEffects::default())
}

/// Fills the lines of paragraphs; leaves tables, pictures, headings and commands unchanged.
fn wrap(page: &str) -> String {
    let wrap_part = |part: &str| {
        if part.starts_with(['|', '!', '#', ' ']) {
            return part.to_owned();
        }
        let mut lines = vec![String::new()];
        for word in part.split_whitespace() {
            let line = lines.last_mut().expect("there is a line");
            match line.len() + word.len() < WIDTH {
                _ if line.is_empty() => *line += word,
                true => *line += &format!(" {word}"),
                false => lines.push(word.to_owned()),
            }
        }
        lines.join("\n")
    };
    let parts: Vec<String> = page.trim_end().split("\n\n").map(wrap_part).collect();
    parts.join("\n\n") + "\n"
}

const HEAD: &str = "\
# Results

See how close each engine's motion blur comes to path-traced truth, what is wrong with it, and which small change helps most.

Scores are FLIP where anything moves: the mean over {SCENES} scenes at {SIZE}, on {ADAPTER}. Lower is better. *No blur* is the score of
the sharp frame. Compare scores of one shutter only. *Time* is in milliseconds per frame of {TIMED_SIZE}, on {CARD}.

*Length* is the smear of one frame's motion with everything as shipped, the camera still, at 60 frames per second and 1920x1080:
degrees of the frame, of which 360 are the whole frame. The program measures it on the scene `sliding_panel`, as the length of the even
smear that spreads an edge as far. *States* is what the engine's own documentation says of it. An engine that states a shutter and smears
another length has a defect of length; one that states none has none.

*FLIP* is the shape alone. It compares with a truth of 180 degrees. The engine's own setting of length is put so that the taps of a pixel
cover 180 degrees; everything else stays as shipped. If an engine has no such setting, the motion that it gets is scaled. *At 180* is the
smear that the program measures then. Ranks, worst scenes, pictures and changes use the shape. *Change gains* is what the smallest
change that helps takes from the FLIP, if a [search](../examples/changes/README.md) found one. *Off by default*: an effect that a user
has to add is off *until added*.

";

const PRESETS: &str = "
## All presets

{RANK_RULE} *Sealed* is the rank on variants of the scenes with other speeds, directions, places and colours, which no preset was
fitted to. *Worst scene* is where a preset gains the least of what a filter of one frame can gain over no blur, with its FLIP there.
`shuttertruth list three` prints a filter's source, presets and known limits.
";

const COMMANDS: &str = "
## Measure it again

These commands make the scores, the pictures and this page. Each run announces the time that it needs:

    shuttertruth run --size {SIZE} --samples-per-pixel {SAMPLES} --jitter-frames 0 --out out/results_{SIZE}
    shuttertruth bench --size {TIMED_SIZE} --out out
    shuttertruth run --seal 1 --size {SIZE} --samples-per-pixel {SAMPLES} --jitter-frames 0 --out out/sealed_{SIZE}
    cargo run -p shuttertruth --example results -- out/results_{SIZE}/run.json
    cargo run -p shuttertruth --example results -- out/sealed_{SIZE}/run.json

Flax's licence forbids a port, so that it has no row: [its finding](findings/flax.md). To add a filter, put its folder into `shaders/` and run them with `--filter` and its name. The JSON files next to this page hold every
score, and [one in bench](bench/1920x1080_nvidia_h100_80gb_hbm3.json) the times; [engines.toml](engines.toml) holds the sentences about engines. [What the scores mean](../crates/metrics/README.md).
";

/// Names the engines whose shapes have no scores, and how to make them; nothing if all have.
fn unscored(all: &[Measured]) -> String {
    let without = all.iter().filter(|entry| entry.shape.is_none());
    let shapes: Vec<&str> = without.map(|entry| entry.engine.shape.as_str()).collect();
    if shapes.is_empty() {
        return String::new();
    }
    format!(
        "\nNot measured yet: {}. The commands below make them.\n",
        shapes.join(", ")
    )
}

/// Names an engine's commit, and when it was compared with the newest.
fn provenance(engine: &Engine) -> String {
    let Engine {
        commit,
        date,
        compared,
        default_at,
        ..
    } = engine;
    let mut text = match (date, compared) {
        (Some(date), Some(compared)) => {
            format!("Commit {commit} of {date}, last compared with the newest on {compared}.")
        }
        _ => format!(
            "Commit {commit}, whose date is not known. It was not compared with the newest, which could not be fetched."
        ),
    };
    text += &format!(" Its default is at `{default_at}`.");
    if let Some(moved) = &engine.moved_on {
        text += &format!(" The engine has moved on: {moved}.");
    }
    if engine.transcription_alone {
        text += " The preset rests on a transcription alone, since its language runs nowhere here.";
    }
    text
}

/// Makes the table of the times that readers' browsers measured; nothing without any.
fn times(cards: &[&Bench]) -> String {
    let titles = ["card", "picture", "preset", "time"];
    let rows = cards
        .iter()
        .flat_map(|bench| bench.cases.iter().map(move |case| (bench, case)));
    let rows = rows.map(|(bench, case)| {
        let picture = format!("{}x{}, {}", bench.width, bench.height, bench.frame_text());
        let name = format!("{}:{}", case.filter, case.preset);
        let time = find_time(bench, &name);
        let [card, picture] = [&bench.adapter.name, &picture].map(|text| escape_markdown(text));
        vec![card, picture, markdown_code(&name), time]
    });
    if cards.is_empty() {
        return String::new();
    }
    let table = markdown_table(&titles, rows);
    format!(
        "\n## Readers' cards\n\nBrowsers measured these times, in milliseconds per frame.\n\n{table}"
    )
}

/// Finds the time of a preset in milliseconds; a dash if it was not timed.
fn find_time(bench: &Bench, name: &str) -> String {
    let mut cases = bench.cases.iter();
    let timed = cases.find(|case| format!("{}:{}", case.filter, case.preset) == name);
    timed.map_or("-".to_owned(), |case| {
        format!("{:.2}", 1e3 * case.seconds.median)
    })
}

/// Names the file of a case's picture: `mcguire_tuned_fan.png`.
pub fn picture_name(case: &ResultScores) -> String {
    format!("{}_{}.png", case.name.replace(':', "_"), case.scene)
}

/// `0.047 (0.040 to 0.053)`; FLIP is at least 0, and so are the limits of its mean.
fn mean(ranked: &RankedFilter) -> String {
    let number = |value: f64| Metric::FLIP.number(value);
    let interval = (ranked.interval)
        .map(|ends| format!(" ({})", range_text(ends.map(|end| end.max(0.0)), number)));
    number(ranked.mean) + &interval.unwrap_or_default()
}

/// States whether the sealed variants order the filters like the catalogue.
fn agreement(results: &Results, sealed: &Results, alignment: Alignment) -> Result<String, Error> {
    let compared = compare_sizes(&[results, sealed], Metric::FLIP)?;
    let mut of_shutter = compared
        .iter()
        .filter(|comparison| comparison.alignment == alignment);
    let Some(SizeComparison { agreement, .. }) = of_shutter.next() else {
        return Ok(String::new());
    };
    let order = &agreement[0];
    let interval = (order.interval)
        .map(|[low, high]| format!(" (95 % CI {low:.2} to {high:.2})"))
        .unwrap_or_default();
    let mut text = format!(
        "\nThe scenes and their sealed variants order {} pairs of presets alike and {} differently. Kendall's tau is {:.2}{interval}.\n",
        order.alike,
        order.reversed.len(),
        order.tau,
    );
    for turned in &order.reversed {
        text += &format!(
            "{} is better than {} on the scenes, and worse on the variants.\n",
            markdown_code(&turned.better_here),
            markdown_code(&turned.better_at_largest)
        );
    }
    Ok(text)
}
