//! The import of a glTF file, from reading to the scene's folder.

use std::path::Path;

use frame::write_atomically;
use measure::Error;
use scene::{Family, Scene, load_scene};

use super::choice::choose_camera;
use super::document::Head;
use super::file::File;
use super::frame_model::{Extent, frame_model, set_toml};
use super::keys::{Keys, Tolerance, find_keys};
use super::light::{Lights, ball_text, radiance};
use super::material::Materials;
use super::moment::Clip;
use super::objects::{FOLDER, Objects, Shot};
use super::picture::{choose_stops, list_lost};
use super::piece::Piece;
use super::pieces::list_pieces;
use super::plan::GltfPlan;
use super::reading::{choose_clip, read_stage};
use super::stage::Stage;
use super::view::{Camera, CameraPath, Film, View};
use crate::files::{name_of, refusal, refuse};
use crate::import::framing::{SIZE, check_radius};
use crate::import::set::write_backdrop;
use crate::import::staging::{Imported, Written, make_folder};

/// Part of the tolerance that the camera's keys use.
const TOLERANCE: Tolerance = Tolerance {
    stray: 0.02,
    velocity: 0.02,
};

/// Points that the camera's path is measured on.
const CAMERA_POINTS: usize = 2000;

/// Makes the scene folder of a glTF file, complete or not at all.
pub fn import_gltf(plan: &GltfPlan) -> Result<Imported, Error> {
    let path = &plan.model;
    let file = File::read(path)?;
    let mut notes = Vec::new();
    let stage = read_stage(plan, file, &mut notes).map_err(|reason| refusal(path, reason))?;
    let clip = choose_clip(plan, &stage).map_err(|reason| refusal(path, reason))?;
    make_folder(&plan.out, |folder| {
        Import {
            plan,
            stage: &stage,
            clip,
            folder,
            notes,
        }
        .write()
    })
}

/// An import in progress.
struct Import<'a> {
    plan: &'a GltfPlan,
    stage: &'a Stage,
    clip: Clip,
    folder: &'a Path,
    notes: Vec<String>,
}

