//! One-frame oracle: about the best picture that one frame with straight motion can give, far too
//! slow for a filter.

use frame::{Efficiency, Frame, Picture, Raster, Shutter, ShutterProfile, Size, Truth};
use rayon::prelude::*;

/// Least number of instants.
const MIN_INSTANTS: u32 = 64;
/// Instants per pixel that the fastest pixel moves.
const INSTANTS_PER_PIXEL: f64 = 4.0;
/// Upper limit on the instants.
const MAX_INSTANTS: u32 = 1024;
/// Instants whose pictures are in memory together.
const TOGETHER: usize = 16;

/// A place that no pixel reached, with its number among all holes in the other bits.
const HOLE: u32 = 1 << 31;

/// The pixels of a frame, by whether they move.
struct Sources<'a> {
    frame: &'a Frame,
    /// Each pixel that stays in its place; a hole in the place of others.
    still: Vec<u32>,
    moving: Vec<u32>,
    /// Delay of the shutter per row of the frame, frames.
    delays: Vec<f64>,
}

/// The numbers of each pixel that are not 0: its colour, then its coverages, for each of the
/// pictures.
struct Content {
    /// Index of each pixel's first number; after the last pixel that of all.
    starts: Vec<usize>,
    /// Channel and number.
    numbers: Vec<(u32, f32)>,
}

/// A pixel that may fill a hole.
#[derive(Clone, Copy)]
struct Fill {
    source: u32,
    depth: f32,
    distance: u32,
}

/// Moves every pixel of the frame along its velocity for many instants of the shutter, lets the
/// nearer hide the farther, fills each hole with the farthest of the pixels that are nearest to it
/// in the four directions, and averages. The picture is as large as the frame, guard band included.
pub fn scatter_oracle(frame: &Frame, shutter: Shutter, profile: &ShutterProfile) -> Picture {
    let picture = frame.picture();
    scatter_oracles(frame, &[&picture], shutter, profile).remove(0)
}

/// Scatters several pictures as [`scatter_oracle`] does the frame's own, all with the frame's
/// velocity and depth.
pub fn scatter_oracles(
    frame: &Frame,
    pictures: &[&Picture],
    shutter: Shutter,
    profile: &ShutterProfile,
) -> Vec<Picture> {
    let sources = Sources::new(frame, profile);
    let content = Content::new(pictures);
    let own_channels = 3 + frame.coverage.len();
    let channels = own_channels * pictures.len();
    let mut sums = vec![0.0_f64; frame.color.pixels.len() * channels];
    for together in place_instants(frame, shutter, &profile.efficiency).chunks(TOGETHER) {
        let seen = |(time, weight): &(f64, f64)| (*weight, fill_holes(frame, sources.at(*time)));
        let seen: Vec<(f64, Vec<u32>)> = together.par_iter().map(seen).collect();
        let pixels = sums.par_chunks_mut(channels).enumerate();
        pixels.for_each(|(pixel, sums)| {
            for (weight, seen) in &seen {
                for (channel, number) in content.of(seen[pixel]) {
                    sums[*channel as usize] += weight * f64::from(*number);
                }
            }
        });
    }
    let Size { width, height } = frame.size();
    let at =
        |x: u32, y: u32, channel: usize| sums[(y * width + x) as usize * channels + channel] as f32;
    (0..pictures.len())
        .map(|picture| picture * own_channels)
        .map(|first| Picture {
            color: Raster::from_fn(width, height, |x, y| [0, 1, 2].map(|c| at(x, y, first + c))),
            coverage: (first + 3..first + own_channels)
                .map(|channel| Raster::from_fn(width, height, |x, y| at(x, y, channel)))
                .collect(),
        })
        .collect()
}

/// Makes the oracle's picture through the shutter of a truth, without the frame's guard band.
pub fn make_oracle(frame: &Frame, truth: &Truth) -> Picture {
    scatter_oracle(frame, truth.shutter, &truth.shutter_profile).cropped(frame.guard_band)
}

/// Makes the oracle's pictures of the frame and of parts of its replicates, as [`make_oracle`]
/// does.
pub fn make_oracles(frame: &Frame, parts: &[Picture], truth: &Truth) -> (Picture, Vec<Picture>) {
    let picture = frame.picture();
    let pictures: Vec<&Picture> = std::iter::once(&picture).chain(parts).collect();
    let made = scatter_oracles(frame, &pictures, truth.shutter, &truth.shutter_profile);
    let mut made = made
        .into_iter()
        .map(|picture| picture.cropped(frame.guard_band));
    let oracle = made.next().expect("the frame is one of them");
    (oracle, made.collect())
}

/// Lists times of the shutter, each with its share of the light.
fn place_instants(frame: &Frame, shutter: Shutter, efficiency: &Efficiency) -> Vec<(f64, f64)> {
    let speeds = frame.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
    let distance = f64::from(speeds.fold(0.0, f32::max)) * shutter.exposure();
    let wanted = (INSTANTS_PER_PIXEL * distance).ceil() as u32;
    let count = wanted.clamp(MIN_INSTANTS, MAX_INSTANTS);
    let knots = efficiency.knots();
    let middles = (0..count).map(|index| (f64::from(index) + 0.5) / f64::from(count));
    let total: f64 = middles.clone().map(|part| light_at(&knots, part)).sum();
    middles
        .map(|part| (shutter.at(part), light_at(&knots, part) / total))
        .collect()
}

