//! Page of one picture next to its reference.

use frame::{Image, Plane};
use judge::{BLOCK, number, worst_block};
use maud::{Markup, PreEscaped, html};
use measure::shorten_names;
use metrics::{ImageMetric, Maps, Metric, Regions, Scores};

use crate::case::legend::colors;
use crate::case::profile::worst_pixel;
use crate::case::viewer::{VIEWER_SCRIPTS, viewer};
use crate::document::{Document, Siblings, script_data};
use crate::pixels::layer::Layer;
use crate::pixels::planes::Planes;
use crate::table::Column::Plain;
use crate::table::grouped_table;

/// Script that runs after the viewer's.
const SCRIPT: &str = include_str!("assets/one_picture.js");

/// A picture of the page, with the name that readers know it by.
pub struct NamedPicture<'a> {
    /// Name, such as that of its file.
    pub name: String,
    /// Scene-linear radiance.
    pub color: &'a Image,
}

/// A picture and its reference, and all that their page shows.
pub struct PicturePage<'a> {
    /// The picture.
    pub image: NamedPicture<'a>,
    /// What it should be.
    pub reference: NamedPicture<'a>,
    /// The sharp picture that the blur was given, if known.
    pub frame: Option<NamedPicture<'a>>,
    /// Error maps of the picture.
    pub maps: &'a Maps,
    /// Regions that its scores are pooled over.
    pub regions: &'a Regions,
    /// Its scores.
    pub scores: &'a Scores,
    /// Metric of the headline; its region has the worst place.
    pub headline: Metric,
    /// Scores that it does not have, by the reason.
    pub missing: &'a [(String, Vec<Metric>)],
    /// Display exposure, in stops.
    pub stops: f32,
    /// Sentences about how the pictures were read.
    pub notes: &'a [String],
}

/// Writes the page of a picture and its reference as HTML.
pub fn picture_page(page: &PicturePage) -> String {
    let title = format!("{} against {}", page.image.name, page.reference.name);
    let mut planes = Planes::default();
    let layers = add_layers(page, &mut planes);
    let words = |layer: Layer| name_layer(page, layer);
    let document = Document {
        title: &format!("{title} - Shuttertruth"),
        heading: html! { "Shuttertruth" },
        subtitle: &format!("{}, {}", measure::PROGRAM, page.image.color.size()),
        body: html! {
            main {
                noscript { p { "The numbers need no script; the pictures do." } }
                article.case.open id="picture" data-title=(title) data-name="image" data-filter=(page.image.name)
                    data-score=(headline(page)) {
                    div.case_head { h2 tabindex="-1" { (title) } }
                    (score_line(page))
                    (place(page, &layers))
                    @for note in page.notes { p.note { (note) } }
                    (score_rows(page))
                    (missing(page))
                }
            }
            (viewer(page.image.color.size(), &words))
            div #numbers hidden {
                script type="application/json" data-scene="0" { (PreEscaped(planes.json())) }
            }
            (script_data("colors", &colors()))
        },
        scripts: &[&VIEWER_SCRIPTS[..], &[SCRIPT]].concat(),
        siblings: Siblings::None,
    };
    document.render()
}

/// Names a kind of picture as this page's readers know it.
fn name_layer(page: &PicturePage, layer: Layer) -> (String, String) {
    let hint = match layer {
        Layer::Truth => "what the picture should be",
        Layer::Output => "the picture that is scored",
        Layer::Instant => "the sharp picture that the blur was given",
        Layer::Flip => "visible difference from the reference",
        Layer::SignedError => "brightness of the picture minus that of the reference",
        _ => layer.help(),
    };
    let name = match layer {
        Layer::Truth => Some(&page.reference.name),
        Layer::Output => Some(&page.image.name),
        Layer::Instant => page.frame.as_ref().map(|frame| &frame.name),
        _ => None,
    };
    let title = name.map_or(layer.title().to_owned(), Clone::clone);
    (title, hint.to_owned())
}

/// Adds the numbers of all pictures and maps; returns `truth:0,1,2 output:3,4,5`.
fn add_layers(page: &PicturePage, planes: &mut Planes) -> String {
    let truth = planes.add_image(page.reference.color);
    let output = planes.add_image(page.image.color);
    let mut layers = vec![
        (Layer::SignedError, [output.clone(), truth.clone()].concat()),
        (Layer::Truth, truth),
        (Layer::Output, output),
    ];
    if let Some(frame) = &page.frame {
        layers.push((Layer::Instant, planes.add_image(frame.color)));
    }
    layers.push((Layer::Flip, vec![planes.add(&page.maps.flip)]));
    if page.scores.get(Metric::LABEL).value().is_some() {
        let map = &page.maps.label_total_variation;
        layers.push((Layer::LabelTotalVariation, vec![planes.add(map)]));
    }
    layers.sort_by_key(|(layer, _)| *layer as usize);
    let words = layers.iter().map(|(layer, numbers)| {
        let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
        format!("{}:{}", layer.name(), numbers.join(","))
    });
    words.collect::<Vec<_>>().join(" ")
}

fn place(page: &PicturePage, layers: &str) -> Markup {
    let [x, y] = worst_place(page.headline, &page.maps.flip, page.regions);
    html! {
        div.viewer_place data-scene="0" data-layers=(layers) data-stops=(page.stops) data-line=""
            data-worst=(format!("{x},{y}")) {}
    }
}

fn worst_place(metric: Metric, flip: &Plane, regions: &Regions) -> [u32; 2] {
    let (x, y) = worst_block(metric, flip, regions);
    worst_pixel(flip, [x, y], BLOCK)
}

fn headline(page: &PicturePage) -> String {
    let metric = page.headline;
    let value = page.scores.get(metric).value();
    format!("FLIP {}", page.scores.text(metric, value))
}

/// Writes the scores that a reader looks for first, over the region of the headline.
fn score_line(page: &PicturePage) -> Markup {
    let region = page.headline.region();
    let errors = [
        ("FLIP", ImageMetric::Flip),
        ("PSNR", ImageMetric::Psnr),
        ("SSIM", ImageMetric::Ssim),
    ];
    let metrics = errors.map(|(name, error)| (name, Metric::Image(error, region)));
    html! {
        p.score {
            @for (name, metric) in metrics {
                @if let Some(value) = page.scores.get(metric).value() {
                    span { (name) " " strong { (metric.number(value)) } }
                }
            }
        }
    }
}

fn score_rows(page: &PicturePage) -> Markup {
    let all = Metric::all();
    let scored = all
        .iter()
        .filter_map(|metric| Some((*metric, page.scores.get(*metric).value()?)));
    let bodies = html! {
        tbody {
            @for (metric, value) in scored {
                tr {
                    th scope="row" { (metric) }
                    td { (number(value)) " " (metric.unit()) }
                    td.meaning { (metric.meaning()) }
                }
            }
        }
    };
    let columns = ["score", "value", "what it says"].map(Plain);
    grouped_table(Some("scores"), "Scores", None, &columns, &bodies)
}

fn missing(page: &PicturePage) -> Markup {
    html! {
        @if !page.missing.is_empty() {
            h3 { "Scores left out" }
            ul {
                @for (reason, metrics) in page.missing {
                    li { (shorten_names(metrics).join(", ")) ": " (reason) }
                }
            }
        }
    }
}
