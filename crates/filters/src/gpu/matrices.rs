//! Matrices of a camera, as engines pass them to shaders.
//!
//! They act on columns. The camera looks along its own -z with +y up; clip space has +x right and
//! +y up, and the depth that `[convention]` says.

use frame::{Camera, CameraPose};
use glam::{DMat4, DVec4};

use crate::filter::{MATRICES, find_matrix};
use crate::{Convention, DepthKind};

/// Matrices of this frame and of the one before, in the order of [`MATRICES`].
#[derive(Clone, Copy, Debug)]
pub(super) struct CameraMatrices([[DMat4; MATRICES.len()]; 2]);

impl CameraMatrices {
    /// Makes the matrices for pictures of a size in pixels.
    pub fn new(camera: &Camera, size: [u32; 2], convention: &Convention) -> Self {
        Self([camera.now, camera.before].map(|pose| make_matrices(pose, size, convention)))
    }

    /// Returns a number of the matrix of that name, in the order of columns.
    pub fn number(&self, name: &str, index: usize) -> Option<f64> {
        let (matrix, is_previous) = find_matrix(name)?;
        let columns = self.0[usize::from(is_previous)][matrix].to_cols_array();
        columns.get(index).copied()
    }
}

fn make_matrices(
    pose: CameraPose,
    size: [u32; 2],
    convention: &Convention,
) -> [DMat4; MATRICES.len()] {
    let row = |index: usize| DVec4::from_array(pose.to_world[index]);
    let inverse_view = DMat4::from_cols(row(0), row(1), row(2), DVec4::W).transpose();
    let view = inverse_view.inverse();
    let projection = project(pose.focal, size, convention);
    let inverse_projection = projection.inverse();
    [
        projection,
        inverse_projection,
        view,
        inverse_view,
        projection * view,
        inverse_view * inverse_projection,
    ]
}

/// Makes the projection from camera space to clip space.
fn project(focal: f64, [width, height]: [u32; 2], convention: &Convention) -> DMat4 {
    let near = convention.near.unwrap_or(1.0);
    // Depth in clip space is `slope` x distance + `offset`, divided by the distance.
    let far = (convention.far).filter(|_| convention.depth != DepthKind::Linear);
    let forward = match far {
        Some(far) => [far / (far - near), -near * far / (far - near)],
        None => [1.0, -near],
    };
    let [slope, offset] = match convention.depth {
        DepthKind::Linear | DepthKind::Forward => forward,
        DepthKind::Reversed => [1.0 - forward[0], -forward[1]],
        DepthKind::Ndc => [2.0 * forward[0] - 1.0, 2.0 * forward[1]],
    };
    DMat4::from_cols(
        DVec4::X * (2.0 * focal / f64::from(width)),
        DVec4::Y * (2.0 * focal / f64::from(height)),
        DVec4::new(0.0, 0.0, -slope, -1.0),
        DVec4::Z * offset,
    )
}
