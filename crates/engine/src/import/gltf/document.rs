//! Text of the scene.toml of a glTF file.

use glam::{DVec3, Vec3};
use scene::Family;

use super::keys::Keys;
use super::light::{Lights, SunLight};
use super::objects::vector_text;
use super::view::{Film, View};

/// Everything of a scene.toml but its objects.
pub struct Head<'a> {
    pub exposes: String,
    pub family: Family,
    pub exposure: f64,
    pub film: Film,
    pub camera: &'a Keys<View>,
    pub lights: &'a Lights,
}

impl Head<'_> {
    /// Writes the text, with the picture's brightness in stops.
    pub fn text(&self, stops: Option<f32>) -> String {
        let Film {
            width,
            height,
            vertical_fov,
        } = self.film;
        let display = stops.map(|stops| format!("[display]\nstops = {stops:?}\n\n"));
        format!(
            "# Made by `shuttertruth engine import`; yours to change.\n\
             exposes = {}\nfamily = \"{}\"\nexposure = {:?}\nsize = [{width}, {height}]\n\n{}\
             [camera]\nvertical_fov = {:?}\n{}\n{}",
            toml::Value::from(self.exposes.as_str()),
            self.family.name(),
            self.exposure,
            display.unwrap_or_default(),
            vertical_fov.to_degrees(),
            camera_text(self.camera),
            light_text(self.lights),
        )
    }
}

fn camera_text(keys: &Keys<View>) -> String {
    let words = |view: &View, separator: &str| {
        let [x, y, z, w] = view.orientation.to_array();
        format!(
            "position = {}{separator}rotation = [{x:?}, {y:?}, {z:?}, {w:?}]",
            vector_text(view.position)
        )
    };
    if let [(_, view)] = &keys.list[..] {
        return words(view, "\n") + "\n";
    }
    let keys = keys.list.iter().map(|(moment, view)| {
        format!(
            "    {{ time = {:?}, {} }},\n",
            moment.frame,
            words(view, ", ")
        )
    });
    format!("keys = [\n{}]\n", keys.collect::<String>())
}

/// Writes the sky and the sun: the file's, or usual ones if it has no light at all.
fn light_text(lights: &Lights) -> String {
    if lights.count == 0 {
        return sky_text(Vec3::ONE)
            + &sun_text(&SunLight {
                direction: DVec3::new(-0.3, 0.9, 0.6),
                irradiance: Vec3::new(2.0, 1.9, 1.7),
            });
    }
    match &lights.sun {
        // The usual sky is half as bright as a white surface in the usual sun.
        Some(sun) => sky_text(Vec3::splat(sun.irradiance.max_element() / 2.0)) + &sun_text(sun),
        None => sky_text(Vec3::splat(0.1)),
    }
}

fn sky_text(strength: Vec3) -> String {
    let color = |color: [f32; 3]| {
        let [r, g, b] = (strength * Vec3::from(color)).to_array();
        format!("[{r:?}, {g:?}, {b:?}]")
    };
    format!(
        "[background]\ngradient = {{ ground = {}, horizon = {}, zenith = {} }}\n\n",
        color([0.25, 0.24, 0.22]),
        color([0.8, 0.85, 0.95]),
        color([0.3, 0.45, 0.8])
    )
}

fn sun_text(sun: &SunLight) -> String {
    let [r, g, b] = sun.irradiance.to_array();
    format!(
        "[sun]\ndirection = {}\nirradiance = [{r:?}, {g:?}, {b:?}]\n",
        vector_text(sun.direction)
    )
}