impl Import<'_> {
    fn write(mut self) -> Result<Written, Error> {
        let (stage, path) = (self.stage, &self.plan.model);
        let mut materials = Materials::new(&stage.file, &self.folder.join(FOLDER));
        let pieces = list_pieces(stage, &self.clip, &mut materials)?;
        if pieces.is_empty() {
            return refuse!(path, "shows no triangles; export meshes of a scene");
        }
        let plain: Vec<Piece> = pieces.iter().map(|(piece, _)| piece.clone()).collect();
        let extent = Extent::of(stage, &self.clip, &plain);
        let (camera, film) = self.choose_camera(&extent)?;
        let marks = self.clip.marks(&stage.animation);
        let shot = Shot {
            stage,
            clip: self.clip,
            marks,
            film,
            camera,
        };
        let camera_keys = self.camera_keys(&shot, &plain)?;
        let mut objects = Objects::default();
        for (piece, looks) in &pieces {
            objects.push(&shot, piece, looks, self.folder)?;
        }
        let moment = self.clip.moment(0.0);
        let lights = Lights::read(stage, moment, &mut materials.lost);
        let lights = lights.map_err(|reason| refusal(path, reason))?;
        self.write_lights(&lights, &extent, &mut objects, &mut materials)?;
        if matches!(camera, Camera::Around { .. }) {
            objects.toml += &set_toml(&extent);
            write_backdrop(self.folder, extent.radius())?;
        }
        let mtl = self.folder.join(FOLDER).join("materials.mtl");
        write_atomically(&mtl, materials.text.as_bytes())?;
        let head = Head {
            exposes: self.exposes(),
            family: family(&objects, camera_keys.list.len() > 1),
            exposure: self.plan.exposure,
            film,
            camera: &camera_keys,
            lights: &lights,
        };
        self.count_lost(&mut materials);
        self.finish(&head, &objects, &materials)
    }

    fn choose_camera(&mut self, extent: &Extent) -> Result<(Camera, Film), Error> {
        let (plan, path) = (self.plan, &self.plan.model);
        let chosen = choose_camera(self.stage, plan.camera.as_deref());
        let (chosen, note) = chosen.map_err(|reason| refusal(path, reason))?;
        if let (Some(chosen), None) = (&chosen, plan.orbit) {
            self.notes.extend(note);
            let lens = chosen.lens;
            let aspect = lens.aspect_ratio.unwrap_or(16.0 / 9.0);
            let fov = lens.yfov;
            if !(0.1..=10.0).contains(&aspect) || !(1e-4..3.1).contains(&fov) {
                return refuse!(
                    path,
                    "its camera has the aspectRatio {aspect} and a yfov of {fov}; allowed: 0.1 to 10, and 0.0001 to 3.1 radians"
                );
            }
            let film = Film {
                width: SIZE.width,
                height: (f64::from(SIZE.width) / aspect).round() as u32,
                vertical_fov: fov,
            };
            return Ok((Camera::Node(chosen.node), film));
        }
        check_radius(extent.radius()).map_err(|reason| refusal(path, reason))?;
        if chosen.is_some() {
            self.notes
                .push("the orbiting camera replaces the file's own".to_owned());
        } else {
            self.notes.extend(note);
            self.notes.push(
                "the file has no perspective camera; one is framed on the model, with a floor and a wall".to_owned(),
            );
        }
        Ok(frame_model(extent, plan.orbit.unwrap_or(0.0)))
    }

    fn camera_keys(&self, shot: &Shot, pieces: &[Piece]) -> Result<Keys<View>, Error> {
        let moment = self.clip.moment(0.0);
        if !shot.camera.is_moving(self.stage) {
            return Ok(Keys::still(moment, shot.camera.view(self.stage, moment)));
        }
        let pieces = pieces.iter();
        let points: Vec<_> = pieces
            .flat_map(|piece| piece.positions(self.stage, moment.seconds))
            .collect();
        let step = points.len().div_ceil(CAMERA_POINTS).max(1);
        let path = CameraPath {
            stage: self.stage,
            film: shot.film,
            camera: shot.camera,
            points: points.into_iter().step_by(step).collect(),
        };
        let keys = find_keys(&path, &shot.marks, TOLERANCE);
        keys.map_err(|reason| refusal(&self.plan.model, format_args!("its camera {reason}")))
    }

    /// Writes a small ball for each point light.
    fn write_lights(
        &mut self,
        lights: &Lights,
        extent: &Extent,
        objects: &mut Objects,
        materials: &mut Materials,
    ) -> Result<(), Error> {
        /// Radius of a ball, in radii of the model.
        const RADIUS: f64 = 0.005;
        let radius = RADIUS * extent.radius();
        for (number, light) in lights.points.iter().enumerate() {
            let name = format!("point_light_{number}");
            let (text, area) = ball_text(radius, &name);
            let mesh = format!("{FOLDER}/{name}.obj");
            write_atomically(&self.folder.join(&mesh), text.as_bytes())?;
            let [r, g, b] = radiance(light.intensity, area).to_array();
            materials.text += &format!("newmtl {name}\nKd 0 0 0\nKe {r} {g} {b}\n");
            let world = self.stage.world(light.node, self.clip.moment(0.0).seconds);
            objects.toml += &format!(
                "\n[object.{name}]\nmesh = \"{mesh}\"\ntranslation = {}\n",
                super::objects::vector_text(world.w_axis.truncate())
            );
        }
        match lights.count {
            0 => self
                .notes
                .push("the file has no light; a sky and a sun are added".into()),
            _ => self.notes.push("the file has no sky; one is added".into()),
        }
        if !lights.points.is_empty() {
            self.notes.push(format!(
                "point lights are glowing balls of {radius:.2e} m, where they are at the instant"
            ));
        }
        Ok(())
    }

    fn exposes(&self) -> String {
        let file = name_of(&self.plan.model);
        let motion = match (&self.stage.animation.range(), self.plan.orbit) {
            (Some(_), _) => format!(
                "animation \"{}\" at {:.4} s, {} frames per second",
                self.stage.animation.name, self.clip.instant, self.clip.rate
            ),
            (None, orbit) => format!(
                "the camera goes around it by {} degrees per frame",
                orbit.unwrap_or_default()
            ),
        };
        format!("Imported from {file}: {motion}.")
    }

    /// Lists what belongs to no material.
    fn count_lost(&mut self, materials: &mut Materials) {
        let meshes = &self.stage.meshes;
        let lost = &mut materials.lost;
        lost.count(
            meshes.unread,
            "mesh of points or lines",
            "meshes of points or lines",
        );
        let unread = self.stage.animation.unread;
        lost.count(unread, "animated property", "animated properties");
        let nodes = self.stage.tree.shown.iter();
        let others =
            nodes.flat_map(|node| self.stage.file.json.nodes[*node].extensions.others.keys());
        lost.others.extend(others.cloned());
        if meshes.reweighted > 0 {
            self.notes.push(format!(
                "the weights of {} vertices do not sum to 1; they are divided by their sum",
                meshes.reweighted
            ));
        }
    }

    /// Loads the scene; errors name the glTF file, since the folder is temporary.
    fn load(&self) -> Result<Scene, Error> {
        load_scene(self.folder, None).or_else(|error| {
            let place = error
                .path
                .strip_prefix(self.folder)
                .unwrap_or(&error.path)
                .display();
            let line = error
                .line
                .map(|line| format!(":{line}"))
                .unwrap_or_default();
            refuse!(
                self.plan.model,
                "makes a scene that is refused: {place}{line}: {}",
                error.reason
            )
        })
    }

    /// Writes scene.toml, loads the scene, and looks at its picture.
    fn finish(
        mut self,
        head: &Head,
        objects: &Objects,
        materials: &Materials,
    ) -> Result<Written, Error> {
        let document = self.folder.join("scene.toml");
        let write =
            |stops| write_atomically(&document, (head.text(stops) + &objects.toml).as_bytes());
        write(None)?;
        let mut scene = self.load()?;
        if let Some(stops) = choose_stops(&scene)? {
            write(Some(stops))?;
            scene.display.stops = stops;
            self.notes.push(format!(
                "the picture would be far from mid-grey; [display] stops = {stops}"
            ));
        }
        if !objects.is_moving && head.camera.list.len() == 1 {
            self.notes
                .push("nothing moves around this instant; choose another with --time".to_owned());
        }
        let mut lines = vec![keys_line(objects, head.camera)];
        let lost = list_lost(&scene, &materials.lost)?;
        if !lost.is_empty() {
            lines.push(format!("no counterpart: {}", lost.join(", ")));
        }
        Ok(Written {
            scene,
            notes: self.notes,
            lines,
        })
    }
}

fn keys_line(objects: &Objects, camera: &Keys<View>) -> String {
    let stray = objects.stray + camera.stray;
    let count = |count: usize, one: &str, many: &str| match count {
        1 => format!("1 {one}"),
        _ => format!("{count} {many}"),
    };
    let mut parts = Vec::new();
    if objects.rigid > 0 {
        parts.push(count(objects.rigid, "rigid object", "rigid objects"));
    }
    if objects.deforming > 0 {
        let deforming = count(objects.deforming, "deforming object", "deforming objects");
        parts.push(format!("{deforming} with {} key shapes", objects.shapes));
    }
    format!(
        "{}; no vertex strays by more than {stray:.2} px",
        parts.join(", ")
    )
}

fn family(objects: &Objects, is_camera_moving: bool) -> Family {
    if objects.deforming > 0 {
        Family::Deforming
    } else if objects.is_turning {
        Family::Rotation
    } else if objects.is_moving || !is_camera_moving {
        Family::Translation
    } else {
        Family::Camera
    }
}
