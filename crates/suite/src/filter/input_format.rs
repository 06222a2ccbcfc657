//! Forms in which an engine hands over the input of its motion blur.

use frame::{Frame, VelocityKind};
use serde::{Deserialize, Serialize};
use tracer::Scene;

use super::border::{Border, repeat_border, smear_margin};
use super::buffer_size::BufferSize;
use super::camera_jitter::CameraJitter;
use super::depth_format::DepthFormat;
use super::depth_of_field::DepthOfField;
use super::multisampling::Multisampling;
use super::render_scale::RenderScale;
use super::shutter_rule::ShutterRule;
use super::velocity_defect::VelocityDefect;
use super::velocity_format::VelocityFormat;
use crate::{Error, Monitor};

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
    #[serde(default, skip_serializing_if = "is_default")]
    pub defect: VelocityDefect,
    /// Size of the velocity and depth buffers.
    #[serde(default, skip_serializing_if = "is_default")]
    pub buffers: BufferSize,
    /// Samples per pixel of the rasteriser.
    #[serde(default, skip_serializing_if = "is_default")]
    pub msaa: Multisampling,
    /// Jitter of the camera.
    #[serde(default, skip_serializing_if = "is_default")]
    pub jitter: CameraJitter,
    /// Scale of the frame.
    #[serde(default, skip_serializing_if = "is_default")]
    pub scale: RenderScale,
    /// Rule by which the filter's exposure follows the frame rate.
    #[serde(default, skip_serializing_if = "is_default")]
    pub rule: ShutterRule,
    /// Place of depth of field.
    #[serde(default, skip_serializing_if = "is_default")]
    pub depth_of_field: DepthOfField,
}

/// Forms to try, part by part.
#[derive(Clone, Debug, Default)]
pub struct InputForms {
    /// Formats of the velocity buffer.
    pub velocity: Vec<VelocityFormat>,
    /// Formats of the depth buffer.
    pub depth: Vec<DepthFormat>,
    /// Policies beyond the picture.
    pub border: Vec<Border>,
    /// Defects of the velocity buffer.
    pub defect: Vec<VelocityDefect>,
    /// Sizes of the velocity and depth buffers.
    pub buffers: Vec<BufferSize>,
    /// Samples per pixel of the rasteriser.
    pub msaa: Vec<Multisampling>,
    /// Jitters of the camera.
    pub jitter: Vec<CameraJitter>,
    /// Scales of the frame.
    pub scale: Vec<RenderScale>,
    /// Rules by which the filter's exposure follows the frame rate.
    pub rule: Vec<ShutterRule>,
    /// Places of depth of field.
    pub depth_of_field: Vec<DepthOfField>,
}

fn is_default<T: Default + PartialEq>(part: &T) -> bool {
    *part == T::default()
}

impl InputForms {
    /// Lists the full form, and then each of the others alone, so that a change of scores has one cause.
    pub fn one_by_one(&self) -> Vec<InputFormat> {
        let full = InputFormat::default();
        let mut formats = vec![full];
        let mut try_each = |others: &mut dyn Iterator<Item = InputFormat>| {
            for format in others {
                if !formats.contains(&format) {
                    formats.push(format);
                }
            }
        };
        try_each(&mut (self.velocity.iter()).map(|&velocity| InputFormat { velocity, ..full }));
        try_each(&mut (self.depth.iter()).map(|&depth| InputFormat { depth, ..full }));
        try_each(&mut (self.border.iter()).map(|&border| InputFormat { border, ..full }));
        try_each(&mut (self.defect.iter()).map(|&defect| InputFormat { defect, ..full }));
        try_each(&mut (self.buffers.iter()).map(|&buffers| InputFormat { buffers, ..full }));
        try_each(&mut (self.msaa.iter()).map(|&msaa| InputFormat { msaa, ..full }));
        try_each(&mut (self.jitter.iter()).map(|&jitter| InputFormat { jitter, ..full }));
        try_each(&mut (self.scale.iter()).map(|&scale| InputFormat { scale, ..full }));
        try_each(&mut (self.rule.iter()).map(|&rule| InputFormat { rule, ..full }));
        let places = self.depth_of_field.iter();
        try_each(&mut places.map(|&depth_of_field| InputFormat {
            depth_of_field,
            ..full
        }));
        formats
    }
}

impl InputFormat {
    /// Names what differs from the full form, as the command line does: `velocity=float16`; none for the full form.
    pub fn change(&self) -> Option<String> {
        let full = Self::default();
        let all = [
            ("velocity", self.velocity.name(), full.velocity.name()),
            ("depth", self.depth.name(), full.depth.name()),
            ("border", self.border.name(), full.border.name()),
            ("defect", self.defect.name(), full.defect.name()),
            ("buffers", self.buffers.name(), full.buffers.name()),
            ("msaa", self.msaa.name(), full.msaa.name()),
            ("jitter", self.jitter.name(), full.jitter.name()),
            ("scale", self.scale.name(), full.scale.name()),
            ("rule", self.rule.name(), full.rule.name()),
            (
                "depth_of_field",
                self.depth_of_field.name(),
                full.depth_of_field.name(),
            ),
        ];
        let changes: Vec<String> = (all.iter().filter(|(_, own, full)| own != full))
            .map(|(part, own, _)| format!("{part}={own}"))
            .collect();
        (!changes.is_empty()).then(|| changes.join(","))
    }

