//! Makes the meshes and textures of the built-in scenes. The scene.toml files beside them are written by hand.
//!
//! Everything is a pure function of nothing: the same bytes each time.

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
mod flag;
mod flat_shapes;
mod ground;
mod hash;
mod hills;
mod lamp_post;
mod ledge;
mod lorry;
mod mannequin;
mod mesh;
mod motorbike;
mod neon_sign;
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

/// A file of a built-in scene.
pub struct File {
    /// Below the folder of scenes: `fan/fan.obj`.
    pub path: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// Every generated file of every scene.
pub fn files() -> Vec<File> {
    [
        scene("sliding_panel", &[panel::files(), wall::plain()]),
        scene("panel_over_texture", &[panel::files(), wall::patchwork()]),
        scene("two_spheres", &[sphere::files()]),
        scene("fan", &[fan::files(), wall::brick()]),
        scene(
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
        scene("cockpit", &[avenue::files(), dashboard::files()]),
        scene("creep", &[ledge::files(), snail::files()]),
        scene(
            "crossing",
            &[
                car::files(),
                crossroads::files(),
                lorry::files(),
                motorbike::files(),
            ],
        ),
        scene("dolly", &[avenue::files(), car::files(), wheel::files()]),
        scene(
            "fence",
            &[
                fence::files(),
                ground::ground("gravel", FIELD, 4.0, ground::gravel),
                train::files(),
            ],
        ),
        scene("flag", &[flag::files(), ridge::files()]),
        scene("flat_field", &[flat_shapes::files()]),
        scene(
            "foliage",
            &[
                bush::files(800),
                bush::smooth(),
                ground::ground("grass", FIELD, 4.0, ground::grass),
                lamp_post::files(),
                ridge::files(),
            ],
        ),
        scene(
            "frame_edge",
            &[
                beach_ball::files(),
                ground::ground("sand", FIELD, 2.0, ground::sand),
            ],
        ),
        scene("neon", &[neon_sign::files(), wall::brick()]),
        scene("ornaments", &[ornaments::files(), wall::boards()]),
        scene("pan_sky", &[cloudy_sky::files(), skyline::files()]),
        scene("ramp_floor", &[passage::files()]),
        scene(
            "reversal",
            &[
                beach_ball::files(),
                ground::ground("asphalt", FIELD, 4.0, ground::asphalt),
                lorry::files(),
                ridge::files(),
            ],
        ),
        scene("roll", &[village::files()]),
        scene(
            "walker",
            &[
                bush::files(420),
                cafe::files(),
                lamp_post::files(),
                mannequin::files(),
                scooter::files(),
            ],
        ),
        scene(
            "wheel_roll",
            &[
                spoked_wheel::files(),
                ground::ground("gravel", FIELD, 1.0, ground::gravel),
                ridge::files(),
            ],
        ),
        scene("wires", &[overhead_line::files(), ridge::files()]),
    ]
    .concat()
    .into_iter()
    .map(|(path, bytes)| File { path, bytes })
    .collect()
}

/// Ground around the origin, from corner to corner as (x, z) in metres.
const FIELD: [glam::DVec2; 2] = [glam::DVec2::splat(-40.0), glam::DVec2::splat(40.0)];

/// Name and content of files that belong together.
type Files = Vec<(String, Vec<u8>)>;

/// Puts files into a scene's folder.
fn scene(name: &str, parts: &[Files]) -> Files {
    parts
        .concat()
        .into_iter()
        .map(|(file, bytes)| (format!("{name}/{file}"), bytes))
        .collect()
}

/// The OBJ file of a mesh and its MTL file.
fn model(name: &str, mesh: &mesh::Mesh, materials: &str) -> Files {
    vec![
        (
            format!("{name}.obj"),
            mesh.obj(&format!("{name}.mtl")).into_bytes(),
        ),
        (format!("{name}.mtl"), materials.into()),
    ]
}
