//! Values of a frame for uniform blocks.

use frame::Reprojection;

use super::matrices::CameraMatrices;
use crate::filter::split_element;
use crate::input::FRAMES_PER_SECOND;
use crate::shader::FRAME_PREFIX;
use crate::{Convention, Input};

/// Values of a frame that members of uniform blocks name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameValues {
    size: [u32; 2],
    exposure: f64,
    frame_index: u32,
    /// Run of the pass, from 0, and number of its runs.
    run: [u32; 2],
    /// Convention of the filter, with the frame's own rate.
    convention: Convention,
    /// Rate that kernels get.
    frames_per_second: f64,
    reprojection: Reprojection,
    /// Matrices of the camera; none for a filter that reads none.
    matrices: Option<CameraMatrices>,
}

impl FrameValues {
    /// Collects the values that all dispatches of an input share.
    pub fn of(input: &Input, convention: &Convention) -> Self {
        let size = [input.velocity.width, input.velocity.height];
        let rate = (input.frames_per_second).or(convention.frames_per_second);
        Self {
            size,
            exposure: f64::from(input.exposure as f32),
            frame_index: input.frame_index,
            run: [0, 1],
            convention: convention.at_rate(input.frames_per_second),
            frames_per_second: rate.unwrap_or(FRAMES_PER_SECOND),
            reprojection: input.reprojection.unwrap_or(Reprojection::STILL),
            matrices: (input.camera.as_ref())
                .map(|camera| CameraMatrices::new(camera, size, convention)),
        }
    }

    /// Sets the run of a pass.
    pub fn of_run(self, iteration: u32, iterations: u32) -> Self {
        Self {
            run: [iteration, iterations],
            ..self
        }
    }

    /// Returns a value by name.
    pub fn value(&self, name: &str) -> f64 {
        let value = self.find(name);
        value.unwrap_or_else(|| unreachable!("a shader was refused for the unknown value {name}"))
    }

    /// Finds a value by name; none if the frame or the convention lacks it.
    pub fn find(&self, name: &str) -> Option<f64> {
        match name.strip_prefix(FRAME_PREFIX) {
            Some(member) => self.value_of_frame(member),
            None => self.named_value(name),
        }
    }

    /// Returns a number of the uniform `frame` of common.wgsl.
    fn value_of_frame(&self, member: &str) -> Option<f64> {
        match (member, split_element(member)) {
            ("frames_per_second", _) => Some(self.frames_per_second),
            (_, Some(("size", index))) => self.size.get(index).copied().map(f64::from),
            // The columns of a mat4x3 come one after the other.
            (_, Some(("reprojection", index))) => {
                Some(self.reprojection.rows[index % 3][index / 3])
            }
            _ => self.named_value(member),
        }
    }

    fn named_value(&self, name: &str) -> Option<f64> {
        let [width, height] = self.size.map(f64::from);
        Some(match name {
            "width" | "resolution[0]" => width,
            "height" | "resolution[1]" => height,
            // Frames are seen through the middle of each pixel.
            "jitter[0]" | "jitter[1]" => 0.0,
            "exposure" => self.exposure,
            "frame_index" => f64::from(self.frame_index),
            "iteration" => f64::from(self.run[0]),
            "iterations" => f64::from(self.run[1]),
            _ => {
                let of_matrix = || {
                    let (matrix, index) = split_element(name)?;
                    self.matrices.as_ref()?.number(matrix, index)
                };
                return self.convention.value(name).or_else(of_matrix);
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use frame::Raster;

    use super::*;
    use crate::shader::Shader;

    #[test]
    fn each_number_of_the_uniform_frame_of_common_wgsl_has_its_value() {
        let shader = Shader::parse(Path::new("none.wgsl"), "").unwrap();
        let reprojection = Reprojection {
            rows: [
                [1.0, 2.0, 3.0, 4.0],
                [5.0, 6.0, 7.0, 8.0],
                [9.0, 10.0, 11.0, 12.0],
            ],
        };
        let input = Input {
            color: &[],
            velocity: &Raster::from_fn(40, 30, |_, _| [0.0, 0.0]),
            velocity_next: None,
            velocity_z: None,
            exclusion: None,
            depth: &Raster::from_fn(40, 30, |_, _| 1.0),
            reprojection: Some(reprojection),
            camera: None,
            exposure: 0.5,
            frames_per_second: None,
            frame_index: 7,
        };
        let frame = FrameValues::of(&input, &Convention::default()).of_run(2, 3);
        let numbers = shader.blocks[0].numbers.iter();
        let values = numbers.map(|number| {
            (
                number.offset,
                number.value.evaluate(&|name| frame.value(name)),
            )
        });
        // Columns of a mat4x3 are filled up to four numbers, and begin at a multiple of 16 bytes.
        let columns =
            (0..4).flat_map(|x| (0..3).map(move |y| (32 + 16 * x + 4 * y, x + 4 * y + 1)));
        let members = [(0, 40), (4, 30), (12, 7), (16, 2), (20, 3), (24, 60)];
        let expected = members
            .into_iter()
            .chain(columns)
            .map(|(at, value)| (at, f64::from(value)));
        let mut expected: Vec<(u32, f64)> = expected.chain([(8, 0.5)]).collect();
        expected.sort_by_key(|(at, _)| *at);
        assert_eq!(values.collect::<Vec<_>>(), expected);
    }
}
