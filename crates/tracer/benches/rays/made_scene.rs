//! The scene that rays are timed on: a displaced ground and 25 displaced spheres, 540,000 triangles
//! in all.

use std::f64::consts::{PI, TAU};

use frame::ShutterProfile;
use glam::{DQuat, DVec3, Vec3};
use scene::{
    Background, Camera, Display, Family, Key, Material, Mesh, Motion, Object, Parent, Scene,
    SceneId, Turn,
};

/// Quads along each side of the ground.
const GROUND_SIDE: u32 = 300;
/// Rows of quads from pole to pole of a sphere.
const SPHERE_ROWS: u32 = 60;
/// Spheres along each side of their square.
const SPHERES_SIDE: u32 = 5;
/// Shutter interval of all rays, in frames.
pub const SHUTTER: [f64; 2] = [-1.0, 0.0];

/// Makes the scene. Every sphere drifts by two radii over the shutter interval and turns.
pub fn made_scene() -> Scene {
    let object = |mesh, name: String, motion| Object {
        name,
        mesh,
        materials: vec![0],
        motion,
        parent: Parent::World,
    };
    let ground_object = object(0, "ground".into(), Motion::still(Key::REST));
    let spheres = (0..SPHERES_SIDE * SPHERES_SIDE)
        .map(|index| object(1, format!("sphere_{index}"), drift(index)));
    let objects = std::iter::once(ground_object).chain(spheres).collect();
    Scene {
        id: SceneId::new("made", None),
        exposes: "the speed of rays".into(),
        family: Family::Limits,
        exposure: 1.0,
        written_exposure: 1.0,
        shutter_profile: ShutterProfile::default(),
        width: 1920,
        height: 1080,
        display: Display::default(),
        camera: Camera {
            motion: Motion::still(Key {
                translation: DVec3::new(0.0, 9.0, 17.0),
                orientation: DQuat::from_rotation_x(-0.5),
                ..Key::REST
            }),
            vertical_fov: vec![(0.0, 0.7)],
            lens: None,
        },
        background: Background::Constant(Vec3::ONE),
        sun: None,
        meshes: vec![ground(), bumpy_sphere(SPHERE_ROWS)],
        textures: Vec::new(),
        materials: vec![Material {
            diffuse: Vec3::splat(0.5),
            ..Material::default()
        }],
        objects,
        notes: Vec::new(),
        hash: String::new(),
    }
}

fn drift(index: u32) -> Motion {
    let [column, row] = [index % SPHERES_SIDE, index / SPHERES_SIDE].map(f64::from);
    let start = DVec3::new(2.6 * (column - 2.0), 1.3, 2.6 * (row - 2.0));
    let heading = f64::from(index) * 2.4;
    let way = 2.0 * DVec3::new(heading.cos(), 0.1, heading.sin());
    let [open, close] = SHUTTER;
    let key = |time, translation| Key {
        time,
        translation,
        ..Key::REST
    };
    let axis = DVec3::new(heading.sin(), 1.0, 0.3).normalize();
    Motion {
        keys: vec![
            Key {
                turn: Turn { axis, angle: 0.6 },
                ..key(open, start - 0.5 * way)
            },
            Key {
                orientation: DQuat::from_axis_angle(axis, 0.6),
                ..key(close, start + 0.5 * way)
            },
        ],
        ..Motion::default()
    }
}

fn ground() -> Mesh {
    grid(GROUND_SIDE, GROUND_SIDE, |u, v| {
        let [x, z] = [24.0 * (u - 0.5), 24.0 * (v - 0.5)];
        DVec3::new(
            x,
            0.3 * (1.7 * x).sin() * (1.3 * z).cos() + 0.05 * (9.0 * x + 7.0 * z).sin(),
            z,
        )
    })
}

/// A displaced unit sphere with rows of quads from pole to pole, and twice as many around.
pub fn bumpy_sphere(rows: u32) -> Mesh {
    grid(rows, 2 * rows, |u, v| {
        let (polar_sine, polar_cosine) = (PI * u).sin_cos();
        let (sine, cosine) = (TAU * v).sin_cos();
        let bump = 1.0 + 0.04 * (12.0 * PI * u).sin() * (16.0 * PI * v).sin();
        bump * DVec3::new(polar_sine * cosine, polar_cosine, polar_sine * sine)
    })
}

/// A sheet of `rows` x `columns` quads over the unit square.
fn grid(rows: u32, columns: u32, point: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let positions = (0..=rows)
        .flat_map(|row| (0..=columns).map(move |column| (row, column)))
        .map(|(row, column)| {
            point(
                f64::from(row) / f64::from(rows),
                f64::from(column) / f64::from(columns),
            )
            .as_vec3()
        })
        .collect();
    let triangles: Vec<[u32; 3]> = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column))
        .flat_map(|corner| {
            let below = corner + columns + 1;
            [[corner, below, corner + 1], [corner + 1, below, below + 1]]
        })
        .collect();
    Mesh {
        positions,
        slots: vec![0; triangles.len()],
        triangles,
        ..Mesh::default()
    }
}
