//! Frames, truths and ladders, kept on disk so that a second run need not render them again.

use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};

use frame::{
    Alignment, ColorSampling, FileError, Frame, Ladder, Region, Replicate, Truth, VelocityKind,
};
use tracer::{FrameSettings, Scene, TruthSettings, Watch};

use crate::render::memory::check_memory;
use crate::render::replicates::Shelf;
use crate::{Error, Monitor};

/// Sub-frame counts of the ladder that N_eq is read from.
pub const LADDER: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Columns and rows that a picture may have.
pub const SIDES: RangeInclusive<u32> = 16..=16384;

/// A frame has as many samples as so many replicates of a truth, however many the truth has.
const FRAME_REPLICATES: u32 = 8;

/// How scenes are rendered; the scene itself says what it does not override.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Exposure in frames; none takes the scene's.
    pub exposure: Option<f64>,
    /// What the velocity buffer holds.
    pub velocity: VelocityKind,
    /// How the frame's colour is sampled.
    pub color: ColorSampling,
    /// Whether the background has its velocity, or zero.
    pub sky_velocity: bool,
    /// Pixels by which the frame reaches beyond the picture on every side.
    pub guard_band: u32,
    /// Samples per pixel of a truth, over all its replicates.
    pub samples_per_pixel: u32,
    /// Independent, complete renders behind a truth; an even number.
    pub replicates: u32,
    /// Seed of all randomness.
    pub seed: u64,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            width: 320,
            height: 180,
            exposure: None,
            velocity: VelocityKind::Instantaneous,
            color: ColorSampling::Antialiased,
            sky_velocity: true,
            guard_band: 0,
            samples_per_pixel: 256,
            replicates: 8,
            seed: 1,
        }
    }
}

impl RenderSettings {
    /// Another number of replicates, each with as many samples as before.
    pub fn with_replicates(&self, replicates: u32) -> Self {
        let each = self.samples_per_pixel / self.replicates;
        Self {
            samples_per_pixel: each.saturating_mul(replicates),
            replicates,
            ..self.clone()
        }
    }
}

/// Folder of a scene's files below `out`.
pub fn scene_folder(out: &Path, scene: &Scene) -> PathBuf {
    out.join(&scene.name)
}

/// Refuses to write into the folder of a scene: its textures may be called as our pictures are.
pub(crate) fn refuse_scene(folder: &Path) -> Result<(), Error> {
    let file = folder.join("scene.toml");
    match file.exists() {
        false => Ok(()),
        true => Err(Error::Usage(format!(
            "--out: {} holds a scene, whose files would be overwritten; allowed: a folder that holds none, such as out",
            folder.display()
        ))),
    }
}

/// The frame of `scene`: read from `out` if its inputs are the same, else rendered and written there.
pub fn frame_of(
    scene: &Scene,
    settings: &RenderSettings,
    out: &Path,
    monitor: Monitor,
) -> Result<Frame, Error> {
    refuse_scene(&scene_folder(out, scene))?;
    let memory = || check_memory(scene, settings, settings.replicates);
    let settings = frame_settings(scene, settings);
    let artefact = Artefact {
        path: scene_folder(out, scene).join("frame.exr"),
        label: format!("{} frame", scene.name),
        hash: tracer::frame_hash(scene, &settings),
    };
    artefact.obtain(
        monitor,
        |watch| {
            settings.check(scene)?;
            memory()?;
            Ok(tracer::trace_frame(scene, &settings, watch)?)
        },
        (Frame::read, Frame::write, |frame| {
            &frame.provenance.content_hash
        }),
    )
}

/// The truth of `scene` over the shutter of `alignment`: read from `out` if its inputs are the same, else made of its
/// replicates, of which those kept in `out` are not rendered again.
pub fn truth_of(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    out: &Path,
    monitor: Monitor,
) -> Result<Truth, Error> {
    let memory = || check_memory(scene, settings, settings.replicates);
    let settings = truth_settings(scene, settings, alignment);
    let shelf = Shelf::new(scene_folder(out, scene), scene, &settings);
    let expected = tracer::truth_hash(scene, &settings);
    if let Ok(kept) = Truth::read(&shelf.truth_path())
        && kept.provenance.content_hash == expected
    {
        return Ok(kept);
    }
    settings.check(scene)?;
    memory()?;
    let replicates = shelf.obtain(scene, &settings, 0..settings.replicates, monitor)?;
    let truth = Truth::of(&replicates)?;
    truth.write(&shelf.truth_path())?;
    Ok(truth)
}

