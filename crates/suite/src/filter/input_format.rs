//! Formats in which an engine stores the input of its motion blur.

use frame::Frame;
use serde::{Deserialize, Serialize};
use tracer::Scene;

use super::border::{Border, repeat_border, smear_margin};
use super::depth_format::DepthFormat;
use super::velocity_defect::VelocityDefect;
use super::velocity_format::VelocityFormat;
use crate::Error;

/// The form in which a filter gets its frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFormat {
    /// Format of the velocity buffer.
    pub velocity: VelocityFormat,
    /// Format of the depth buffer.
    pub depth: DepthFormat,
    /// Policy beyond the picture.
    pub border: Border,
    /// Defect of the velocity buffer.
    #[serde(default, skip_serializing_if = "is_right")]
    pub defect: VelocityDefect,
}

fn is_right(defect: &VelocityDefect) -> bool {
    *defect == VelocityDefect::None
}

impl InputFormat {
    /// Lists the full form, and then each of the others alone, so that a change of scores has one cause.
    pub fn one_by_one(
        velocities: &[VelocityFormat],
        depths: &[DepthFormat],
        borders: &[Border],
        defects: &[VelocityDefect],
    ) -> Vec<Self> {
        let full = Self::default();
        let mut formats = vec![full];
        formats.extend(velocities.iter().map(|&velocity| Self { velocity, ..full }));
        formats.extend(depths.iter().map(|&depth| Self { depth, ..full }));
        formats.extend(borders.iter().map(|&border| Self { border, ..full }));
        formats.extend(defects.iter().map(|&defect| Self { defect, ..full }));
        let mut once = Vec::new();
        for format in formats {
            if !once.contains(&format) {
                once.push(format);
            }
        }
        once
    }

    /// Names what differs from the full form, as the command line does: `velocity=float16`; none for the full form.
    pub fn change(&self) -> Option<String> {
        let full = Self::default();
        let all = [
            ("velocity", self.velocity.name(), full.velocity.name()),
            ("depth", self.depth.name(), full.depth.name()),
            ("border", self.border.name(), full.border.name()),
            ("defect", self.defect.name(), full.defect.name()),
        ];
        let changes: Vec<String> = (all.iter().filter(|(_, own, full)| own != full))
            .map(|(part, own, _)| format!("{part}={own}"))
            .collect();
        (!changes.is_empty()).then(|| changes.join(","))
    }

    /// Returns the frame as it comes out of these buffers. Some defects of velocity need the scene.
    ///
    /// # Errors
    /// The defect needs a scene, and there is none; or its motion cannot be traced.
    pub fn apply(&self, frame: &Frame, scene: Option<&Scene>) -> Result<Frame, Error> {
        let mut stored = Frame {
            velocity: self.defect.apply(frame, scene)?,
            depth: self.depth.apply(&frame.depth),
            ..frame.clone()
        };
        stored.velocity = self.velocity.apply(&stored);
        Ok(match self.border {
            Border::Leave => stored,
            Border::Clamp => repeat_border(&stored, smear_margin(frame)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_is_tried_alone_and_once() {
        let formats = InputFormat::one_by_one(
            &[VelocityFormat::Float32, VelocityFormat::Linear8],
            &[DepthFormat::Float16],
            &[Border::Clamp, Border::Leave],
            &[VelocityDefect::Lag],
        );
        let changes: Vec<_> = formats.iter().map(|format| format.change()).collect();
        let said = |text: &str| Some(text.to_owned());
        assert_eq!(
            changes,
            [
                None,
                said("velocity=linear8"),
                said("depth=float16"),
                said("border=clamp"),
                said("defect=lag")
            ]
        );
    }
}
