//! The objects that the open shutter sees at each pixel, found by camera rays without shading.

use std::ops::Range;

use frame::{Raster, Support, moving_region, shaded_region};
use rayon::prelude::*;

use crate::error::TraceError;
use crate::film::canvas::Canvas;
use crate::film::eye::Eye;
use crate::film::render::{Film, Times, for_each_pixel};
use crate::path::stops::visit_layers;
use crate::progress::Meter;
use crate::sampler::{Sampler, Stream, pixel_seed};

/// Rays per pixel, a power of two. Parts that cover less of a pixel than one ray represents may be
/// missed.
const SAMPLES: u32 = 64;
/// Rays per pixel where they and the rays of all eight neighbours found the same.
const FIRST_SAMPLES: u32 = 16;
/// Factor on both for a camera with a lens, which spreads what is seen over more pixels and covers
/// less of each.
const LENS_FACTOR: u32 = 4;
/// Seed, the same for all renders, so that regions do not depend on the seed of a truth.
const SEED: u64 = 0;

/// The support of a truth, and its regions.
pub(crate) struct ProbedSupport {
    pub support: Support,
    /// Pixels of the moving region.
    pub moving: Raster<bool>,
    /// Pixels with shading at the instant.
    pub shaded: Raster<bool>,
}

/// The objects that one pixel's rays met while one shutter was open.
#[derive(Clone, PartialEq)]
struct PixelProbe {
    /// True per object id that was seen.
    seen: Vec<bool>,
    /// Number of these.
    known: usize,
    /// True if anything was seen that the frame of the instant does not show.
    unknowable: bool,
    /// True if two rays saw different objects. A ray sees several through translucent surfaces.
    is_mixed: bool,
}

/// Probes the scene over the canvas and each of the times of `film`, which must have a view of the
/// instant; nothing else of it is used. `moving` says per time and object id whether the object
/// moves on screen.
pub(crate) fn trace_supports(
    film: &Film,
    moving: &[&[bool]],
    meter: &Meter,
) -> Result<Vec<ProbedSupport>, TraceError> {
    let unseen = PixelProbe {
        seen: vec![false; film.integrator.stage.scene.objects.len() + 1],
        known: 0,
        unknowable: false,
        is_mixed: false,
    };
    let factor = match film.integrator.stage.scene.camera.lens {
        Some(_) => LENS_FACTOR,
        None => 1,
    };
    let [few, all] = [FIRST_SAMPLES, SAMPLES].map(|samples| factor * samples);
    let canvas = film.canvas;
    let numbers = 0..film.times.len();
    let nothing = vec![unseen; film.times.len()];
    let every = canvas.pixels();
    let begin = |_| nothing.clone();
    let mut probes = probe_pixels(film, &every, 0..few, begin, |_, _| true, meter)?;
    let is_mixed = |pixel: u32, number: usize| !is_plain(canvas, &probes, pixel, number);
    let mixed: Vec<u32> = (every.into_par_iter())
        .filter(|&pixel| numbers.clone().any(|number| is_mixed(pixel, number)))
        .collect();
    let go_on = |pixel: u32| probes[pixel as usize].clone();
    let whole = probe_pixels(film, &mixed, few..all, go_on, is_mixed, meter)?;
    for (pixel, whole) in mixed.into_iter().zip(whole) {
        probes[pixel as usize] = whole;
    }
    Ok((moving.iter().enumerate())
        .map(|(number, moving)| {
            let support = assemble_support(canvas, &probes, number, moving);
            ProbedSupport {
                moving: moving_region(&support),
                shaded: shaded_region(&support),
                support,
            }
        })
        .collect())
}

/// Adds samples of each of the pixels to the probes that `before` returns. A sample has those of
/// the film's times that `is_probed` names.
fn probe_pixels(
    film: &Film,
    pixels: &[u32],
    samples: Range<u32>,
    before: impl Fn(u32) -> Vec<PixelProbe> + Sync,
    is_probed: impl Fn(u32, usize) -> bool + Sync,
    meter: &Meter,
) -> Result<Vec<Vec<PixelProbe>>, TraceError> {
    let place = (film.integrator.stage, film.canvas);
    // This does not count as progress of the replicate, but may be cancelled.
    let no_work = |_: &[u32]| 0;
    for_each_pixel(place, pixels, meter, no_work, |eye, pixel| {
        let mut probes = before(pixel);
        let mut probed: Vec<(&Times, &mut PixelProbe)> = (film.times.iter().enumerate())
            .zip(&mut probes)
            .filter(|((number, _), _)| is_probed(pixel, *number))
            .map(|((_, times), probe)| (times, probe))
            .collect();
        for index in samples.clone() {
            probe_once(film, eye, pixel, index, &mut probed);
        }
        probes
    })
}

