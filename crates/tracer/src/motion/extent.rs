//! The extent of a mesh in every direction, for boxes around it at any pose.

use bvh::Aabb;
use glam::{DAffine3, DVec3};
use scene::{Mesh, Scene};

/// Nodes along an edge of the cube of directions. With 9 a cell is 0.25 wide and a box around a
/// sphere at most `2 x 0.25^2 / 8` = 1.6 % too large, because the curvature of a vector's length on
/// the cube is at most 1.
const NODES: usize = 9;
/// Vertices below which a mesh has no grid: its vertices are transformed one by one.
const FEW: usize = 64;

/// The extent of a mesh.
pub(crate) struct Extent {
    /// Greatest distance of a vertex from the origin, metres.
    pub distance: f64,
    grid: Option<Grid>,
}

/// The support function of a rigid mesh, sampled at a grid on the faces of a cube.
///
/// A direction inside a cell is a weighted mean of the cell's corners. The support function is
/// convex, so the same mean of its samples is an upper limit for that direction; along the axes it
/// is exact.
struct Grid {
    /// Per face of the cube (+x, -x, +y, -y, +z, -z), row and column: the greatest `direction .
    /// vertex`.
    support: Vec<f64>,
}

impl Extent {
    /// The extents of a scene's meshes.
    pub fn of_meshes(scene: &Scene) -> Vec<Self> {
        scene.meshes.iter().map(Self::of).collect()
    }

    fn of(mesh: &Mesh) -> Self {
        let many = !mesh.deforms() && mesh.positions.len() >= FEW;
        Self {
            distance: mesh.at(0.0).radius(),
            grid: many.then(|| Grid::of(mesh)),
        }
    }

    /// A box around the mesh with its shape at `time`, transformed by `pose`; contains it up to
    /// rounding.
    pub fn aabb(&self, mesh: &Mesh, pose: &DAffine3, time: f64) -> Aabb {
        match &self.grid {
            Some(grid) => grid.aabb(pose),
            None => Aabb::around(
                mesh.at(time)
                    .positions()
                    .map(|position| pose.transform_point3(position)),
            ),
        }
    }
}

impl Grid {
    fn of(mesh: &Mesh) -> Self {
        let farthest = |direction: DVec3| {
            let along = mesh.positions.iter().map(|p| p.as_dvec3().dot(direction));
            along.fold(f64::NEG_INFINITY, f64::max)
        };
        let nodes = 0..6 * NODES * NODES;
        Self {
            support: nodes.map(|node| farthest(direction(node))).collect(),
        }
    }

    fn aabb(&self, pose: &DAffine3) -> Aabb {
        // A world axis, seen from the mesh, is a row of the matrix.
        let axes = pose.matrix3.transpose().to_cols_array_2d().map(DVec3::from);
        Aabb {
            min: pose.translation - DVec3::from(axes.map(|axis| self.along(-axis))),
            max: pose.translation + DVec3::from(axes.map(|axis| self.along(axis))),
        }
    }

    /// An upper limit of `direction . point` over all points of the mesh.
    fn along(&self, direction: DVec3) -> f64 {
        let major = direction.abs().max_position();
        let size = direction[major].abs();
        let face = 2 * major + usize::from(direction[major] < 0.0);
        let cell = |axis: usize| {
            let place = 0.5 * (direction[axis] / size + 1.0) * (NODES - 1) as f64;
            let cell = (place as usize).min(NODES - 2);
            (cell, place - cell as f64)
        };
        let ((row, down), (column, right)) = (cell((major + 1) % 3), cell((major + 2) % 3));
        let node = |row: usize, column: usize| self.support[(face * NODES + row) * NODES + column];
        let between =
            |row: usize| node(row, column) * (1.0 - right) + node(row, column + 1) * right;
        size * (between(row) * (1.0 - down) + between(row + 1) * down)
    }
}

/// The direction of a node, a point on the surface of the cube from -1 to 1.
fn direction(node: usize) -> DVec3 {
    let (face, row, column) = (node / NODES / NODES, node / NODES % NODES, node % NODES);
    let place = |step: usize| 2.0 * step as f64 / (NODES - 1) as f64 - 1.0;
    let major = face / 2;
    let mut direction = DVec3::ZERO;
    direction[major] = if face % 2 == 0 { 1.0 } else { -1.0 };
    direction[(major + 1) % 3] = place(row);
    direction[(major + 2) % 3] = place(column);
    direction
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, Vec3};

    use super::*;

    /// Points on the unit sphere along a spiral.
    fn sphere() -> Mesh {
        let point = |index: u32| {
            let height = 1.0 - (f64::from(index) + 0.5) / 1000.0;
            let (sine, cosine) = (2.4 * f64::from(index)).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            Vec3::new(
                (radius * cosine) as f32,
                height as f32,
                (radius * sine) as f32,
            )
        };
        Mesh {
            positions: (0..2000).map(point).collect(),
            ..Mesh::default()
        }
    }

    #[test]
    fn a_box_from_the_grid_contains_the_mesh_and_little_more() {
        let mesh = sphere();
        let extent = Extent::of(&mesh);
        assert!(extent.grid.is_some());
        for step in 0..500 {
            let angle = f64::from(step);
            let axis = DVec3::new(angle.sin(), (1.3 * angle).cos(), (1.7 * angle).sin());
            let scale = DVec3::new(2.0, 0.5 + 0.1 * axis.x, -1.0);
            let pose = DAffine3::from_scale_rotation_translation(
                scale,
                DQuat::from_axis_angle(axis.normalize(), 0.7 * angle),
                3.0 * axis,
            );
            let aabb = extent.aabb(&mesh, &pose, 0.0);
            let points = mesh.positions.iter();
            let exact = Aabb::around(points.map(|p| pose.transform_point3(p.as_dvec3())));
            // Rounding only.
            let grown = aabb.grown(1e-12);
            assert!(grown.min.cmple(exact.min).all() && grown.max.cmpge(exact.max).all());
            // 1.6 % by the grid's width, 0.3 % because 2000 points do not fill a sphere.
            let excess = (aabb.max - aabb.min) / (exact.max - exact.min);
            assert!(excess.max_element() < 1.02, "{excess}");
        }
    }
}
