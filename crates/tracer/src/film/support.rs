//! The objects that the open shutter sees at each pixel, found by camera rays without shading.

use frame::{Raster, Support};
use rayon::prelude::*;

use crate::error::TraceError;
use crate::film::eye::Eye;
use crate::film::render::{Film, PIXELS_PER_TASK};
use crate::film::sampler::{Sampler, Stream, pixel_seed};
use crate::progress::Meter;

/// Rays per pixel, a power of two. Parts that cover less of a pixel than one ray stands for may be missed.
const SAMPLES: u32 = 64;
/// Seed, the same for all renders, so that regions do not depend on the seed of a truth.
const SEED: u64 = 0;

/// The objects that one pixel's rays met while one shutter was open.
#[derive(Clone)]
struct PixelProbe {
    /// True per object id that was seen.
    seen: Vec<bool>,
    /// True if anything was seen that the frame of the instant does not show.
    unknowable: bool,
}

/// Probes the scene over the canvas and each of the times of `film`, which must have a view of the instant; nothing else of
/// it is used. `moving` tells for each of the times, per object id, that it moves on screen.
pub(crate) fn trace_supports(
    film: &Film,
    moving: &[&[bool]],
    meter: &Meter,
) -> Result<Vec<Support>, TraceError> {
    let tasks = (film.canvas.pixels())
        .par_chunks(PIXELS_PER_TASK)
        .map(|task| {
            let mut eye = Eye::new(film.integrator.stage, film.canvas);
            // This is no progress of the replicate, but a chance to cancel it.
            meter.advance(0);
            meter.check()?;
            Ok((task.iter())
                .map(|&pixel| probe_pixel(film, &mut eye, pixel))
                .collect())
        })
        .collect::<Result<Vec<Vec<Vec<PixelProbe>>>, TraceError>>()?;
    let pixels: Vec<Vec<PixelProbe>> = tasks.into_iter().flatten().collect();
    Ok((moving.iter().enumerate())
        .map(|(number, moving)| {
            let probes = Raster {
                width: film.canvas.columns(),
                height: film.canvas.rows(),
                pixels: pixels.iter().map(|probes| &probes[number]).collect(),
            };
            assemble_support(&probes, moving)
        })
        .collect())
}

fn assemble_support(probes: &Raster<&PixelProbe>, moving: &[bool]) -> Support {
    let moves =
        |probe: &&PixelProbe| (probe.seen.iter().zip(moving)).any(|(seen, moves)| *seen && *moves);
    Support {
        seen: (0..moving.len())
            .map(|object| probes.map(|probe| probe.seen[object]))
            .collect(),
        moving: probes.map(moves),
        unknowable: probes.map(|probe| probe.unknowable),
    }
}

/// Probes one pixel at each of the film's times.
fn probe_pixel(film: &Film, eye: &mut Eye, pixel: u32) -> Vec<PixelProbe> {
    let stage = film.integrator.stage;
    let instant = film
        .instant
        .as_ref()
        .expect("the film of a truth has a view of the instant");
    let [left, top] = film.canvas.corner(pixel);
    let row = pixel / film.canvas.columns();
    let seed = pixel_seed(SEED, Stream::Support, film.canvas.seed_number(pixel), 0);
    let unseen = PixelProbe {
        seen: vec![false; stage.scene.objects.len() + 1],
        unknowable: false,
    };
    let mut probes = vec![unseen; film.times.len()];
    for index in 0..SAMPLES {
        let [x, y, part, _] = Sampler::new(seed, index).camera();
        let mut last: Option<(f64, usize, bool)> = None;
        for (times, probe) in film.times.iter().zip(&mut probes) {
            let time = times.at(part, row, film.canvas.height);
            let (object, is_hidden) = match last {
                Some((probed_at, object, is_hidden)) if probed_at == time => (object, is_hidden),
                _ => {
                    let ray = eye.view_at(time).ray(left + x, top + y);
                    let hit = stage.closest(&mut eye.poses, &ray);
                    let poses = (&mut eye.poses, &mut eye.instant);
                    let point = instant.look_back(stage, poses, &ray, hit.as_ref());
                    (hit.map_or(0, |hit| hit.object + 1), !point.is_shown)
                }
            };
            probe.seen[object] = true;
            probe.unknowable |= is_hidden;
            last = Some((time, object, is_hidden));
        }
    }
    probes
}
