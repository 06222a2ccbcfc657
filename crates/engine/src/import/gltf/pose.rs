//! Positions and normals of a primitive at a time: morphed, then skinned or placed.

use glam::{DMat3, DMat4, DVec3, Vec3};

use super::geometry::Primitive;

/// Way of a mesh into the space of its OBJ file.
#[derive(Clone, Debug)]
pub enum Placement {
    /// All vertices by one transform.
    Whole(DMat4),
    /// Each vertex by the mean of the transforms of its joints.
    Joints(Vec<DMat4>),
}

/// Returns the positions at weights of the morph targets.
pub fn pose_positions(primitive: &Primitive, weights: &[f64], placement: &Placement) -> Vec<DVec3> {
    let morphed = morph(&primitive.positions, primitive, weights, |target| {
        &target.positions
    });
    match placement {
        Placement::Whole(matrix) => morphed
            .into_iter()
            .map(|position| matrix.transform_point3(position))
            .collect(),
        Placement::Joints(joints) => {
            let vertices = morphed.into_iter().zip(&primitive.influences);
            vertices
                .map(|(position, influences)| blend(joints, influences).transform_point3(position))
                .collect()
        }
    }
}

/// Returns the unit normals at weights of the morph targets; none if the primitive has none.
pub fn pose_normals(primitive: &Primitive, weights: &[f64], placement: &Placement) -> Vec<Vec3> {
    let morphed = morph(&primitive.normals, primitive, weights, |target| {
        &target.normals
    });
    let turn = |matrix: &DMat4, normal: DVec3| {
        let turned = cofactors(matrix) * normal;
        turned.normalize_or_zero().as_vec3()
    };
    match placement {
        Placement::Whole(matrix) => {
            let cofactors = cofactors(matrix);
            let turned = morphed.into_iter().map(|normal| cofactors * normal);
            turned
                .map(|normal| normal.normalize_or_zero().as_vec3())
                .collect()
        }
        Placement::Joints(joints) => {
            let vertices = morphed.into_iter().zip(&primitive.influences);
            vertices
                .map(|(normal, influences)| turn(&blend(joints, influences), normal))
                .collect()
        }
    }
}

/// Adds the weighted differences of the morph targets.
fn morph(
    base: &[Vec3],
    primitive: &Primitive,
    weights: &[f64],
    part: impl Fn(&super::geometry::Target) -> &Vec<Vec3>,
) -> Vec<DVec3> {
    let mut vectors: Vec<DVec3> = base.iter().map(|vector| vector.as_dvec3()).collect();
    for (target, weight) in primitive.targets.iter().zip(weights) {
        if *weight != 0.0 {
            for (vector, difference) in vectors.iter_mut().zip(part(target)) {
                *vector += *weight * difference.as_dvec3();
            }
        }
    }
    vectors
}

fn blend(joints: &[DMat4], influences: &[(u32, f32)]) -> DMat4 {
    let weighted = influences
        .iter()
        .map(|(joint, weight)| joints[*joint as usize] * f64::from(*weight));
    weighted.fold(DMat4::ZERO, |sum, matrix| sum + matrix)
}

/// Returns the matrix that turns normals: the inverse transpose, times the determinant, so that
/// it exists for flattened meshes too.
fn cofactors(matrix: &DMat4) -> DMat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
    let sign = if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}
