//! Views of the scene that a capture may show by mistake: other frames, and rows upside down.

use std::ops::ControlFlow;

use frame::{ColorSampling, Frame, FrameOptions, Image, Plane, Raster, Size};
use scene::Scene;
use tracer::{RenderSettings, TraceError, trace_frame};

use crate::audit::cause::Cause;
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::depth_audit::DepthPair;
use crate::audit::expected_motion::upside_down;
use crate::capture::folder::Capture;
use crate::statistics::median;

/// Largest number of frames late or early to look for.
const MAX_FRAMES: u32 = 2;
/// Smallest number of pixels on which two views must differ before a buffer can distinguish them.
const MIN_PIXELS: usize = 16;
/// Part of these pixels that must show a view.
const LEAST_SHOWING: f64 = 0.8;
/// Part of the pixels on which two views may differ and still look the same.
const LOOKS_SAME: f64 = 0.02;
/// Relative difference above which colours differ.
const OTHER_COLOR: f32 = 0.1;

/// A rasteriser's buffers of a view.
struct View {
    cause: Cause,
    object_id: Raster<u32>,
    depth: Plane,
    /// Colours of the surfaces, without light.
    color: Image,
}

/// Counts, for one buffer, of pixels on which a view differs from the correct one.
#[derive(Clone, Copy, Default)]
struct Tally {
    right: usize,
    other: usize,
    all: usize,
}

impl Tally {
    /// Counts pixels that show the correct view, the other one, or neither. Pixels that show both
    /// do not count.
    fn of(pixels: impl Iterator<Item = [bool; 2]>) -> Self {
        let distinct = pixels.filter(|[right, other]| !(*right && *other));
        distinct.fold(Self::default(), |tally, [right, other]| Self {
            right: tally.right + usize::from(right),
            other: tally.other + usize::from(other),
            all: tally.all + 1,
        })
    }

    /// Returns the part of the pixels; none if they are too few.
    fn part(self, count: usize) -> Option<f64> {
        (self.all >= MIN_PIXELS).then(|| count as f64 / self.all as f64)
    }

    fn shows(self, count: usize) -> bool {
        self.part(count).is_some_and(|part| part >= LEAST_SHOWING)
    }
}

/// The correct view, and others that a capture may show by mistake.
pub struct Views {
    right: View,
    others: Vec<View>,
}

impl Views {
    /// Traces the view of the instant and those of other frames.
    pub fn trace(scene: &Scene, size: Size) -> Result<Self, TraceError> {
        let right = trace_view(scene, size, 0, Cause::Unknown)?;
        let mut others = vec![View {
            cause: Cause::UpsideDown,
            object_id: upside_down(&right.object_id),
            depth: upside_down(&right.depth),
            color: upside_down(&right.color),
        }];
        for count in 1..=MAX_FRAMES {
            let frames = count as i32;
            // A motion may leave the world beyond its keys.
            others.extend(trace_view(scene, size, -frames, Cause::DrawnLate(count)));
            others.extend(trace_view(scene, size, frames, Cause::DrawnEarly(count)));
        }
        Ok(Self { right, others })
    }

    /// Checks whether the buffers of a capture show another view than the scene's at its instant:
    /// all of them, or one by one.
    pub fn find_others(&self, capture: &Capture, depth: &DepthPair) -> Vec<Defect> {
        let tallies = self.others.iter().map(|view| {
            let tallies = tally_buffers(capture, depth, &self.right, view);
            (view.cause.clone(), tallies)
        });
        find_shown(&tallies.collect::<Vec<_>>())
    }
}

/// Finds the views that buffers show most.
fn find_shown(tallies: &[(Cause, [Tally; 3])]) -> Vec<Defect> {
    let mut findings: Vec<Defect> = Vec::new();
    for (at, buffer) in BUFFERS.into_iter().enumerate() {
        let shown = tallies
            .iter()
            .filter(|(_, tally)| tally[at].shows(tally[at].other));
        // A view in which something left the picture differs on fewer pixels.
        let gain = |tally: &[Tally; 3]| (tally[at].other - tally[at].right) as f64;
        let most = shown.clone().map(|(_, tally)| gain(tally));
        let least = (1.0 - LOOKS_SAME) * most.fold(0.0, f64::max);
        let mut best = shown.filter(|(_, tally)| gain(tally) >= least);
        let Some((cause, tally)) = best.next() else {
            continue;
        };
        let is_alone = tally.iter().any(|tally| tally.shows(tally.right));
        let buffer = if is_alone { buffer } else { Buffer::Picture };
        let explained = tally[at].part(tally[at].other).unwrap_or(0.0);
        let explanation = Explanation {
            looks_like: best.map(|(cause, _)| cause.clone()).collect(),
            ..Explanation::by(cause.clone(), explained)
        };
        if findings.iter().all(|finding| finding.buffer != buffer) {
            findings.push(Defect::new(buffer, None, explanation));
        }
    }
    findings
}

/// Buffers that distinguish views, in the order of [`tally_buffers`].
const BUFFERS: [Buffer; 3] = [Buffer::ObjectId, Buffer::Depth, Buffer::Color];

