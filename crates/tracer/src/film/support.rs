//! A probe of visibility: what the open shutter sees at all, by camera rays without any shading.

use frame::{Raster, Support};
use rayon::prelude::*;

use crate::film::eye::Eye;
use crate::film::render::{Film, PIXELS_PER_TASK};
use crate::film::sampler::{Sampler, Stream, pixel_seed};
use crate::progress::Meter;
use crate::settings::TraceError;

/// Rays per pixel, a power of two. What covers less than about one in so many may be overlooked.
const SAMPLES: u32 = 64;
/// One for all renders: regions are not to depend on the seed of a truth.
const SEED: u64 = 0;

/// What one pixel's rays met.
struct Glimpse {
    /// Per object id, whether it was seen.
    seen: Vec<bool>,
    /// Whether anything was seen that the frame of the instant does not show.
    unknowable: bool,
}

/// Probes the scene over canvas and times of `film`, which must recall the instant; nothing else of it is used. `moving` tells
/// per object id whether it moves on screen.
pub(crate) fn trace_support(
    film: &Film,
    moving: &[bool],
    meter: &Meter,
) -> Result<Support, TraceError> {
    let tasks = (film.canvas.pixels())
        .par_chunks(PIXELS_PER_TASK)
        .map(|task| {
            let mut eye = Eye::new(film.integrator.stage, film.canvas);
            // No progress of a replicate, but a chance to cancel it.
            meter.advance(0);
            meter.check()?;
            Ok((task.iter())
                .map(|&pixel| glimpse(film, &mut eye, pixel))
                .collect())
        })
        .collect::<Result<Vec<Vec<Glimpse>>, TraceError>>()?;
    let glimpses = Raster {
        width: film.canvas.columns(),
        height: film.canvas.rows(),
        pixels: tasks.into_iter().flatten().collect(),
    };
    let moves =
        |glimpse: &Glimpse| (glimpse.seen.iter().zip(moving)).any(|(seen, moves)| *seen && *moves);
    Ok(Support {
        seen: (0..moving.len())
            .map(|object| glimpses.map(|glimpse| glimpse.seen[object]))
            .collect(),
        moving: glimpses.map(moves),
        unknowable: glimpses.map(|glimpse| glimpse.unknowable),
    })
}

fn glimpse(film: &Film, eye: &mut Eye, pixel: u32) -> Glimpse {
    let stage = film.integrator.stage;
    let recall = film
        .recall
        .as_ref()
        .expect("the film of a truth recalls the instant");
    let [left, top] = film.canvas.corner(pixel);
    let row = pixel / film.canvas.columns();
    let seed = pixel_seed(SEED, Stream::Support, film.canvas.number(pixel), 0);
    let mut found = Glimpse {
        seen: vec![false; stage.scene.objects.len() + 1],
        unknowable: false,
    };
    for index in 0..SAMPLES {
        let [x, y, part, _] = Sampler::new(seed, index).camera();
        let time = film.times.at(part, row, film.canvas.height);
        let ray = eye.look(time).ray(left + x, top + y);
        let hit = stage.closest(&mut eye.poses, &ray);
        found.seen[hit.map_or(0, |hit| hit.object + 1)] = true;
        if !found.unknowable {
            let poses = (&mut eye.poses, &mut eye.instant);
            found.unknowable = !recall.knows(stage, poses, &ray, hit.as_ref());
        }
    }
    found
}
