//! Sealed variants: scenes changed by a seed, which no tuning has seen.

pub(crate) mod chance;
mod mirror;
mod times;

use std::ops::RangeInclusive;

use glam::{DQuat, Vec3};

use self::chance::Chance;
use self::mirror::mirror;
use crate::model::{Background, Material, Scene};

/// Factor on all speeds.
const SPEED: RangeInclusive<f64> = 0.75..=1.3;
/// Frames by which everything happens earlier or later.
const DELAY: RangeInclusive<f64> = -0.2..=0.2;
/// Degrees by which the camera turns about its line of sight.
const ROLL: RangeInclusive<f64> = -4.0..=4.0;
/// Turn of the camera to the side and upwards, as a fraction of the vertical field of view.
const PAN: RangeInclusive<f64> = -0.05..=0.05;
/// Factor on the width of the field of view.
const ZOOM: RangeInclusive<f64> = 0.9..=1.1;
/// Factor on the albedo of each material.
const SHADE: RangeInclusive<f64> = 0.7..=1.0;

/// The changes that a seed makes to a scene. They keep the scene's subject, and change everything
/// that a preset could have been fitted to: speeds, directions, places in the picture, timing and
/// colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Seal {
    /// The seed.
    pub seed: u64,
    /// The world is mirrored, left for right.
    pub mirrored: bool,
    /// Time runs backwards.
    pub reversed: bool,
    /// Factor on all speeds.
    pub speed: f64,
    /// Frames by which everything happens later.
    pub delay: f64,
    /// Radians by which the camera turns about its line of sight.
    pub roll: f64,
    /// Turn of the camera to the right and upwards, as a fraction of the vertical field of view.
    pub pan: [f64; 2],
    /// Factor on the width of the field of view.
    pub zoom: f64,
    /// Component that becomes red, green and blue.
    pub colors: [usize; 3],
}

impl Seal {
    /// Changes nothing.
    pub const NOTHING: Self = Self {
        seed: 0,
        mirrored: false,
        reversed: false,
        speed: 1.0,
        delay: 0.0,
        roll: 0.0,
        pan: [0.0; 2],
        zoom: 1.0,
        colors: [0, 1, 2],
    };

    /// Largest time of the scene that the sealed one shows `time` frames after its instant, or as
    /// many before it.
    pub(crate) fn farthest(time: f64) -> f64 {
        SPEED.end() * (time + DELAY.end())
    }

