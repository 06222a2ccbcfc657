//! The truth: the picture of a camera with an open shutter.

use std::path::Path;

use rayon::prelude::*;

use crate::exr::{ExrFile, read_exr, write_small_exr};
use crate::raster::{gather, mean_plane};
use crate::region::{dilate, estimate_noise};
use crate::shutter::{get_shutter, set_shutter};
use crate::{
    Alignment, AtInstant, FileError, Image, Picture, Plane, Provenance, Raster, Region, Regions,
    Replicate, Shutter, ShutterProfile, Size, Support,
};

/// Radiance and visibility integrated over the shutter, with its own noise. All rasters have the
/// same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Origin of the truth.
    pub provenance: Provenance,
    /// The interval integrated over.
    pub shutter: Shutter,
    /// Opening and closing of the shutter, and delay between rows.
    pub shutter_profile: ShutterProfile,
    /// Position of that interval relative to the instant.
    pub alignment: Alignment,
    /// Object names; the index is the object id, and 0 is `background`.
    pub objects: Vec<String>,
    /// Means of the even and of the odd replicates.
    pub halves: [Picture; 2],
    /// State at the instant of everything that the shutter saw; halved in the same way.
    pub at_instant: [AtInstant; 2],
    /// Samples per pixel over all replicates: more where the picture is noisy.
    pub samples: Plane,
    /// Standard error of [`Truth::mean`], from the spread of the replicates.
    pub standard_error: Image,
    /// Fraction of (shutter x pixel area) in which the visible surface moves on screen while the
    /// shutter is open.
    pub motion: Plane,
    /// Pixels that scores are pooled over; unlike the other rasters it has no noise.
    pub support: Support,
}

/// Replicates that cannot form a truth: what was found, and what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TruthError {
    /// An odd number has no two halves.
    #[error("found {0} replicates; allowed: even numbers from 2, for the halves of a truth")]
    Count(usize),
    /// A replicate is missing or there twice.
    #[error(
        "replicate {found} is at the place of replicate {index}; each from 0 on is needed once"
    )]
    Index {
        /// The index that belongs there.
        index: u32,
        /// The index that was found.
        found: u32,
    },
    /// Replicates of different truths.
    #[error(
        "replicate {index} was made from other inputs (content hash {found}) than replicate 0 ({expected}); \
         replicates of one scene, size, seed and tracer are needed"
    )]
    Foreign {
        /// Index of the replicate.
        index: u32,
        /// Its content hash.
        found: String,
        /// Content hash of the first.
        expected: String,
    },
    /// Replicates that name one origin and cannot share it.
    #[error(
        "replicate {index} has another {what} than replicate 0, though both name one content hash; remove both files and \
         render them anew"
    )]
    Unlike {
        /// Index of the replicate.
        index: u32,
        /// Difference: `size`, `list of objects`, `shutter`, `number of samples`, `support`.
        what: &'static str,
    },
}

impl Truth {
    /// Averages `replicates`, and each half of them. They are an even number, in the order of their
    /// indices from 0.
    pub fn of(replicates: &[Replicate]) -> Result<Self, TruthError> {
        if replicates.is_empty() || !replicates.len().is_multiple_of(2) {
            return Err(TruthError::Count(replicates.len()));
        }
        let first = &replicates[0];
        let expected = &first.provenance.content_hash;
        for (index, replicate) in (0..).zip(replicates) {
            if replicate.index != index {
                return Err(TruthError::Index {
                    index,
                    found: replicate.index,
                });
            }
            let hash = &replicate.provenance.content_hash;
            if hash != expected {
                return Err(TruthError::Foreign {
                    index,
                    found: hash.clone(),
                    expected: expected.clone(),
                });
            }
            if let Some(what) = first.find_difference(replicate) {
                return Err(TruthError::Unlike { index, what });
            }
        }
        let half = |first: usize| replicates.iter().skip(first).step_by(2);
        let pictures =
            || [0, 1].map(|first| Picture::mean(half(first).map(|replicate| &replicate.picture)));
        let at_instant =
            |first| AtInstant::mean(half(first).map(|replicate| &replicate.at_instant));
        let (halves, (at_instant, standard_error)) = rayon::join(pictures, || {
            ([0, 1].map(at_instant), estimate_error(replicates))
        });
        let count = replicates.len() as u32;
        Ok(Self {
            provenance: Provenance {
                samples_per_pixel: count.saturating_mul(first.provenance.samples_per_pixel),
                replicates: count,
                content_hash: truth_hash(expected, count),
                ..first.provenance.clone()
            },
            shutter: first.shutter,
            shutter_profile: first.shutter_profile.clone(),
            alignment: first.alignment,
            objects: first.objects.clone(),
            motion: sum_motion(&Picture::mean(&halves), &first.moving),
            standard_error,
            samples: first.samples.map(|samples| samples * count as f32),
            support: first.support.clone(),
            halves,
            at_instant,
        })
    }

    /// Returns the size of its pictures.
    pub fn size(&self) -> Size {
        self.motion.size()
    }

    /// Averages the state at the instant over all replicates.
    pub fn at_instant_mean(&self) -> AtInstant {
        AtInstant::mean(&self.at_instant)
    }

    /// Makes the mean with shading frozen at the instant: see [`AtInstant::frozen`].
    pub fn frozen_mean(&self) -> Image {
        self.at_instant_mean().frozen(&self.mean().color)
    }

    /// Makes the halves with shading frozen at the instant.
    pub fn frozen_halves(&self) -> [Image; 2] {
        [0, 1].map(|half| self.at_instant[half].frozen(&self.halves[half].color))
    }

    /// Averages all replicates.
    pub fn mean(&self) -> Picture {
        Picture::mean(&self.halves)
    }

