//! Changes of pictures, in noise floors of the truth.

use filters::{Blur, FilterError, Kernels};
use frame::{Frame, Image, Region, Regions, regions};
use suite::{Error, FilterChoice, Monitor, Rendering};
use tests::picture::frame_input;
use tracer::{Scene, SceneId};

use crate::bench::{Bench, SEED};
use crate::journal::Change;
use crate::study::Study;
use crate::subject::MutantFilter;

const COMPARED: [Region; 2] = [Region::Moving, Region::Full];

/// A scene's frame, and the unchanged filter's picture of it.
struct SoundPicture {
    scene: SceneId,
    frame: Frame,
    regions: Regions,
    /// Noise floors of the truth.
    floors: Vec<(Region, f64)>,
    picture: Image,
}

impl Study<'_, '_> {
    fn lacks_change(&self, mutant: &MutantFilter, scene: &SceneId) -> bool {
        let place = self.subject.place(&mutant.name, scene);
        self.journal.changes.get(&place).is_none()
    }

    /// Measures how much each mutant changes the picture of each scene.
    pub fn measure_changes(&mut self) -> Result<(), Error> {
        let subject = self.subject;
        let mut missing: Vec<&MutantFilter> = subject.mutants.iter().collect();
        missing.retain(|mutant| {
            let mut scenes = self.bench.scenes.iter();
            scenes.any(|scene| self.lacks_change(mutant, &scene.id))
        });
        if missing.is_empty() {
            return Ok(());
        }
        let scenes = (self.bench.scenes.iter())
            .map(|scene| SoundPicture::new(self.bench, scene, &subject.sound))
            .collect::<Result<Vec<_>, _>>()?;
        for (number, mutant) in missing.iter().enumerate() {
            if !(self.due)() {
                return Ok(());
            }
            let (name, count) = (&subject.name, missing.len());
            eprintln!("{name} {number} of {count}: {}", mutant.name);
            let new: Vec<&SoundPicture> = (scenes.iter())
                .filter(|scene| self.lacks_change(mutant, &scene.scene))
                .collect();
            let changes = compare(self.bench, &new, &mutant.choice);
            let is_too_slow =
                |change: &Result<_, _>| matches!(change, Err(FilterError::TooSlow { .. }));
            if changes.iter().any(is_too_slow) {
                self.bench.reopen_gpu();
            }
            for (scene, change) in new.iter().zip(changes) {
                let place = subject.place(&mutant.name, &scene.scene);
                let record = change.map_err(|error| error.to_string());
                self.journal.changes.add(place, record);
            }
        }
        Ok(())
    }
}

/// Compares the pictures of a mutant with the sound filter's. Once one of them takes too long, no other is tried.
fn compare(
    bench: &Bench,
    scenes: &[&SoundPicture],
    choice: &FilterChoice,
) -> Vec<Result<Change, FilterError>> {
    let kernels = match Kernels::compile(&bench.gpu, &choice.filter) {
        Ok(kernels) => kernels,
        Err(error) => return vec![Err(error); scenes.len()],
    };
    let mut given_up: Option<FilterError> = None;
    let changes = scenes.iter().map(|scene| {
        if let Some(error) = &given_up {
            return Err(error.clone());
        }
        let change = blur(&kernels, choice, &scene.frame).and_then(|picture| {
            scene.compare(&picture).ok_or_else(|| FilterError::Input {
                filter: choice.filter.name.clone(),
                reason: "the picture is not finite".to_owned(),
            })
        });
        if let Err(error @ FilterError::TooSlow { .. }) = &change {
            given_up = Some(error.clone());
        }
        change
    });
    changes.collect()
}

fn blur(kernels: &Kernels, choice: &FilterChoice, frame: &Frame) -> Result<Image, FilterError> {
    let (width, height) = frame.size();
    let settings = choice.scaled_to(width).settings;
    let mut blur = Blur::with_kernels(kernels, &settings, width, height)?;
    let outputs = blur.run(&frame_input(frame, &[&frame.color]))?;
    Ok(outputs.into_iter().next().expect("one image comes back"))
}

impl SoundPicture {
    fn new(bench: &Bench, scene: &Scene, sound: &FilterChoice) -> Result<Self, Error> {
        let rendering = Rendering {
            scene,
            settings: bench.render,
            out: &bench.truths(SEED),
            monitor: Monitor::SILENT,
        };
        let frame = rendering.frame()?;
        let truth = rendering.truth(sound.filter.alignment)?;
        Ok(Self {
            scene: scene.id.clone(),
            regions: regions(&truth),
            floors: (truth.noise_floors().into_iter())
                .filter(|(region, floor)| COMPARED.contains(region) && *floor > 0.0)
                .collect(),
            picture: blur(&Kernels::compile(&bench.gpu, &sound.filter)?, sound, &frame)?,
            frame,
        })
    }

    /// Measures the change of a picture; none if the picture is not finite.
    fn compare(&self, picture: &Image) -> Option<Change> {
        let squares = self.picture.zip(picture, |a, b| {
            let square = |c: usize| (f64::from(a[c]) - f64::from(b[c])).powi(2);
            (square(0) + square(1) + square(2)) / 3.0
        });
        let floors = self.floors.iter().map(|(region, floor)| {
            let inside = self.regions.select(*region, &squares);
            let mean = inside.iter().sum::<f64>() / inside.len() as f64;
            mean.sqrt() / floor
        });
        let changed = squares.pixels.iter().filter(|square| **square > 0.0);
        let change = Change {
            share: changed.count() as f64 / squares.pixels.len() as f64,
            floors: floors.fold(0.0, f64::max),
        };
        let is_finite = squares.pixels.iter().all(|square| square.is_finite());
        is_finite.then_some(change)
    }
}