    /// Refuses a form of what is not known: of motion that a capture, or a buffer of the camera's motion alone, does not have, or of a
    /// scene that an engine drew.
    pub(crate) fn check(&self, kind: VelocityKind, has_scene: bool) -> Result<(), Error> {
        let rendered_again = [
            ("--msaa", self.msaa.name(), is_default(&self.msaa)),
            (
                "--camera-jitter",
                self.jitter.name(),
                is_default(&self.jitter),
            ),
            ("--render-scale", self.scale.name(), is_default(&self.scale)),
            (
                "--depth-of-field",
                self.depth_of_field.name(),
                is_default(&self.depth_of_field),
            ),
        ];
        if !is_default(&self.rule) && !has_scene {
            return Err(Error::Usage(format!(
                "--shutter-rule {}: follows the frame rate of a scene, which an engine's capture does not have; leave the option \
                 out, or leave out the capture",
                self.rule.name()
            )));
        }
        match rendered_again.iter().find(|(.., is_full)| !is_full) {
            Some((option, name, _)) if !has_scene => Err(Error::Usage(format!(
                "{option} {name}: renders the scene again, which an engine's capture does not have; leave the option out, \
                 or leave out the capture"
            ))),
            _ => self.defect.check(kind, has_scene),
        }
    }

    /// Returns the frame as a filter gets it. Some forms need the scene, to render it again.
    ///
    /// # Errors
    /// The form needs a scene, and there is none; or the scene cannot be rendered so.
    pub fn apply(
        &self,
        frame: &Frame,
        scene: Option<&Scene>,
        monitor: Monitor,
    ) -> Result<Frame, Error> {
        self.check(frame.options.velocity, scene.is_some())?;
        let rendered = match scene {
            None => frame.clone(),
            Some(scene) => {
                self.depth_of_field.check(scene)?;
                let scene = &*self.depth_of_field.seen_scene(scene);
                let frame = self.depth_of_field.apply(frame, scene, monitor)?;
                let frame = self.msaa.apply(&frame, scene, monitor)?;
                let frame = self.jitter.apply(&frame, scene, monitor)?;
                let frame = self.scale.apply(&frame, scene, monitor)?;
                self.rule.apply(frame, scene)
            }
        };
        let mut stored = Frame {
            velocity: self.defect.apply(&rendered, scene)?,
            depth: self.depth.apply(&rendered.depth),
            ..rendered
        };
        stored.velocity = self.velocity.apply(&stored);
        let stored = self.buffers.apply(stored);
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
        let forms = InputForms {
            velocity: vec![VelocityFormat::Float32, VelocityFormat::Linear8],
            depth: vec![DepthFormat::Float16],
            border: vec![Border::Clamp, Border::Leave],
            defect: vec![VelocityDefect::Lag],
            buffers: vec![BufferSize::Half, BufferSize::Full],
            msaa: vec![Multisampling::First],
            jitter: vec![CameraJitter::LeftIn],
            scale: vec![RenderScale::HalfBlurFirst],
            rule: vec![ShutterRule::InFrames],
            depth_of_field: vec![DepthOfField::Before, DepthOfField::After],
        };
        let formats = forms.one_by_one();
        let changes: Vec<_> = formats.iter().map(|format| format.change()).collect();
        let said = |text: &str| Some(text.to_owned());
        assert_eq!(
            changes,
            [
                None,
                said("velocity=linear8"),
                said("depth=float16"),
                said("border=clamp"),
                said("defect=lag"),
                said("buffers=half"),
                said("msaa=first"),
                said("jitter=left_in"),
                said("scale=50_blur_first"),
                said("rule=in_frames"),
                said("depth_of_field=after"),
            ]
        );
    }

    #[test]
    fn forms_that_render_again_are_refused_without_a_scene() {
        let forms = InputForms {
            buffers: vec![BufferSize::Half],
            msaa: vec![Multisampling::Nearest],
            jitter: vec![CameraJitter::Resolved],
            scale: vec![RenderScale::HalfUpscaleFirst],
            rule: vec![ShutterRule::InTime],
            depth_of_field: vec![DepthOfField::After],
            ..InputForms::default()
        };
        let refused: Vec<_> = (forms.one_by_one().iter())
            .map(|form| form.check(VelocityKind::Instantaneous, false).err())
            .map(|error| error.map(|error| error.to_string()))
            .collect();
        assert_eq!(refused[..2], [None, None]);
        for (error, option) in refused[2..].iter().zip([
            "--msaa nearest: ",
            "--camera-jitter resolved: ",
            "--render-scale 50_upscale_first: ",
            "--shutter-rule in_time: ",
            "--depth-of-field after: ",
        ]) {
            assert!(error.as_ref().unwrap().starts_with(option), "{error:?}");
        }
        for form in forms.one_by_one() {
            assert!(form.check(VelocityKind::Instantaneous, true).is_ok());
        }
    }
}
