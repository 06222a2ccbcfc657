//! Forms of the input that an engine gives its motion blur.

use frame::{Frame, Picture, Vectors, VelocityKind};
use scene::Scene;
use serde::{Deserialize, Serialize};

use super::border::{Border, repeat_border, smear_margin};
use super::buffer_size::BufferSize;
use super::camera_jitter::CameraJitter;
use super::depth_format::DepthFormat;
use super::depth_of_field::DepthOfField;
use super::multisampling::Multisampling;
use super::render_scale::RenderScale;
use super::renderer::{Renderer, Renders};
use super::shutter_rule::ShutterRule;
use super::velocity_defect::VelocityDefect;
use super::velocity_format::VelocityFormat;
use crate::{Error, Monitor};

/// A kind of input, and its possible forms.
#[derive(Serialize)]
pub struct InputKind {
    /// Name, as in `velocity=float16`.
    pub name: &'static str,
    /// Description, in a sentence.
    pub help: &'static str,
    /// Its forms; the first one is the full one.
    pub forms: Vec<InputForm>,
}

/// One form of a kind of input.
#[derive(Serialize)]
pub struct InputForm {
    /// Name, as in `velocity=float16`.
    pub name: &'static str,
    /// Description, in a sentence.
    pub help: &'static str,
    /// The frame's format with this form, and full forms otherwise.
    #[serde(skip)]
    pub format: InputFormat,
}

/// Defines [`InputFormat`] from the kinds of input; files omit those after the semicolon if they
/// are full.
macro_rules! input_format {
    ($($kind:ident: $form:ident),+; $($later:ident: $later_form:ident),+) => {
        /// Form of the frame that a filter gets.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        pub struct InputFormat {
            $(#[doc = concat!("See [`", stringify!($form), "`].")] pub $kind: $form,)+
            $(
                #[doc = concat!("See [`", stringify!($later_form), "`].")]
                #[serde(default, skip_serializing_if = "is_default")]
                pub $later: $later_form,
            )+
        }

        input_format!(@kinds $($kind: $form,)+ $($later: $later_form,)+);
    };
    (@kinds $($kind:ident: $form:ident,)+) => {
        impl InputFormat {
            /// Lists the kinds of input and their forms.
            pub fn kinds() -> Vec<InputKind> {
                vec![$(InputKind {
                    name: stringify!($kind),
                    help: $form::ABOUT,
                    forms: ($form::ALL.iter())
                        .map(|form| InputForm {
                            name: form.name(),
                            help: form.help(),
                            format: Self { $kind: *form, ..Self::default() },
                        })
                        .collect(),
                }),+]
            }

            /// Names the differences from the full form, as on the command line:
            /// `velocity=float16`; none for the full form.
            pub fn change(&self) -> Option<String> {
                let full = Self::default();
                let mut changes = Vec::new();
                $(if self.$kind != full.$kind {
                    changes.push(format!("{}={}", stringify!($kind), self.$kind.name()));
                })+
                (!changes.is_empty()).then(|| changes.join(","))
            }
        }
    };
}

input_format! {
    velocity: VelocityFormat,
    depth: DepthFormat,
    border: Border;
    defect: VelocityDefect,
    buffers: BufferSize,
    msaa: Multisampling,
    jitter: CameraJitter,
    scale: RenderScale,
    rule: ShutterRule,
    depth_of_field: DepthOfField
}

fn is_default<T: Default + PartialEq>(part: &T) -> bool {
    *part == T::default()
}

impl InputFormat {
    /// Refuses a form that needs a missing scene, or motion that a buffer of camera motion alone
    /// does not have.
    pub(crate) fn check(&self, kind: VelocityKind, has_scene: bool) -> Result<(), Error> {
        let without_scene = Self {
            velocity: self.velocity,
            depth: self.depth,
            border: self.border,
            defect: self.defect,
            buffers: self.buffers,
            ..Self::default()
        };
        match self.change() {
            Some(change) if !has_scene && *self != without_scene => Err(Error::Refused(format!(
                "{change}: needs the scene, which an engine's capture does not have; leave this form out, or leave out the capture"
            ))),
            _ => self.defect.check(kind, has_scene),
        }
    }

    /// Returns the frame as a filter gets it, and colour and coverage of its replicates in the same
    /// form. Some forms need the scene to render it again.
    ///
    /// # Errors
    /// The form needs a scene, and there is none; or the scene cannot be rendered in this form.
    pub(crate) fn apply(
        &self,
        frame: &Frame,
        replicates: &[Picture],
        scene: Option<&Scene>,
        monitor: Monitor,
    ) -> Result<(Frame, Vec<Picture>), Error> {
        let mut renders = Renders::default();
        let whole = self.apply_with(frame, scene, &renders, monitor)?;
        let mut pictures = Vec::new();
        for (index, replicate) in replicates.iter().enumerate() {
            renders.replicate = Some(index);
            let output = self.apply_with(&frame.showing(replicate), scene, &renders, monitor)?;
            pictures.push(output.into_picture());
        }
        Ok((whole, pictures))
    }

    fn apply_with(
        &self,
        frame: &Frame,
        scene: Option<&Scene>,
        renders: &Renders,
        monitor: Monitor,
    ) -> Result<Frame, Error> {
        self.check(frame.options.velocity, scene.is_some())?;
        let mut stored = frame.clone();
        if let Some(scene) = scene {
            self.depth_of_field.check(scene)?;
            let (seen, scene) = self.depth_of_field.apply(stored, scene, renders, monitor)?;
            let renderer = Renderer::of(frame, &scene, renders, monitor);
            stored = self.msaa.apply(seen, &renderer)?;
            stored = self.jitter.apply(stored, &renderer)?;
            stored = self.scale.apply(stored, &renderer)?;
            stored = self.rule.apply(stored, &scene);
        }
        stored.velocity = self.defect.apply(&stored, scene)?;
        let store = |velocity: &Vectors| self.velocity.apply(&stored, velocity);
        let next = stored.velocity_next.as_ref().map(store);
        stored.velocity = store(&stored.velocity);
        stored.velocity_next = next;
        stored.depth = self.depth.apply(&stored.depth);
        stored = self.buffers.apply(stored);
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
    fn every_form_changes_one_kind_and_some_need_the_scene() {
        let needs_scene = ["msaa", "jitter", "scale", "rule", "depth_of_field"];
        let kinds = InputFormat::kinds();
        assert_eq!(kinds.len(), 10);
        for kind in kinds {
            assert_eq!(kind.forms[0].format, InputFormat::default());
            for form in &kind.forms[1..] {
                let place = format!("{}={}", kind.name, form.name);
                assert_eq!(form.format.change().as_ref(), Some(&place));
                let check = |has_scene| form.format.check(VelocityKind::Instantaneous, has_scene);
                assert!(check(true).is_ok());
                let refusal = check(false).err().map(|error| error.to_string());
                let refusal =
                    refusal.filter(|text| text.starts_with(&(place + ": needs the scene, ")));
                assert_eq!(refusal.is_some(), needs_scene.contains(&kind.name));
            }
        }
    }
}
