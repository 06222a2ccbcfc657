//! The camera and all poses, at the time of one sample after the other.

use bvh::Ray;
use frame::Size;
use scene::Scene;

use crate::film::canvas::Canvas;
use crate::motion::lens::LensPoint;
use crate::motion::poses::Poses;
use crate::motion::view::View;
use crate::sampler::Sampler;
use crate::stage::Stage;

/// A ray of the camera.
#[derive(Clone, Copy)]
pub(crate) struct EyeRay {
    pub ray: Ray,
    /// Point of the lens that it comes from.
    pub from: LensPoint,
}

/// The camera and all poses of one thread.
pub(crate) struct Eye<'a> {
    scene: &'a Scene,
    pub poses: Poses<'a>,
    /// Poses at `t = 0`.
    pub instant: Poses<'a>,
    view: View,
    moves: bool,
    size: Size,
}

impl<'a> Eye<'a> {
    pub fn new(stage: &Stage<'a>, canvas: Canvas) -> Self {
        let scene = stage.scene;
        let poses = stage.poses();
        let mut instant = stage.poses();
        instant.at(0.0);
        Self {
            scene,
            view: View::new(
                &scene.camera,
                poses.time(),
                canvas.view.width,
                canvas.view.height,
            ),
            poses,
            instant,
            moves: !scene.camera.stands_still(),
            size: canvas.view,
        }
    }

    /// Moves everything to `time`; returns the ray of a sample through a place of the picture.
    pub fn ray_at(&mut self, time: f64, place: [f64; 2], sampler: &Sampler) -> EyeRay {
        let lens = self.scene.camera.lens;
        let from = lens.map_or(LensPoint::CENTRE, |lens| {
            LensPoint::new(&lens, sampler.lens())
        });
        let ray = self.view_at(time).ray_through(place, from);
        EyeRay { ray, from }
    }

    /// Moves everything to `time`; returns the camera's view.
    fn view_at(&mut self, time: f64) -> &View {
        self.poses.at(time);
        if self.moves {
            self.view = View::new(&self.scene.camera, time, self.size.width, self.size.height);
        }
        &self.view
    }
}
