//! Defects that were found, in words.

use serde::Serialize;

use crate::audit::cause::Cause;

/// What a defect is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Buffer {
    /// Screen motion.
    Velocity,
    /// Distance along the view axis.
    Depth,
    /// Radiance.
    Color,
    /// Objects at the pixels' centres.
    ObjectId,
    /// All of them: the capture shows something else than the scene at its instant, and cannot be compared there.
    Picture,
}

/// A cause that was found, and how well it explains what is wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// The cause.
    pub cause: Cause,
    /// A sign or an axis that is wrong as well.
    pub turned: Option<Cause>,
    /// Other causes that would look the same in this scene.
    pub looks_like: Vec<Cause>,
    /// Part of the pixels that the cause explains.
    pub explained: f64,
}

impl Explanation {
    /// Explains by one cause that no other looks like.
    pub fn by(cause: Cause, explained: f64) -> Self {
        Self {
            turned: None,
            cause,
            looks_like: Vec::new(),
            explained,
        }
    }
}

/// A defect that was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Defect {
    /// Buffer that has it.
    pub buffer: Buffer,
    /// Object that has it; none if all do.
    pub object: Option<String>,
    /// Its cause.
    #[serde(flatten)]
    pub found: Explanation,
    /// Part of the object that has the defect; none if all of it has.
    pub part: Option<f64>,
    /// The defect in words, and the way out.
    pub text: String,
}

impl Defect {
    /// Words a defect.
    pub fn new(buffer: Buffer, object: Option<&str>, found: Explanation) -> Self {
        let whose = match object {
            Some(object) => format!("of `{object}` "),
            None => String::new(),
        };
        let turn = found
            .turned
            .map_or(String::new(), |turn| format!("{} and ", turn.name()));
        let mut text = format!("{} {whose}{turn}{}", buffer.name(), found.cause.name());
        if !found.looks_like.is_empty() {
            let others: Vec<String> = found.looks_like.iter().map(|cause| cause.name()).collect();
            text += &format!(
                "; in this scene that looks the same as: {}",
                others.join(", ")
            );
        }
        let advice = found.turned.into_iter().chain([found.cause]);
        for advice in advice.filter_map(|cause| cause.advice(object.is_some())) {
            text += &format!("; {advice}");
        }
        Self {
            buffer,
            object: object.map(str::to_owned),
            found,
            part: None,
            text,
        }
    }

    /// Limits the defect to a part of the object's pixels.
    pub fn in_part(mut self, part: Option<f64>) -> Self {
        if let Some(part) = part.filter(|part| *part < 0.995) {
            self.text += &format!(
                "; in {:.0} % of its pixels, the others are right",
                100.0 * part
            );
            self.part = Some(part);
        }
        self
    }

    /// Says more.
    pub fn with(mut self, text: &str) -> Self {
        self.text += "; ";
        self.text += text;
        self
    }
}

impl Buffer {
    fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Depth => "depth",
            Self::Color => "colour",
            Self::ObjectId => "object id",
            Self::Picture => "picture",
        }
    }
}
