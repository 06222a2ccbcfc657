//! Frame and truth of a scene that candidates are measured on.

use std::path::Path;

use frame::{Alignment, Frame, Truth};
use judge::SceneBounds;
use metrics::Viewing;
use suite::{Error, Monitor, Rendering};
use tracer::{RenderSettings, Scene};

/// A scene, rendered once and measured against hundreds of times.
pub struct RenderedScene {
    /// The scene's name, with its variant.
    pub name: String,
    /// Input of the filter.
    pub frame: Frame,
    /// Reference that pictures are compared with.
    pub truth: Truth,
    /// The scene's bounds for pictures of this size, for every filter.
    pub bounds: SceneBounds,
    /// Display that errors are seen on.
    pub viewing: Viewing,
}

/// Reads frames and truths of scenes from `out`, or renders and keeps them there.
pub fn render_scenes(
    scenes: &[(Scene, SceneBounds)],
    alignment: Alignment,
    render: &RenderSettings,
    out: &Path,
    monitor: Monitor,
) -> Result<Vec<RenderedScene>, Error> {
    let render_scene = |(scene, bounds): &(Scene, SceneBounds)| {
        let rendering = Rendering {
            scene,
            settings: *render,
            out,
            monitor,
        };
        Ok(RenderedScene {
            name: scene.id.to_string(),
            frame: rendering.frame()?,
            truth: rendering.truth(alignment)?,
            viewing: scene.display.into(),
            bounds: bounds.clone().at((render.width, render.height)),
        })
    };
    scenes.iter().map(render_scene).collect()
}
