//! Import of models as scene folders: an OBJ file on a stand, with floor, wall, a framed camera and
//! motion; a glTF file with its own animation.

mod document;
mod framing;
mod gltf;
mod model;
mod plan;
mod series;
mod set;
mod staging;

use frame::write_atomically;
use measure::Error;
use scene::load_scene;

use crate::files::name_of;

pub use self::gltf::{GltfPlan, import_gltf};
use self::model::Model;
pub use self::model::Up;
pub use self::plan::{ImportPlan, Motions};
use self::series::Series;
pub use self::staging::Imported;
use self::staging::{Written, make_folder};

/// Note about a model with materials of an opacity below 1.
const TRANSLUCENT: &str = "some materials have an opacity below 1, so that light passes through them: scene.toml has alpha = \"blended\"";

/// Makes the scene folder of an OBJ file or a folder of them, complete or not at all.
pub fn import(plan: &ImportPlan) -> Result<Imported, Error> {
    let series = if plan.is_series() {
        Series::list(&plan.model, plan.frames)?
    } else {
        plan.motions.check()?;
        Series::of_one(&plan.model)
    };
    make_folder(&plan.out, |folder| {
        let model = Model::copy(&series, plan.plain, plan.up, folder)?;
        set::write_set(folder, &model)?;
        let document = document::scene_toml(plan, &model);
        write_atomically(&folder.join("scene.toml"), document.as_bytes())?;
        let translucent = model.is_translucent.then(|| TRANSLUCENT.to_owned());
        Ok(Written {
            scene: load_scene(folder, None)?,
            notes: translucent.into_iter().collect(),
            lines: series_line(&series).into_iter().collect(),
        })
    })
}

/// Says which frame each file of a series is.
fn series_line(series: &Series) -> Option<String> {
    let count = series.files.len();
    (count > 1).then(|| {
        let instant = &series.files[(-series.first) as usize];
        format!(
            "{count} key shapes, one per frame; the frame is {}",
            name_of(instant)
        )
    })
}