/// Returns true if a pixel's rays, and its neighbours' rays, all found the same at one of the
/// times, either all of it knowable or none of it.
fn is_plain(canvas: Canvas, probes: &[Vec<PixelProbe>], pixel: u32, number: usize) -> bool {
    let columns = canvas.columns();
    let around = |at: u32, end: u32| at.saturating_sub(1)..(at + 2).min(end);
    let mut rows = around(pixel / columns, canvas.rows());
    let probe = &probes[pixel as usize][number];
    !probe.is_mixed
        && rows.all(|row| {
            around(pixel % columns, columns)
                .all(|column| probes[(row * columns + column) as usize][number] == *probe)
        })
}

/// Assembles the support of one of the times from all pixels' probes.
fn assemble_support(
    canvas: Canvas,
    probes: &[Vec<PixelProbe>],
    number: usize,
    moving: &[bool],
) -> Support {
    let raster = |holds: &(dyn Fn(&PixelProbe) -> bool + Sync)| Raster {
        width: canvas.columns(),
        height: canvas.rows(),
        pixels: (probes.par_iter())
            .map(|probes| holds(&probes[number]))
            .collect(),
    };
    let moves =
        |probe: &PixelProbe| (probe.seen.iter().zip(moving)).any(|(seen, moves)| *seen && *moves);
    Support {
        seen: (0..moving.len())
            .map(|object| raster(&|probe| probe.seen[object]))
            .collect(),
        moving: raster(&moves),
        unknowable: raster(&|probe| probe.unknowable),
    }
}

/// Adds one sample of a pixel at each of some times.
fn probe_once(
    film: &Film,
    eye: &mut Eye,
    pixel: u32,
    index: u32,
    probed: &mut [(&Times, &mut PixelProbe)],
) {
    let stage = film.integrator.stage;
    let instant = film
        .instant
        .as_ref()
        .expect("the film of a truth has a view of the instant");
    let [left, top] = film.canvas.corner(pixel);
    let row = pixel / film.canvas.columns();
    let seed = pixel_seed(SEED, Stream::Support, film.canvas.seed_number(pixel), 0);
    let sampler = Sampler::new(seed, index);
    let [x, y, part, _] = sampler.camera();
    let mut probed_at = None;
    let mut hits: Vec<(usize, bool)> = Vec::new();
    // Distance to what the last ray met, if only a mover can keep this ray from meeting it.
    let mut still = None;
    for (times, probe) in probed {
        let time = times.at(part, row, film.canvas.height);
        if probed_at != Some(time) {
            let eye_ray = eye.ray_at(time, [left + x, top + y], &sampler);
            let then = &mut eye.instant;
            let is_met = |limit| !stage.is_blocked_by_mover(&mut eye.poses, &eye_ray.ray, limit);
            if !still.is_some_and(is_met) {
                hits.clear();
                still = None;
                visit_layers(stage, &mut eye.poses, &eye_ray.ray, |poses, layer| {
                    let hit = layer.stop.map(|stop| stop.hit);
                    let point = instant.look_back(stage, (poses, then), &eye_ray, hit.as_ref());
                    hits.push((hit.map_or(0, |hit| hit.object + 1), !point.is_shown));
                    still = (!stage.has_translucency && instant.sees_still(stage, hit.as_ref()))
                        .then(|| hit.map_or(f64::INFINITY, |hit| hit.t));
                });
            }
            probed_at = Some(time);
        }
        probe.mark(&hits);
    }
}

impl PixelProbe {
    /// Marks the objects that one ray met, each with true if the instant hides the point that the
    /// ray saw.
    fn mark(&mut self, hits: &[(usize, bool)]) {
        if let [(object, is_hidden)] = hits
            && self.known == 1
            && self.seen[*object]
        {
            self.unknowable |= is_hidden;
            return;
        }
        let known = self.known;
        for (object, is_hidden) in hits {
            self.seen[*object] = true;
            self.unknowable |= is_hidden;
        }
        let objects = self.seen.iter().enumerate();
        let mut seen = objects.filter(|(_, seen)| **seen).map(|(object, _)| object);
        let is_found = |object: usize| hits.iter().any(|(hit, _)| *hit == object);
        self.is_mixed |= known > 0 && !seen.all(is_found);
        self.known = self.seen.iter().filter(|seen| **seen).count();
        self.is_mixed |= known > 0 && self.known > known;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_mixed_if_two_rays_met_other_objects() {
        for (first, second, is_mixed) in [
            (&[1][..], &[1][..], false),
            (&[1], &[2], true),
            // Through a translucent surface.
            (&[1], &[1, 2], true),
            (&[1, 2], &[1], true),
            (&[1, 2], &[2, 1], false),
        ] {
            let mut probe = PixelProbe {
                seen: vec![false; 3],
                known: 0,
                unknowable: false,
                is_mixed: false,
            };
            for met in [first, second] {
                probe.mark(
                    &met.iter()
                        .map(|object| (*object, false))
                        .collect::<Vec<_>>(),
                );
            }
            assert_eq!(probe.is_mixed, is_mixed, "{first:?}, then {second:?}");
        }
    }
}
