//! The meshes and textures of the built-in scenes. Their scene.toml files are written by hand.
//!
//! Generation takes no input and gives the same bytes each time.

mod aeroplane;
mod avenue;
mod beach_ball;
mod bush;
mod cafe;
mod car;
mod cloudy_sky;
mod crossroads;
mod cuboid;
mod dashboard;
mod ellipsoid;
mod fan;
mod fence;
mod files;
mod flag;
mod flat_shapes;
mod glass_front;
mod grinding;
mod ground;
mod hills;
mod lamp_post;
mod ledge;
mod lorry;
mod mannequin;
mod mesh;
mod motorbike;
mod neon_sign;
mod noise;
mod ornaments;
mod overhead_line;
mod panel;
mod passage;
mod prism;
mod railing;
mod revolution;
mod ridge;
mod road;
mod scooter;
mod skyline;
mod snail;
mod sphere;
mod spoked_wheel;
mod texture;
mod train;
mod tree;
mod tube;
mod village;
mod wall;
mod wheel;

use files::scene_files;

/// File of a built-in scene.
pub struct File {
    /// Path below the folder of scenes: `fan/fan.obj`.
    pub path: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Generates every file of every scene.
pub fn generate_files() -> Vec<File> {
    [
        scene_files("sliding_panel", &[panel::files(), wall::plain()]),
        scene_files("panel_over_texture", &[panel::files(), wall::patchwork()]),
        scene_files("two_spheres", &[sphere::files()]),
        scene_files("fan", &[fan::files(), wall::brick()]),
        scene_files(
            "railing",
            &[
                aeroplane::files(),
                car::files(),
                hills::files(),
                railing::files(),
                road::files(),
                wheel::files(),
            ],
        ),
        scene_files("cockpit", &[avenue::files(), dashboard::files()]),
        scene_files("creep", &[ledge::files(), snail::files()]),
        scene_files(
            "crossing",
            &[
                car::files(),
                crossroads::files(),
                lorry::files(),
                motorbike::files(),
            ],
        ),
        scene_files("dolly", &[avenue::files(), car::files(), wheel::files()]),
        scene_files(
            "fence",
            &[
                fence::files(),
                ground::ground_files("gravel", FIELD, 4.0, ground::gravel),
                train::files(),
            ],
        ),
        scene_files("flag", &[flag::files(), ridge::files()]),
        scene_files("flat_field", &[flat_shapes::files()]),
        scene_files(
            "foliage",
            &[
                bush::files(800),
                bush::smooth(),
                ground::ground_files("grass", FIELD, 4.0, ground::grass),
                lamp_post::files(),
                ridge::files(),
            ],
        ),
        scene_files(
            "frame_edge",
            &[
                beach_ball::files(),
                ground::ground_files("sand", FIELD, 2.0, ground::sand),
            ],
        ),
        scene_files(
            "glasshouse",
            &[beach_ball::files(), glass_front::files(), wall::brick()],
        ),
        scene_files("neon", &[neon_sign::files(), wall::brick()]),
        scene_files("ornaments", &[ornaments::files(), wall::boards()]),
        scene_files("pan_sky", &[cloudy_sky::files(), skyline::files()]),
        scene_files("ramp_floor", &[passage::files()]),
        scene_files(
            "reversal",
            &[
                beach_ball::files(),
                ground::ground_files("asphalt", FIELD, 4.0, ground::asphalt),
                lorry::files(),
                ridge::files(),
            ],
        ),
        scene_files("roll", &[village::files()]),
        scene_files("shallow_focus", &[beach_ball::files(), wall::brick()]),
        scene_files("sparks", &[grinding::files(), wall::brick()]),
        scene_files(
            "walker",
            &[
                bush::files(420),
                cafe::files(),
                lamp_post::files(),
                mannequin::files(),
                scooter::files(),
            ],
        ),
        scene_files(
            "wheel_roll",
            &[
                spoked_wheel::files(),
                ground::ground_files("gravel", FIELD, 1.0, ground::gravel),
                ridge::files(),
            ],
        ),
        scene_files("wires", &[overhead_line::files(), ridge::files()]),
    ]
    .concat()
    .into_iter()
    .map(|(path, bytes)| File { path, bytes })
    .collect()
}

/// Ground around the origin, from corner to corner as (x, z) in metres.
const FIELD: [glam::DVec2; 2] = [glam::DVec2::splat(-40.0), glam::DVec2::splat(40.0)];
