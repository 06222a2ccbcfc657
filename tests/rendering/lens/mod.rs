//! A camera with a thin lens, against closed forms and against means of pinholes.

mod blur;
mod defocus;
mod layers;
mod pinholes;

use scene::{Lens, Scene};

/// Gives a scene's camera a lens.
pub fn with_lens(mut scene: Scene, aperture: f64, focus: f64) -> Scene {
    scene.camera.lens = Some(Lens { aperture, focus });
    scene
}
