//! Import of models as scene folders: an OBJ file on a stand, with floor, wall, a framed camera and
//! motion; a glTF file with its own animation.

mod document;
mod gltf;
mod model;
mod plan;
mod set;
mod staging;

use frame::write_atomically;
use measure::Error;
use scene::load_scene;

pub use self::gltf::{GltfPlan, import_gltf};
use self::model::Model;
pub use self::model::Up;
pub use self::plan::{ImportPlan, Motions};
pub use self::staging::Imported;
use self::staging::{Written, make_folder};

/// Note about a model with materials of an opacity below 1.
const TRANSLUCENT: &str = "some materials have an opacity below 1, so that light passes through them: scene.toml has alpha = \"blended\"";

/// Makes the scene folder of an OBJ file, complete or not at all.
pub fn import(plan: &ImportPlan) -> Result<Imported, Error> {
    plan.motions.check()?;
    make_folder(&plan.out, |folder| {
        let model = Model::copy(&plan.model, plan.plain, plan.up, folder)?;
        set::write_set(folder, &model)?;
        let document = document::scene_toml(plan, &model);
        write_atomically(&folder.join("scene.toml"), document.as_bytes())?;
        let translucent = model.is_translucent.then(|| TRANSLUCENT.to_owned());
        Ok(Written {
            scene: load_scene(folder, None)?,
            notes: translucent.into_iter().collect(),
            lines: Vec::new(),
        })
    })
}
