//! Live cases: the data with which a page's script runs a filter in the browser, in files next to
//! the page that it loads on demand.

pub mod scene;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use filters::{Filter, Input, Layer};
use frame::{FileError, Size};
use measure::{Case, FilterFrame, InputFormat, MEASURED_FILTERS, PROGRAM, Run, filter_input};
use metrics::{Measured, Metric};
use serde_json::json;

use crate::pixels::report_files::write_script;

/// Most pixels of a frame that can be tried; the file of such a scene has about 15 MB.
const MOST_PIXELS: u32 = 1280 * 720;

/// A case that a filter made, as its page runs it.
pub enum Live {
    /// It is live: what the script needs, as JSON.
    Case(String),
    /// It is not live: a sentence that says why.
    Not(String),
}

/// A filter of live cases.
enum LiveFilter {
    /// The filter, and the number of its file.
    Ready { number: usize, filter: Box<Filter> },
    /// The page cannot run it: a sentence that says why.
    Not(String),
}

/// Live filters of a run.
pub struct LiveFiles<'a> {
    run: &'a Run,
    /// Folder of the run.
    folder: &'a Path,
    /// Filters by name.
    filters: HashMap<&'a str, LiveFilter>,
    /// Contents of their files, as JSON.
    texts: Vec<String>,
}

impl<'a> LiveFiles<'a> {
    /// Finds the filters of a run in `folder`; `cases` are in the page's order.
    pub fn find(run: &'a Run, cases: impl Iterator<Item = &'a Case>, folder: &'a Path) -> Self {
        let mut live = Self {
            run,
            folder,
            filters: HashMap::new(),
            texts: Vec::new(),
        };
        for case in cases.filter(|case| is_filters(case)) {
            if !live.filters.contains_key(&case.filter[..]) {
                let filter = live.find_filter(case);
                live.filters.insert(&case.filter, filter);
            }
        }
        live
    }

    /// Writes the files of the filters next to the page at `html`; returns their paths.
    pub fn write(&self, html: &Path) -> Result<Vec<PathBuf>, FileError> {
        let write = |(number, json): (usize, &String)| {
            write_script(html, &format!("live_filter_{number}"), json)
        };
        self.texts.iter().enumerate().map(write).collect()
    }

    /// Describes a case; `frame` is its scene's, with the guard band. None for a picture that no
    /// filter made.
    pub fn describe(&self, case: &Case, scene: usize, frame: &FilterFrame) -> Option<Live> {
        if !is_filters(case) {
            return None;
        }
        Some(match &self.filters[&case.filter[..]] {
            LiveFilter::Ready { number, filter } => {
                match describe_case(case, scene, frame, *number, filter) {
                    Ok(json) => Live::Case(json),
                    Err(reason) => Live::Not(reason),
                }
            }
            LiveFilter::Not(reason) => Live::Not(reason.clone()),
        })
    }

    /// Finds the filter that a case ran, as its run's folder or this program has it.
    fn find_filter(&mut self, case: &Case) -> LiveFilter {
        let folder = self.folder.join(MEASURED_FILTERS).join(&case.filter);
        let filter = if folder.join("filter.toml").is_file() {
            Filter::load(&folder)
        } else {
            Filter::builtin(&case.filter)
        };
        let filter = filter.ok().filter(|filter| is_of(filter, case));
        let Some(filter) = filter.filter(|_| case.command.is_none()) else {
            let reason = match case.command {
                Some(_) => "A browser cannot run this filter: it is a program.",
                None => {
                    "This page cannot run the filter: the run's folder does not hold it in WGSL."
                }
            };
            return LiveFilter::Not(reason.to_owned());
        };
        let is_as_written = |other: &Case| {
            let mut presets = filter
                .presets
                .iter()
                .filter(|preset| preset.name == other.preset);
            let is_unscaled = other.filter == case.filter && other.reference_width.is_none();
            is_unscaled && presets.any(|preset| preset.reference_width.is_some())
        };
        let as_written = self.run.cases.iter().any(is_as_written);
        match filter.live(self.run.render.width, as_written) {
            Err(reason) => LiveFilter::Not(reason),
            Ok(live) => {
                self.texts.push(live.to_string());
                LiveFilter::Ready {
                    number: self.texts.len() - 1,
                    filter: Box::new(filter),
                }
            }
        }
    }
}

/// Returns whether a filter made the picture. An engine's own one has no preset.
fn is_filters(case: &Case) -> bool {
    !case.is_reference && !case.preset.is_empty()
}

/// Returns whether a filter has the parameters of a case.
fn is_of(filter: &Filter, case: &Case) -> bool {
    let has = |name: &String| case.parameters.contains_key(name);
    let mut parameters = filter.parameters.iter();
    parameters.len() == case.parameters.len() && parameters.all(|parameter| has(&parameter.name))
}

/// Describes a case of a live filter.
fn describe_case(
    case: &Case,
    scene: usize,
    frame: &FilterFrame,
    number: usize,
    filter: &Filter,
) -> Result<String, String> {
    let Size { width, height } = frame.size();
    let is_missing = |layer: &Layer| match layer {
        Layer::Color | Layer::Velocity | Layer::Depth => false,
        Layer::VelocityNext => frame.velocity_next.is_none(),
        Layer::VelocityZ => frame.velocity_z.is_none(),
        Layer::Exclusion => frame.exclusion.is_none(),
    };
    let missing = filter.further_inputs().into_iter().find(is_missing);
    let refused = if width * height > MOST_PIXELS {
        format!("its frame has {width}x{height} pixels, and at most {MOST_PIXELS} are allowed")
    } else if case.input != InputFormat::default() {
        let change = case.input.change().unwrap_or_default();
        format!("its frame had another form ({change})")
    } else if case.scene.frame > 0 && !filter.history.is_empty() {
        "it needs the frame before".to_owned()
    } else if let Some(layer) = missing {
        let name = layer.name();
        format!("the run's folder does not hold {name}, which the filter reads")
    } else {
        String::new()
    };
    if !refused.is_empty() {
        return Err(format!(
            "This case cannot be tried in the browser: {refused}."
        ));
    }
    let colors = [&frame.color];
    let input = Input {
        frame_index: case.scene.frame,
        ..filter_input(frame, &colors)
    };
    let measured = |metric| match case.scores.get(metric) {
        Measured::Score(score) => Some(score),
        Measured::NotApplicable { .. } => None,
    };
    let value = |metric| measured(metric).map(|score| score.value);
    let json = json!({
        "filter": number,
        "scene": scene,
        "preset": case.preset,
        "parameters": case.parameters,
        "values": filter.frame_values(&input)?,
        "alignment": case.alignment,
        "program": PROGRAM,
        "stored": {
            "flip": value(Metric::FLIP),
            "psnr": value(Metric::PSNR),
            "psnr_limit": measured(Metric::PSNR).map(|score| score.floor),
        },
    });
    Ok(json.to_string())
}