/// The truth with as many replicates, two by two from the settings' number on, as bring the floor of its noise down to
/// `target` where anything moves (everywhere if nothing does), but at most `most`; and whether they did.
///
/// The floor that ends the render was measured on the same halves that the truth keeps: where it ends early because
/// they happened to agree, the floor reads a little low.
pub fn truth_until(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    (target, most): (f64, u32),
    out: &Path,
    monitor: Monitor,
) -> Result<(Truth, bool), Error> {
    let mut settings = settings.clone();
    loop {
        let truth = truth_of(scene, &settings, alignment, out, monitor)?;
        let (_, floor) = deciding_floor(&truth);
        if floor <= target {
            return Ok((truth, true));
        }
        if settings.replicates + 2 > most {
            return Ok((truth, false));
        }
        settings = settings.with_replicates(settings.replicates + 2);
    }
}

/// The floor that `--noise` is about: of the moving region, or of the whole picture where nothing moves.
pub fn deciding_floor(truth: &Truth) -> (Region, f64) {
    let floors = truth.noise_floors();
    *floors
        .iter()
        .find(|(region, _)| *region == Region::Moving)
        .or(floors.last())
        .expect("a picture has pixels")
}

/// The replicates of a truth: those kept in `out`, the others rendered anew.
pub fn replicates_of(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    out: &Path,
    monitor: Monitor,
) -> Result<Vec<Replicate>, Error> {
    let settings = truth_settings(scene, settings, alignment);
    let shelf = Shelf::new(scene_folder(out, scene), scene, &settings);
    settings.check(scene)?;
    shelf.obtain(scene, &settings, 0..settings.replicates, monitor)
}

/// Renders some replicates of a truth and keeps them in `out`.
pub fn part_of(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    indices: Range<u32>,
    out: &Path,
    monitor: Monitor,
) -> Result<(), Error> {
    let folder = scene_folder(out, scene);
    refuse_scene(&folder)?;
    let memory = || check_memory(scene, settings, indices.len() as u32);
    let settings = truth_settings(scene, settings, alignment);
    let shelf = Shelf::new(folder, scene, &settings);
    settings.check(scene)?;
    memory()?;
    shelf.obtain(scene, &settings, indices, monitor).map(drop)
}

/// A truth and its ladder of accumulations, read from `out` or rendered.
pub fn truth_and_ladder_of(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    out: &Path,
    monitor: Monitor,
) -> Result<(Truth, Ladder), Error> {
    let truth = truth_of(scene, settings, alignment, out, monitor)?;
    let settings = truth_settings(scene, settings, alignment);
    let artefact = Artefact {
        path: scene_folder(out, scene).join(format!("ladder_{alignment}.exr")),
        label: format!("{} sub-frames, {alignment}", scene.name),
        hash: ladder_hash(scene, &settings),
    };
    let ladder = artefact.obtain(
        monitor,
        |watch| {
            Ok(tracer::trace_ladder(
                scene, &settings, &truth, &LADDER, watch,
            )?)
        },
        (Ladder::read, Ladder::write, |ladder| {
            &ladder.provenance.content_hash
        }),
    )?;
    Ok((truth, ladder))
}

pub(crate) fn frame_settings(scene: &Scene, settings: &RenderSettings) -> FrameSettings {
    FrameSettings {
        width: settings.width,
        height: settings.height,
        exposure: settings.exposure.unwrap_or(scene.exposure),
        velocity: settings.velocity,
        color: settings.color,
        sky_velocity: settings.sky_velocity,
        guard_band: settings.guard_band,
        samples_per_pixel: FRAME_REPLICATES * settings.samples_per_pixel / settings.replicates,
        seed: settings.seed,
    }
}

pub(crate) fn truth_settings(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
) -> TruthSettings {
    TruthSettings {
        width: settings.width,
        height: settings.height,
        exposure: settings.exposure.unwrap_or(scene.exposure),
        alignment,
        samples_per_pixel: settings.samples_per_pixel,
        replicates: settings.replicates,
        seed: settings.seed,
    }
}

/// Of the ladder that goes with the truth of these settings.
pub(crate) fn ladder_hash(scene: &Scene, settings: &TruthSettings) -> String {
    tracer::ladder_hash(scene, settings, &LADDER)
}

/// A rendered file: where it lies and what it must have been made from.
struct Artefact {
    path: PathBuf,
    label: String,
    hash: String,
}

/// How a kind of file is read, written and asked for its content hash.
type Format<T> = (
    fn(&Path) -> Result<T, FileError>,
    fn(&T, &Path) -> Result<(), FileError>,
    fn(&T) -> &String,
);

impl Artefact {
    /// A file of the same content hash is used again; any other is rendered anew and replaced.
    fn obtain<T>(
        &self,
        monitor: Monitor,
        render: impl FnOnce(Watch) -> Result<T, Error>,
        (read, write, hash): Format<T>,
    ) -> Result<T, Error> {
        if self.path.exists()
            && let Ok(kept) = read(&self.path)
            && *hash(&kept) == self.hash
        {
            return Ok(kept);
        }
        let made = monitor.watch(&self.label, render)?;
        assert_eq!(
            *hash(&made),
            self.hash,
            "{}: the hash must not depend on the render",
            self.label
        );
        write(&made, &self.path)?;
        Ok(made)
    }
}
