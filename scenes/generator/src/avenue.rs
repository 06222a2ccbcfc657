//! A road along the Z axis between trees, house walls and marker posts, for a driver who heads for
//! -Z.

use glam::{DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::ground::{grass, ground_files};
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::texture::encode_png;
use crate::{road, tree};

/// Ends of the road behind and ahead of the viewer at z = 0, in metres.
const BEHIND: f64 = 24.0;
const AHEAD: f64 = -240.0;

/// Distance from tree to tree, in metres.
const SPACING: f64 = 11.0;

pub(crate) fn files() -> Files {
    let mut asphalt = Mesh::default();
    asphalt.add_surface(
        [2, 40],
        |_, _| "asphalt",
        |u, v| {
            DVec3::new(
                road::HALF_WIDTH * (2.0 * u - 1.0),
                0.02,
                BEHIND + v * (AHEAD - BEHIND),
            )
        },
    );
    // The road's texture runs along its own X.
    asphalt.turn_texture();
    asphalt.repeat_texture(DVec2::new((BEHIND - AHEAD) / road::TILE, 1.0));
    let mut trees = Mesh::default();
    for index in 0..20 {
        let z = 12.0 - SPACING * f64::from(index);
        for side in [-1.0, 1.0] {
            let random = |seed: u32| noise(index + 60, seed + (side > 0.0) as u32);
            if index < 9 {
                let foot = DVec3::new(side * (6.3 + 0.8 * random(1)), 0.0, z + 2.0 * random(3));
                tree::add_tree(
                    &mut trees,
                    foot,
                    6.0 + 2.5 * random(5),
                    2 * index + (side > 0.0) as u32,
                );
            }
            let post = DVec3::new(side * 3.9, 0.45, z + 4.0);
            add_cuboid(&mut trees, "post", post, DVec3::new(0.12, 0.9, 0.12), 1);
            add_cuboid(
                &mut trees,
                "mark",
                post + DVec3::Y * 0.28,
                DVec3::new(0.13, 0.18, 0.13),
                1,
            );
        }
    }
    let materials = format!(
        "{}newmtl post\nKd 0.85 0.85 0.85\nnewmtl mark\nKd 0.08 0.08 0.08\n",
        tree::MATERIALS
    );
    let mut files = model_files(
        "avenue",
        &asphalt,
        "newmtl asphalt\nKd 1 1 1\nmap_Kd road.png\n",
    );
    files.push((
        "road.png".into(),
        encode_png(128, |x, y| road::color(2 * x, 2 * y)),
    ));
    files.extend(model_files("trees", &trees, &materials));
    let corners = [DVec2::new(-140.0, AHEAD), DVec2::new(140.0, BEHIND)];
    files.extend(ground_files("grass", corners, 4.0, grass));
    files
}