/// Counts what each buffer shows on pixels where a view differs from the correct one.
fn tally_buffers(capture: &Capture, depth: &DepthPair, right: &View, view: &View) -> [Tally; 3] {
    let is_close = |a: &f32, b: &f32| depth.is_close(*a, *b);
    [
        capture.object_id.as_ref().map_or(Tally::default(), |ids| {
            tally(ids, [&right.object_id, &view.object_id], u32::eq)
        }),
        tally(depth.buffer, [&right.depth, &view.depth], is_close),
        tally_colors(&capture.color, right, view),
    ]
}

/// Counts what one buffer shows on pixels where two views differ.
fn tally<T>(buffer: &Raster<T>, views: [&Raster<T>; 2], is_same: impl Fn(&T, &T) -> bool) -> Tally {
    let places = 0..buffer.pixels.len();
    Tally::of(places.filter_map(|at| {
        let [right, other] = views.map(|view| &view.pixels[at]);
        let shows = [right, other].map(|value| is_same(&buffer.pixels[at], value));
        (!is_same(right, other)).then_some(shows)
    }))
}

/// Counts what colour shows. Since engines light as they like, light is fitted to the whole picture
/// and to each object; the more decisive fit counts.
fn tally_colors(picture: &Image, right: &View, view: &View) -> Tally {
    let whole = [right, view].map(|shown| {
        let places: Vec<usize> = (0..picture.pixels.len()).collect();
        let light = fit_light(picture, &shown.color, &places);
        shown.color.map(|color| light_up(*color, light))
    });
    let tallies = [whole, light_objects(picture, right, view)].map(|[right, other]| {
        Tally::of((0..picture.pixels.len()).filter_map(|at| {
            let [right, other] = [right.pixels[at], other.pixels[at]];
            let [from_right, from_other] =
                [right, other].map(|color| distance(picture.pixels[at], color));
            let is_right = from_right < from_other;
            is_other_color(right, other).then_some([is_right, !is_right])
        }))
    });
    let decided = |tally: &Tally| tally.part(tally.right.max(tally.other)).unwrap_or(0.0);
    let [whole, objects] = tallies;
    if decided(&whole) > decided(&objects) {
        whole
    } else {
        objects
    }
}

/// Lights the objects of two views as in a picture: each by its pixels where both views look the
/// same or, with too few, by its pixels in each view.
fn light_objects(picture: &Image, right: &View, view: &View) -> [Image; 2] {
    let objects = right.object_id.pixels.iter().chain(&view.object_id.pixels);
    let last = objects.max().copied().unwrap_or(0) as usize;
    let pixels_of = |shown: &View, is_chosen: &dyn Fn(usize) -> bool| {
        let mut by_object = vec![Vec::new(); last + 1];
        for at in (0..picture.pixels.len()).filter(|at| is_chosen(*at)) {
            by_object[shown.object_id.pixels[at] as usize].push(at);
        }
        by_object
    };
    let is_same = |at: usize| {
        right.object_id.pixels[at] == view.object_id.pixels[at]
            && !is_other_color(right.color.pixels[at], view.color.pixels[at])
    };
    let same = pixels_of(right, &is_same);
    [right, view].map(|shown| {
        let all = pixels_of(shown, &|_| true);
        let chosen = std::iter::zip(&same, &all).map(|(same, all)| match same.len() {
            0..MIN_PIXELS => all,
            _ => same,
        });
        let lights: Vec<[f32; 3]> = chosen
            .map(|pixels| fit_light(picture, &shown.color, pixels))
            .collect();
        (shown.color).zip(&shown.object_id, |color, object| {
            light_up(*color, lights[*object as usize])
        })
    })
}

fn light_up(color: [f32; 3], light: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|channel| light[channel] * color[channel])
}

/// Fits a factor per channel from one picture to the other; 0 where the second is black.
fn fit_light(picture: &Image, surface: &Image, pixels: &[usize]) -> [f32; 3] {
    [0, 1, 2].map(|channel| {
        let pairs = pixels
            .iter()
            .map(|at| [picture, surface].map(|image| f64::from(image.pixels[*at][channel])));
        let lit = pairs.filter(|[_, surface]| *surface > 0.0);
        let light = median(lit.map(|[value, surface]| value / surface)) as f32;
        if light.is_nan() { 0.0 } else { light }
    })
}

fn is_other_color(a: [f32; 3], b: [f32; 3]) -> bool {
    let largest = a.into_iter().chain(b).fold(0.0, f32::max);
    distance(a, b) > OTHER_COLOR * largest
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    std::iter::zip(a, b).map(|(a, b)| (a - b).abs()).sum()
}

/// Traces a rasteriser's buffers some frames after the instant. Unlit colours have no noise.
fn trace_view(scene: &Scene, size: Size, time: i32, cause: Cause) -> Result<View, TraceError> {
    let scene = scene.clone().pinhole().unlit().later_by(f64::from(time));
    let frame = render_view(&scene, size, 1, ColorSampling::Point)?;
    Ok(View {
        cause,
        object_id: frame.object_id,
        depth: frame.depth,
        color: frame.color,
    })
}

/// Renders the frame of a scene's instant.
pub fn render_view(
    scene: &Scene,
    size: Size,
    samples_per_pixel: u32,
    color: ColorSampling,
) -> Result<Frame, TraceError> {
    let settings = RenderSettings {
        samples_per_pixel,
        replicates: 1,
        options: FrameOptions {
            color,
            ..FrameOptions::default()
        },
        ..RenderSettings::default().with_size(size)
    };
    trace_frame(scene, &settings, &|_| ControlFlow::Continue(()))
}
