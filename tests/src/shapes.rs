//! Scenes made by code: small meshes, materials and motions.

use std::path::PathBuf;

use frame::ShutterProfile;
use glam::{DQuat, DVec3, Vec3};
use scene::{
    Background, Camera, Display, Family, Finish, FlipExposures, Key, Material, Mesh, Motion,
    Object, Parent, Scene, SceneId, Turn,
};

/// Makes a scene without objects under a black sky. The camera at the origin looks along -Z, 90
/// degrees high.
pub fn empty_scene(name: &str) -> Scene {
    Scene {
        id: SceneId::new(name, None),
        exposes: "a test".into(),
        family: Family::Translation,
        exposure: 1.0,
        written_exposure: 1.0,
        shutter_profile: ShutterProfile::default(),
        width: 48,
        height: 27,
        display: Display {
            stops: 0.0,
            flip: FlipExposures {
                start: 0.0,
                stop: 0.0,
                count: 2,
            },
        },
        camera: Camera {
            motion: Motion::still(Key::REST),
            vertical_fov: vec![(0.0, std::f64::consts::FRAC_PI_2)],
            lens: None,
        },
        background: Background::Constant(Vec3::ZERO),
        sun: None,
        meshes: Vec::new(),
        textures: Vec::new(),
        materials: Vec::new(),
        objects: Vec::new(),
        notes: Vec::new(),
        hash: String::new(),
    }
}

/// Adds an object in the world with one material; returns its index.
pub fn add(scene: &mut Scene, mesh: Mesh, material: Material, motion: Motion) -> usize {
    let index = scene.objects.len();
    scene.objects.push(Object {
        name: format!("object{index}"),
        mesh: scene.meshes.len(),
        materials: vec![scene.materials.len()],
        motion,
        parent: Parent::World,
    });
    scene.meshes.push(mesh);
    scene.materials.push(material);
    index
}

/// Makes a diffuse surface.
pub fn diffuse(albedo: f32) -> Material {
    Material {
        name: "diffuse".into(),
        finish: Finish::Diffuse,
        diffuse: Vec3::splat(albedo),
        diffuse_texture: None,
        emission: Vec3::ZERO,
        emission_texture: None,
        opacity: 1.0,
        opacity_texture: None,
        translucency: None,
    }
}

/// Makes an unlit surface that emits.
pub fn glowing(radiance: f32) -> Material {
    Material {
        emission: Vec3::splat(radiance),
        ..diffuse(0.0)
    }
}

/// Makes a translation at a constant velocity (metres per frame) through `at` at `t = 0`.
pub fn drift(at: DVec3, velocity: DVec3) -> Motion {
    through([0.0, 1.0].map(|time| key(time, at + time * velocity)))
}

/// Makes a pose without rotation at a time.
pub fn key(time: f64, translation: DVec3) -> Key {
    Key {
        time,
        translation,
        ..Key::REST
    }
}

/// Makes a motion at constant velocities through keys.
pub fn through(keys: impl Into<Vec<Key>>) -> Motion {
    Motion {
        keys: keys.into(),
        ..Motion::default()
    }
}

/// Makes a rotation at a constant `rate` (radians per frame) about `axis` through `at`, at rest
/// pose at `t = 0`.
pub fn spin(at: DVec3, axis: DVec3, rate: f64) -> Motion {
    let turn = Turn { axis, angle: rate };
    let start = Key {
        turn,
        ..key(0.0, at)
    };
    let end = Key {
        time: 1.0,
        orientation: DQuat::from_axis_angle(axis, rate),
        turn: Turn::NONE,
        ..start
    };
    through([start, end])
}

/// Makes the camera zoom by far less than a pixel. Everything then moves on screen, so that
/// everything belongs to the moving region.
pub fn zoom_slightly(scene: &mut Scene) {
    let fov = scene.camera.vertical_fov[0].1;
    scene.camera.vertical_fov = vec![(-1.0, (1.0 - 1e-8) * fov), (1.0, fov)];
}