    /// Lists the noise floor of every region that is not empty: the root mean square error of the
    /// mean's radiance, estimated from the difference of the halves.
    pub fn noise_floors(&self) -> Vec<(Region, f64)> {
        let masks = regions(self);
        let halves = [&self.halves[0].color, &self.halves[1].color];
        (Region::ALL.into_par_iter())
            .filter_map(|region| Some((region, estimate_noise(halves, &masks, region)?)))
            .collect()
    }

    /// Writes the truth as OpenEXR: the mean as `R G B`, `coverage.<object>` and `unknowable`, the
    /// halves of both and of [`AtInstant`] as layers `A` and `B`, `stderr.R/G/B`, `motion`,
    /// `samples`, and the channels of [`Support`]. The attributes `noise_floor_<region>` hold
    /// [`Truth::noise_floors`].
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_small_exr(path, self.to_exr())
    }

    /// Makes the content of the file that [`Truth::write`] writes.
    pub fn to_exr(&self) -> ExrFile {
        let Size { width, height } = self.size();
        let mut file = ExrFile::new(width, height);
        self.mean().push(&mut file, "", &self.objects);
        self.halves[0].push(&mut file, "A", &self.objects);
        self.halves[1].push(&mut file, "B", &self.objects);
        let unknowable = self.at_instant.iter().map(|half| &half.unknowable);
        file.push_owned_plane("unknowable", mean_plane(unknowable));
        self.at_instant[0].push(&mut file, "A");
        self.at_instant[1].push(&mut file, "B");
        file.push_color("stderr", &self.standard_error);
        file.push_plane("motion", &self.motion);
        file.push_plane("samples", &self.samples);
        self.support.push(&mut file, &self.objects);
        file.set("kind", "truth");
        for (region, floor) in self.noise_floors() {
            file.set(&format!("noise_floor_{region}"), floor);
        }
        set_shutter(&mut file, self.shutter, self.alignment);
        self.shutter_profile.set(&mut file);
        file.set("objects", self.objects.join(" "));
        file.set(
            "convention",
            "coverage is the fraction of shutter x pixel area; scene-linear Rec.709",
        );
        self.provenance.set(&mut file);
        file
    }

    /// Reads a truth that [`Truth::write`] wrote, bit for bit.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let mut file = read_exr(path)?;
        file.expect_kind("truth")?;
        let objects = file.objects()?;
        let (shutter, alignment) = get_shutter(&file)?;
        Ok(Self {
            provenance: Provenance::from_exr(&file)?,
            shutter,
            shutter_profile: ShutterProfile::from_exr(&file)?,
            alignment,
            halves: [
                Picture::take_from(&mut file, "A", &objects)?,
                Picture::take_from(&mut file, "B", &objects)?,
            ],
            support: Support::from_exr(&file, &objects)?,
            objects,
            at_instant: [
                AtInstant::from_exr(&file, "A")?,
                AtInstant::from_exr(&file, "B")?,
            ],
            standard_error: file.color("stderr")?,
            motion: file.plane("motion")?,
            samples: file.samples_per_pixel()?,
        })
    }
}

/// Derives the regions from the truth's [`Support`], which its noise does not change.
///
/// Support: pixels where anything moves. Moving: the support dilated by [`motion_margin`]. Static:
/// the rest. Moving pixels are knowable where the support saw nothing that the frame does not show.
pub fn regions(truth: &Truth) -> Regions {
    Regions::new(&truth.support, motion_margin(truth.motion.height))
}

/// Marks the pixels of [`Region::Moving`].
pub fn moving_region(support: &Support) -> Raster<bool> {
    dilate(&support.moving, motion_margin(support.moving.height))
}

/// Pixels on every side of a pixel that FLIP filters together with it, at 67 pixels per degree.
pub const FLIP_REACH: u32 = 10;

/// Marks the pixels whose shading at the instant scores look at: those of [`Region::Moving`], and
/// those that FLIP filters together with them.
pub fn shaded_region(support: &Support) -> Raster<bool> {
    let margin = motion_margin(support.moving.height) + FLIP_REACH;
    dilate(&support.moving, margin)
}

/// Returns the margin around motion that is searched for blur, in pixels: a fifteenth of a
/// picture's height, because bleed leaves the support. The moving region and accumulations include
/// it.
pub fn motion_margin(height: u32) -> u32 {
    (f64::from(height) / 15.0).round() as u32
}

/// Derives a truth's content hash from the hash of its first `count` replicates.
pub fn truth_hash(replicate_hash: &str, count: u32) -> String {
    format!("{replicate_hash}x{count}")
}

/// Estimates the standard error of the replicates' mean.
fn estimate_error(replicates: &[Replicate]) -> Image {
    let count = replicates.len() as f64;
    let colors: Vec<&Image> =
        (replicates.iter().map(|replicate| &replicate.picture.color)).collect();
    gather(&colors, |pixel| {
        std::array::from_fn(|component| {
            let values = (colors.iter()).map(|color| f64::from(color.pixels[pixel][component]));
            let mean = values.clone().sum::<f64>() / count;
            let squares: f64 = values.map(|value| (value - mean).powi(2)).sum();
            (squares / (count * (count - 1.0))).sqrt() as f32
        })
    })
}

/// Sums the coverage of moving objects.
fn sum_motion(mean: &Picture, moving: &[bool]) -> Plane {
    let still = Plane::filled(mean.color.width, mean.color.height, 0.0);
    mean.coverage
        .iter()
        .zip(moving)
        .filter(|(_, moves)| **moves)
        .fold(still, |sum, (coverage, _)| {
            sum.zip(coverage, |sum, coverage| sum + coverage)
        })
}
