//! The vertices of a mesh at one time.

use glam::{DAffine3, DVec3, Vec3};

use crate::model::{Mesh, Shape};

/// The vertices of a mesh at one time: of its only shape, or between two shapes.
#[derive(Clone, Copy)]
pub struct ShapeAt<'a> {
    mesh: &'a Mesh,
    between: Option<Between<'a>>,
}

#[derive(Clone, Copy)]
struct Between<'a> {
    shapes: [&'a Shape; 2],
    /// 0 at the first, 1 at the second; outside that range the change goes on.
    fraction: f64,
}

impl Mesh {
    /// The mesh at `time` (frames).
    #[inline]
    pub fn at(&self, time: f64) -> ShapeAt<'_> {
        let next = self.shapes.partition_point(|shape| shape.time <= time);
        self.between(next, time)
    }

    /// The mesh at `time` (frames), between the shape `next` and the one before it.
    #[inline]
    fn between(&self, next: usize, time: f64) -> ShapeAt<'_> {
        let last = self.shapes.len().saturating_sub(1);
        let between = (last > 0).then(|| {
            let next = next.clamp(1, last);
            let [from, to] = [&self.shapes[next - 1], &self.shapes[next]];
            Between {
                shapes: [from, to],
                fraction: (time - from.time) / (to.time - from.time),
            }
        });
        ShapeAt {
            mesh: self,
            between,
        }
    }

    /// The velocity of a point of a triangle just before `time` (frames), in the object's space,
    /// metres per frame.
    pub fn velocity_before(&self, time: f64, triangle: u32, weights: [f64; 2]) -> DVec3 {
        let next = self.shapes.partition_point(|shape| shape.time < time);
        let Some(Between { shapes, .. }) = self.between(next, time).between else {
            return DVec3::ZERO;
        };
        let [from, to] = shapes.map(|shape| {
            let shape_at = self.between(next, shape.time);
            shape_at.point(triangle, weights)
        });
        (to - from) / (shapes[1].time - shapes[0].time)
    }

    /// Returns true if the mesh changes its shape.
    #[inline]
    pub fn deforms(&self) -> bool {
        !self.shapes.is_empty()
    }

    /// Times of its key shapes, rising.
    pub fn shape_times(&self) -> impl Iterator<Item = f64> {
        self.shapes.iter().map(|shape| shape.time)
    }

    /// The greatest distance from the origin (metres) and the greatest speed (metres per frame) of
    /// any vertex within `[from, to]`, an interval without key shapes inside.
    pub fn vertex_maxima(&self, from: f64, to: f64) -> [f64; 2] {
        let distance = self.at(from).radius().max(self.at(to).radius());
        let Some(between) = self.at(0.5 * (from + to)).between else {
            return [distance, 0.0];
        };
        let [first, second] = between.shapes;
        let ways = first.positions.iter().zip(&second.positions);
        let farthest_way = ways
            .map(|(from, to)| from.as_dvec3().distance(to.as_dvec3()))
            .fold(0.0, f64::max);
        [distance, farthest_way / (second.time - first.time)]
    }
}

impl ShapeAt<'_> {
    /// Position of a vertex in the object's space, metres.
    #[inline]
    pub fn position(&self, vertex: u32) -> DVec3 {
        self.value(vertex, &self.mesh.positions, |shape| &shape.positions)
    }

    /// Positions of a triangle's vertices.
    #[inline]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        let [a, b, c] = self.mesh.triangles[triangle as usize];
        [self.position(a), self.position(b), self.position(c)]
    }

    /// Positions of all vertices.
    pub fn positions(self) -> impl Iterator<Item = DVec3> {
        (0..self.mesh.positions.len() as u32).map(move |vertex| self.position(vertex))
    }

    /// Greatest distance of a vertex from the origin, metres.
    pub fn radius(self) -> f64 {
        self.positions().map(DVec3::length).fold(0.0, f64::max)
    }

    /// Unit normal of a vertex; none if the mesh has none, if the face is flat, or if two shapes'
    /// cancel.
    #[inline]
    pub fn normal(&self, vertex: u32) -> Option<DVec3> {
        if self.mesh.normals.is_empty() {
            return None;
        }
        let normal = self.value(vertex, &self.mesh.normals, |shape| &shape.normals);
        match self.between {
            Some(_) => normal.try_normalize(),
            None => Some(normal),
        }
    }

    /// The normal of a transformed triangle, on the side from which it is wound anticlockwise. Its
    /// length is twice the area.
    #[inline]
    pub fn area_normal(&self, triangle: u32, transform: &DAffine3) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        let edge = |to: DVec3| transform.transform_vector3(to - a);
        edge(b).cross(edge(c))
    }

    /// A point of a triangle from the weights of its second and third vertex.
    #[inline]
    pub fn point(&self, triangle: u32, weights: [f64; 2]) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        a + weights[0] * (b - a) + weights[1] * (c - a)
    }

    #[inline]
    fn value(&self, vertex: u32, rigid: &[Vec3], of: fn(&Shape) -> &Vec<Vec3>) -> DVec3 {
        let vertex = vertex as usize;
        let Some(Between { shapes, fraction }) = self.between else {
            return rigid[vertex].as_dvec3();
        };
        let [from, to] = [of(shapes[0])[vertex], of(shapes[1])[vertex]];
        let [from, to] = [from.as_dvec3(), to.as_dvec3()];
        from + fraction * (to - from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_between_shapes_have_unit_length_and_those_of_flat_faces_are_none() {
        let shape = |time, normals: [Vec3; 2]| Shape {
            time,
            positions: vec![Vec3::ZERO; 2],
            normals: normals.to_vec(),
        };
        let shapes = vec![
            shape(-1.0, [Vec3::Z, Vec3::ZERO]),
            shape(1.0, [Vec3::X, Vec3::ZERO]),
        ];
        let mesh = Mesh {
            positions: vec![Vec3::ZERO; 2],
            normals: vec![Vec3::Z, Vec3::Y],
            shapes,
            ..Mesh::default()
        };
        let normal = mesh.at(0.0).normal(0).unwrap();
        // Rounding of a square root.
        assert!(normal.distance(DVec3::new(1.0, 0.0, 1.0).normalize()) < 1e-15);
        assert_eq!(mesh.at(0.0).normal(1), None);
    }
}