/// Interpolates how much light passes at a part of the interval.
fn light_at(knots: &[[f64; 2]], part: f64) -> f64 {
    let next = knots.partition_point(|[at, _]| *at <= part);
    let [from, to] = [knots[next - 1], knots[next.min(knots.len() - 1)]];
    let length = to[0] - from[0];
    if length > 0.0 {
        from[1] + (part - from[0]) / length * (to[1] - from[1])
    } else {
        to[1]
    }
}

impl<'a> Sources<'a> {
    fn new(frame: &'a Frame, profile: &ShutterProfile) -> Self {
        let Size {
            width,
            height: rows,
        } = frame.size();
        let height = rows - 2 * frame.guard_band;
        let delay = |row: u32| {
            let row = row.saturating_sub(frame.guard_band).min(height - 1);
            profile.row_offset(row, height)
        };
        let stays = |source: &u32| frame.velocity.pixels[*source as usize] == [0.0; 2];
        let all = 0..width * rows;
        Self {
            frame,
            still: (all
                .clone()
                .map(|source| if stays(&source) { source } else { HOLE }))
            .collect(),
            moving: all.filter(|source| !stays(source)).collect(),
            delays: (0..rows).map(delay).collect(),
        }
    }

    /// Finds, per pixel, which pixel of the frame is there at a time: the nearest to the camera,
    /// and the first of several.
    fn at(&self, time: f64) -> Vec<u32> {
        let Size { width, height } = self.frame.size();
        let depth = |source: u32| self.frame.depth.pixels[source as usize];
        let mut seen = self.still.clone();
        for &source in &self.moving {
            let [column, row] = [source % width, source / width];
            let time = (time + self.delays[row as usize]) as f32;
            let [right, down] = self.frame.velocity.pixels[source as usize];
            let x = column as f32 + 0.5 + right * time;
            let y = row as f32 + 0.5 + down * time;
            if !(0.0..width as f32).contains(&x) || !(0.0..height as f32).contains(&y) {
                continue;
            }
            let place = &mut seen[(y as u32 * width + x as u32) as usize];
            if *place == HOLE || (depth(source), source) < (depth(*place), *place) {
                *place = source;
            }
        }
        seen
    }
}

impl Content {
    fn new(pictures: &[&Picture]) -> Self {
        let mut starts = vec![0];
        let mut numbers = Vec::new();
        for pixel in 0..pictures[0].color.pixels.len() {
            let of_picture = |picture: &&'_ Picture| {
                let color = picture.color.pixels[pixel].into_iter();
                let coverage = picture.coverage.iter().map(|plane| plane.pixels[pixel]);
                color.chain(coverage).collect::<Vec<f32>>()
            };
            let content = (0..).zip(pictures.iter().flat_map(of_picture));
            numbers.extend(content.filter(|(_, number)| *number != 0.0));
            starts.push(numbers.len());
        }
        Self { starts, numbers }
    }

    /// Channels and numbers of a pixel.
    fn of(&self, pixel: u32) -> &[(u32, f32)] {
        &self.numbers[self.starts[pixel as usize]..self.starts[pixel as usize + 1]]
    }
}

/// Fills the places that no pixel reached. Of the pixels that are met first to the left, to the
/// right, above and below, the farthest wins, then the nearest in the picture.
fn fill_holes(frame: &Frame, mut seen: Vec<u32>) -> Vec<u32> {
    let width = frame.color.width as usize;
    let holes: Vec<usize> = (0..seen.len())
        .filter(|place| seen[*place] == HOLE)
        .collect();
    for (number, place) in holes.iter().enumerate() {
        seen[*place] |= number as u32;
    }
    let left = |place: usize| (!place.is_multiple_of(width)).then(|| place - 1);
    let right = |place: usize| (!(place + 1).is_multiple_of(width)).then_some(place + 1);
    let above = |place: usize| place.checked_sub(width);
    let below = |place: usize| (place + width < seen.len()).then_some(place + width);
    let mut fills: Vec<Option<Fill>> = vec![None; holes.len()];
    let mut offers = fills.clone();
    let mut offer = |number: usize, neighbour: Option<usize>| {
        offers[number] = neighbour.and_then(|place| match seen[place] & HOLE {
            0 => Some(Fill {
                source: seen[place],
                depth: frame.depth.pixels[seen[place] as usize],
                distance: 1,
            }),
            _ => offers[(seen[place] & !HOLE) as usize].map(|fill| Fill {
                distance: fill.distance + 1,
                ..fill
            }),
        });
        if let Some(offered) = offers[number]
            && fills[number].is_none_or(|fill| {
                offered.depth > fill.depth
                    || (offered.depth == fill.depth && offered.distance < fill.distance)
            })
        {
            fills[number] = Some(offered);
        }
    };
    // A hole's neighbour has its offer before it.
    let each = || holes.iter().copied().enumerate();
    each().for_each(|(number, place)| offer(number, left(place)));
    each()
        .rev()
        .for_each(|(number, place)| offer(number, right(place)));
    each().for_each(|(number, place)| offer(number, above(place)));
    each()
        .rev()
        .for_each(|(number, place)| offer(number, below(place)));
    for (place, fill) in holes.into_iter().zip(fills) {
        // All of the frame may have left it.
        seen[place] = fill.map_or(place as u32, |fill| fill.source);
    }
    seen
}
