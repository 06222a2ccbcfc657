//! Bench of the mutants: scenes, their settings, and the adapter.

use std::fs;
use std::path::PathBuf;
use std::rc::Rc;

use cli::{SceneChoice, select_scenes};
use filters::Gpu;
use judge::{RunBounds, read_bounds, size_for_bounds};
use suite::{Error, FilterChoice, Run, RunPlan, measure_scenes};
use tests::scenes;
use tracer::{RenderSettings, Scene};

use crate::options::Options;
use crate::subject::Subject;

/// Seed of the truth that mutants are checked against, as in `check`.
pub const SEED: u64 = 1;

pub struct Bench {
    /// Scenes in the order in which mutants run on them.
    pub scenes: Rc<Vec<Scene>>,
    pub bounds: RunBounds,
    pub render: RenderSettings,
    pub gpu: Gpu,
    pub out: PathBuf,
}

impl Bench {
    pub fn open(options: &Options, subjects: &[Subject]) -> Result<Self, Error> {
        let scenes = select_scenes(scenes(), &options.scenes)?;
        let mut bounds = RunBounds::new();
        for SceneChoice { scene, folder, .. } in &scenes {
            let own = read_bounds(tests::scenes(), folder, options.size)?;
            bounds.insert(scene.id.clone(), own);
        }
        let sound: Vec<_> = subjects.iter().map(|it| it.sound.clone()).collect();
        let shipped = match options.size {
            None => size_for_bounds(bounds.values(), &sound, None)?,
            size => size,
        };
        let size = shipped.ok_or(Error::Usage(
            "no limit on these filters names a size; name one: --size 160x90".to_owned(),
        ))?;
        let render = RenderSettings {
            width: size.0,
            height: size.1,
            samples_per_pixel: options.samples,
            seed: SEED,
            ..RenderSettings::default()
        };
        let name = format!("{}x{}_{}", size.0, size.1, options.samples);
        let out = options.out.join(name);
        fs::create_dir_all(&out)
            .map_err(|error| Error::Usage(format!("{}: {error}", out.display())))?;
        Ok(Self {
            bounds: (bounds.into_iter())
                .map(|(scene, bounds)| (scene, bounds.at(size)))
                .collect(),
            scenes: Rc::new(scenes.into_iter().map(|choice| choice.scene).collect()),
            render,
            gpu: tests::open_gpu(),
            out,
        })
    }

    pub fn truths(&self, seed: u64) -> PathBuf {
        self.out.join(format!("seed_{seed}"))
    }

    /// Runs filters on a scene and measures their pictures as `check` does.
    pub fn measure(
        &self,
        scene: &Scene,
        filters: Vec<FilterChoice>,
        seed: u64,
    ) -> Result<Run, Error> {
        let plan = RunPlan {
            scenes: vec![scene.clone()],
            filters,
            render: RenderSettings {
                seed,
                ..self.render
            },
            out: self.truths(seed),
            intervals: true,
            // Equivalent sub-frames are not limited.
            ladders: false,
            ..RunPlan::default()
        };
        measure_scenes(&plan, Some(&self.gpu), Vec::new())
    }

    /// Opens the adapter again, after it was left busy with kernels that take too long.
    pub fn reopen_gpu(&mut self) {
        self.gpu = tests::open_gpu();
    }
}
