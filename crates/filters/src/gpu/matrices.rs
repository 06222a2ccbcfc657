//! Matrices of a camera, as engines hand them to shaders.
//!
//! They act on columns. The camera looks along its own -z with +y up; clip space has +x right and +y up, and the depth that
//! `[convention]` says.

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
    let forward = match convention.far {
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

#[cfg(test)]
mod tests {
    use super::*;
    use frame::{Plane, Raster};

    /// A camera that is turned about y and has moved.
    fn pose() -> CameraPose {
        let (sine, cosine) = 0.3_f64.sin_cos();
        CameraPose {
            focal: 50.0,
            to_world: [
                [cosine, 0.0, sine, 3.0],
                [0.0, 1.0, 0.0, -1.0],
                [-sine, 0.0, cosine, 2.0],
            ],
        }
    }

    #[test]
    fn clip_space_has_the_depth_of_the_convention() {
        for depth in [DepthKind::Forward, DepthKind::Reversed, DepthKind::Ndc] {
            for far in [None, Some(40.0)] {
                let convention = Convention {
                    depth,
                    near: Some(0.5),
                    far,
                    ..Convention::default()
                };
                let [projection, inverse, ..] = make_matrices(pose(), [80, 60], &convention);
                let distance = 7.0;
                let clip = projection * DVec4::new(2.0, -1.0, -distance, 1.0);
                let plane: Plane = Raster::from_fn(1, 1, |_, _| distance as f32);
                let expected = f64::from(convention.convert_depth(&plane).pixels[0]);
                assert!((clip.z / clip.w - expected).abs() < 1e-6, "{depth:?}");
                assert!((clip.x / clip.w - 2.0 * 50.0 / 7.0 / 40.0).abs() < 1e-12);
                assert!((clip.y / clip.w + 50.0 / 7.0 / 30.0).abs() < 1e-12);
                let back = inverse * clip;
                assert!((back / back.w - DVec4::new(2.0, -1.0, -7.0, 1.0)).length() < 1e-9);
            }
        }
    }

    #[test]
    fn the_view_takes_places_of_the_world_to_the_camera() {
        let [.., view, inverse_view, _, _] =
            make_matrices(pose(), [80, 60], &Convention::default());
        assert!((view * DVec4::new(3.0, -1.0, 2.0, 1.0) - DVec4::W).length() < 1e-12);
        assert!((inverse_view * DVec4::W - DVec4::new(3.0, -1.0, 2.0, 1.0)).length() < 1e-12);
        let ahead = view * DVec4::new(3.0 - 0.3_f64.sin(), -1.0, 2.0 - 0.3_f64.cos(), 1.0);
        assert!((ahead - DVec4::new(0.0, 0.0, -1.0, 1.0)).length() < 1e-12);
    }
}