/// Makes a pose that never changes.
pub fn placed(at: DVec3) -> Motion {
    Motion::still(key(0.0, at))
}

/// Makes a mesh of triangles without normals or texture coordinates, in one slot.
pub fn mesh(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        path: PathBuf::from("made by a test"),
        slots: vec![0; triangles.len()],
        positions,
        normals: Vec::new(),
        texcoords: Vec::new(),
        triangles,
        shapes: Vec::new(),
    }
}

/// Makes a rectangle in the plane z = 0 around the origin, facing +Z.
pub fn rectangle(width: f32, height: f32) -> Mesh {
    let [x, y] = [0.5 * width, 0.5 * height];
    let corner = |x, y| Vec3::new(x, y, 0.0);
    mesh(
        vec![corner(-x, -y), corner(x, -y), corner(x, y), corner(-x, y)],
        vec![[0, 1, 2], [0, 2, 3]],
    )
}

/// Makes a disc in the plane z = 0 around the origin, as a fan of `sides` triangles of the disc's
/// exact area.
pub fn disc(radius: f32, sides: u32) -> Mesh {
    let angle = std::f64::consts::TAU / f64::from(sides);
    // A regular polygon of the disc's area is half outside and half inside the circle.
    let reach = f64::from(radius) * (angle / angle.sin()).sqrt();
    let rim = (0..sides).map(|side| {
        let (sine, cosine) = (angle * f64::from(side)).sin_cos();
        Vec3::new((reach * cosine) as f32, (reach * sine) as f32, 0.0)
    });
    let positions = [Vec3::ZERO].into_iter().chain(rim).collect();
    let triangles = (0..sides).map(|side| [0, 1 + side, 1 + (side + 1) % sides]);
    mesh(positions, triangles.collect())
}

/// Makes a closed box around the origin, wound outwards.
pub fn cuboid(size: Vec3) -> Mesh {
    let corner = |corner: u32| {
        let side = |bit: u32| (corner >> bit & 1) as f32 - 0.5;
        size * Vec3::new(side(0), side(1), side(2))
    };
    let positions = (0..8).map(corner).collect();
    #[rustfmt::skip]
    let quads = [
        [0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5],
    ];
    let halves = quads.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    mesh(positions, halves.concat())
}

/// Makes a closed sphere around the origin: an icosahedron whose triangles are split into four
/// `splits` times, with smooth normals.
pub fn icosphere(radius: f32, splits: u32) -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    #[rustfmt::skip]
    let corners = [
        [-1.0, golden, 0.0], [1.0, golden, 0.0], [-1.0, -golden, 0.0], [1.0, -golden, 0.0],
        [0.0, -1.0, golden], [0.0, 1.0, golden], [0.0, -1.0, -golden], [0.0, 1.0, -golden],
        [golden, 0.0, -1.0], [golden, 0.0, 1.0], [-golden, 0.0, -1.0], [-golden, 0.0, 1.0],
    ];
    let mut directions = (corners.map(|corner| DVec3::from(corner).normalize())).to_vec();
    #[rustfmt::skip]
    let mut triangles: Vec<[u32; 3]> = vec![
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
        [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
        [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
    ];
    for _ in 0..splits {
        let mut middles = std::collections::BTreeMap::new();
        let mut middle = |a: u32, b: u32, directions: &mut Vec<DVec3>| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum = directions[a as usize] + directions[b as usize];
                directions.push(sum.normalize());
                directions.len() as u32 - 1
            })
        };
        let split = triangles.iter().flat_map(|&[a, b, c]| {
            let ab = middle(a, b, &mut directions);
            let bc = middle(b, c, &mut directions);
            let ca = middle(c, a, &mut directions);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        triangles = split.collect();
    }
    let normals: Vec<Vec3> = directions
        .iter()
        .map(|direction| direction.as_vec3())
        .collect();
    let positions = normals.iter().map(|normal| radius * *normal).collect();
    Mesh {
        normals,
        ..mesh(positions, triangles)
    }
}