    /// Draws the changes of a seed for the scene of a name. Each scene has changes of its own.
    pub fn new(seed: u64, scene: &str) -> Self {
        let mut chance = Chance::new(seed, scene);
        const ORDERS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [0, 2, 1],
            [2, 1, 0],
            [1, 0, 2],
        ];
        Self {
            seed,
            mirrored: chance.between(0.0..=1.0) < 0.5,
            reversed: chance.between(0.0..=1.0) < 0.5,
            speed: chance.between(SPEED),
            delay: chance.between(DELAY),
            roll: chance.between(ROLL).to_radians(),
            pan: [chance.between(PAN), chance.between(PAN)],
            zoom: chance.between(ZOOM),
            colors: ORDERS[(chance.between(0.0..=5.999)) as usize],
        }
    }

    /// Makes the variant of a scene. Name and hash stay the caller's to set.
    pub fn apply(&self, mut scene: Scene) -> Scene {
        self.change_times(&mut scene);
        self.move_camera(&mut scene);
        self.change_colors(&mut scene);
        if self.mirrored { mirror(scene) } else { scene }
    }

    /// Turns the camera about itself, and changes its field of view.
    fn move_camera(&self, scene: &mut Scene) {
        let camera = &mut scene.camera;
        let widest =
            (camera.vertical_fov.iter()).fold(0.0, |widest: f64, (_, fov)| widest.max(*fov));
        let [right, up] = self.pan.map(|part| part * widest);
        let turn = DQuat::from_rotation_y(-right)
            * DQuat::from_rotation_x(up)
            * DQuat::from_rotation_z(self.roll);
        for key in &mut camera.motion.keys {
            key.orientation = (key.orientation * turn).normalize();
        }
        for (_, fov) in &mut camera.vertical_fov {
            *fov = 2.0 * (self.zoom * (*fov / 2.0).tan()).atan();
        }
    }

    /// Swaps the components of all colours, and darkens each material.
    fn change_colors(&self, scene: &mut Scene) {
        let swap = |color: &mut Vec3| *color = Vec3::from(self.colors.map(|from| color[from]));
        let mut shades = Chance::new(self.seed, "shades");
        for Material {
            diffuse,
            emission,
            translucency,
            ..
        } in &mut scene.materials
        {
            swap(diffuse);
            swap(emission);
            if let Some(translucency) = translucency {
                swap(&mut translucency.filter);
            }
            *diffuse *= shades.between(SHADE) as f32;
        }
        for texel in scene
            .textures
            .iter_mut()
            .flat_map(|texture| &mut texture.texels)
        {
            let [r, g, b] = self.colors.map(|from| texel[from]);
            *texel = [r, g, b, texel[3]];
        }
        match &mut scene.background {
            Background::Constant(color) => swap(color),
            Background::Gradient {
                ground,
                horizon,
                zenith,
            } => [ground, horizon, zenith].into_iter().for_each(swap),
            Background::Map(map) => {
                for texel in &mut map.texels {
                    *texel = self.colors.map(|from| texel[from]);
                }
            }
        }
        if let Some(sun) = &mut scene.sun {
            swap(&mut sun.irradiance);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::load::list_scenes;
    use crate::test_scene::load_test_scene;

    use super::*;

    const SCENES: [&str; 6] = ["fan", "walker", "dolly", "flag", "reversal", "cockpit"];

    /// Compares a sealed scene with its scene at another time.
    fn assert_moves(seal: &Seal, then: impl Fn(f64) -> f64) {
        for name in SCENES {
            let scene = load_test_scene(name);
            let sealed = seal.apply(scene.clone());
            for time in [-1.3, -0.5, -0.1, 0.0, 0.24, 0.9] {
                for object in 0..scene.objects.len() {
                    let pose = sealed.object_to_world(object, time);
                    let expected = scene.object_to_world(object, then(time));
                    assert!(
                        pose.abs_diff_eq(expected, 1e-9),
                        "{name}, object {object} at {time}: {pose} {expected}"
                    );
                }
                let pose = sealed.camera.motion.at(time);
                let expected = scene.camera.motion.at(then(time));
                assert!(pose.abs_diff_eq(expected, 1e-9), "{name} at {time}");
            }
        }
    }

    #[test]
    fn times_are_changed_together() {
        let seal = Seal {
            speed: 1.25,
            delay: 0.1,
            ..Seal::NOTHING
        };
        assert_moves(&seal, |time| 1.25 * (time - 0.1));
        let reversed = Seal {
            reversed: true,
            ..seal
        };
        assert_moves(&reversed, |time| -1.25 * (time - 0.1));
    }

    #[test]
    fn key_shapes_run_backwards() {
        let scene = load_test_scene("flag");
        let reversed = Seal {
            reversed: true,
            ..Seal::NOTHING
        };
        let sealed = reversed.apply(scene.clone());
        let mut meshes = 0;
        for (before, after) in scene.meshes.iter().zip(&sealed.meshes) {
            let Some((first, last)) = before.shapes.first().zip(before.shapes.last()) else {
                continue;
            };
            meshes += 1;
            assert_eq!(after.shapes[0].time, -last.time);
            assert_eq!(after.positions, last.positions);
            assert_eq!(after.shapes.last().unwrap().positions, first.positions);
        }
        assert!(meshes > 0);
    }

    #[test]
    fn the_camera_turns_about_itself_and_zooms() {
        let seal = Seal {
            roll: 0.05,
            pan: [0.04, -0.03],
            zoom: 1.1,
            ..Seal::NOTHING
        };
        for name in SCENES {
            let scene = load_test_scene(name);
            let sealed = seal.apply(scene.clone());
            let [before, after] = [&scene, &sealed].map(|scene| scene.camera.motion.at(0.3));
            assert_eq!(before.translation, after.translation, "{name}");
            let fovs = scene.camera.vertical_fov.iter().map(|(_, fov)| *fov);
            let widest = fovs.fold(0.0, f64::max);
            // Where the new line of sight lies to the old camera: to the right, and below.
            let sight = before
                .inverse()
                .transform_vector3(after.transform_vector3(DVec3::NEG_Z));
            let [right, up] = seal.pan.map(|part| part * widest);
            assert!(
                (sight.x - right.sin() * up.cos()).abs() < 1e-9,
                "{name}: {sight}"
            );
            assert!((sight.y - up.sin()).abs() < 1e-9, "{name}: {sight}");
            let side = before
                .inverse()
                .transform_vector3(after.transform_vector3(DVec3::X));
            assert!(
                (side.y - seal.roll.sin() * up.cos()).abs() < 1e-3,
                "{name}: {side}"
            );
            for ((_, before), (_, after)) in
                (scene.camera.vertical_fov.iter()).zip(&sealed.camera.vertical_fov)
            {
                let ratio = (after / 2.0).tan() / (before / 2.0).tan();
                assert!((ratio - 1.1).abs() < 1e-9, "{name}: {ratio}");
            }
        }
    }

    #[test]
    fn colors_are_swapped() {
        let scene = load_test_scene("neon");
        let seal = Seal {
            colors: [1, 2, 0],
            ..Seal::NOTHING
        };
        let sealed = seal.apply(scene.clone());
        for (before, after) in scene.materials.iter().zip(&sealed.materials) {
            let emission = before.emission;
            let expected = Vec3::new(emission.y, emission.z, emission.x);
            assert_eq!(after.emission, expected);
            let shade = after.diffuse.x / before.diffuse.y;
            assert!(
                shade.is_nan() || SHADE.contains(&f64::from(shade)),
                "{shade}"
            );
        }
    }

    #[test]
    fn each_seed_and_each_scene_has_changes_of_its_own() {
        let names: Vec<String> = (list_scenes(crate::test_scene::scenes())
            .unwrap()
            .into_iter())
        .map(|listing| listing.name)
        .collect();
        let all: Vec<Seal> = (0..10)
            .flat_map(|seed| names.iter().map(move |name| Seal::new(seed, name)))
            .collect();
        let share = |is: fn(&Seal) -> bool| {
            all.iter().filter(|seal| is(seal)).count() as f64 / all.len() as f64
        };
        for part in [share(|seal| seal.mirrored), share(|seal| seal.reversed)] {
            assert!((0.4..0.6).contains(&part), "{part}");
        }
        for (index, seal) in all.iter().enumerate() {
            assert!(SPEED.contains(&seal.speed) && DELAY.contains(&seal.delay));
            assert!(all[..index].iter().all(|other| other.speed != seal.speed));
        }
    }
}
