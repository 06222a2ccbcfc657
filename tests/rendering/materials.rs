//! Renders of glossy materials, against known answers.

use glam::{DVec3, Vec3};
use scene::{Background, Finish, Material};

use crate::renders::*;

const fn metal(roughness: f32) -> Finish {
    Finish::Conductor { roughness }
}

const fn coat(roughness: f32, index: f32) -> Finish {
    Finish::Coated { roughness, index }
}

const METALS: [Finish; 3] = [metal(0.0), metal(0.3), metal(0.9)];
const COATS: [Finish; 3] = [coat(0.0, 1.5), coat(0.2, 1.5), coat(0.8, 2.0)];

fn glossy(finish: Finish, color: f32) -> Material {
    let mut material = diffuse(color);
    material.finish = finish;
    material
}

/// Renders the mean radiance of a floor, seen at a slope of 1 to 2.
fn lit_floor(finish: Finish, color: f32, sky: Background, samples_per_pixel: u32) -> f64 {
    let mut scene = floor_scene(glossy(finish, color));
    scene.background = sky;
    mean_radiance(&scene, samples_per_pixel)
}

fn white() -> Background {
    Background::Constant(Vec3::ONE)
}

#[test]
fn white_gloss_under_a_white_sky_cannot_be_seen() {
    for finish in METALS.into_iter().chain(COATS) {
        // A turning sphere of few facets with smooth normals, so near that it fills the picture.
        let mut scene = empty_scene("sphere");
        scene.background = white();
        let turning = spin(DVec3::new(0.0, 0.0, -1.3), DVec3::Y, 2.0);
        add(&mut scene, icosphere(1.0, 1), glossy(finish, 1.0), turning);
        scene.camera.vertical_fov = vec![(0.0, 0.5)];
        let radiance = mean_radiance(&scene, 256);
        // The error of the albedo's table, times the few bounces between facets.
        expect_near(&format!("{finish:?}"), radiance, 1.0, 3e-3);
    }
}

#[test]
fn a_mirror_shows_the_sky_that_it_faces() {
    // The mirrored ray rises at 1 to sqrt(5). The spot is 1e-4 radians high.
    let radiance = lit_floor(metal(0.0), 1.0, heights(9.0, 0.0, 1.0), 64);
    expect_near("mirror", radiance, 0.2_f64.sqrt(), 1e-4);
}

#[test]
fn a_black_surface_below_a_smooth_coat_follows_fresnel_s_equations() {
    let radiance = lit_floor(coat(0.0, 1.5), 0.0, white(), 256);
    // The spot is 1e-4 radians high, where the reflectance changes by 0.4 per radian.
    expect_near("coat", radiance, fresnel(0.2_f64.sqrt(), 1.5), 1e-4);
}

#[test]
fn a_metal_seen_straight_on_has_its_own_colour() {
    let mut scene = empty_scene("straight on");
    scene.background = white();
    let wall = placed(DVec3::new(0.0, 0.0, -4.0));
    let paint = glossy(metal(0.0), 0.3);
    add(&mut scene, rectangle(10.0, 10.0), paint, wall);
    scene.camera.vertical_fov = vec![(0.0, 0.01)];
    let radiance = mean_radiance(&scene, 16);
    expect_near("metal", radiance, 0.3, 1e-6);
}

/// An image of a sky bright above is sampled as a light, and so is one of a sky bright below. Their
/// sum is even, so it is not.
#[test]
fn sampled_light_and_light_met_by_chance_agree() {
    for finish in METALS.into_iter().chain(COATS) {
        let [above, below] = [heights(0.0, 0.0, 1.0), heights(1.0, 1.0, 0.0)]
            .map(|sky| lit_floor(finish, 0.5, image_of(&sky), 512));
        let whole = lit_floor(finish, 0.5, white(), 512);
        // 144 pixels of 512 stratified samples: 4e-4 at most (measured).
        expect_near(&format!("{finish:?}"), above + below, whole, 1.5e-3);
    }
}
