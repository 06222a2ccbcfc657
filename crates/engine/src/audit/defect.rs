//! Descriptions of the defects found.

use serde::Serialize;

use crate::audit::cause::Cause;

/// Buffer with a defect.
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
    /// All of them: the capture does not show the scene at its instant, and cannot be compared
    /// there.
    Picture,
}

/// A cause, and how well it explains a defect.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// The cause.
    pub cause: Cause,
    /// A sign or an axis that is also wrong.
    pub turned: Option<Cause>,
    /// Other causes that would look the same in this scene.
    pub looks_like: Vec<Cause>,
    /// Part of the pixels that the cause explains.
    pub explained: f64,
    /// True if a unit, sign or axis as wrong as this would make right objects wrong: it is not the
    /// convention's.
    pub convention_holds: bool,
}

impl Explanation {
    /// Explains by one unambiguous cause.
    pub fn by(cause: Cause, explained: f64) -> Self {
        Self {
            turned: None,
            cause,
            looks_like: Vec::new(),
            explained,
            convention_holds: false,
        }
    }

    /// Words remedies, and whether the convention is among what may be wrong.
    fn advise(&self, is_of_object: bool) -> String {
        // Another unit may be what looks like a structure.
        let units = self
            .looks_like
            .iter()
            .filter(|cause| cause.is_unit_of_two());
        let causes = self.turned.iter().chain([&self.cause]).chain(units);
        let (fits, advised): (Vec<&Cause>, Vec<&Cause>) =
            causes.partition(|cause| self.convention_holds && cause.is_of_convention());
        let fits = (!fits.is_empty()).then(|| "the convention fits other objects".to_owned());
        let advice = advised.iter();
        let advice = advice.filter_map(|cause| cause.advice(is_of_object));
        let words = fits.into_iter().chain(advice);
        words.map(|words| format!("; {words}")).collect()
    }
}

/// A defect.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Defect {
    /// Affected buffer.
    pub buffer: Buffer,
    /// Affected object; none if all are.
    pub object: Option<String>,
    /// Its cause.
    #[serde(flatten)]
    pub explanation: Explanation,
    /// Affected part of the object; none for all of it.
    pub part: Option<f64>,
    /// Description of the defect, and its remedy.
    pub text: String,
}

impl Defect {
    /// Words a defect.
    pub fn new(buffer: Buffer, object: Option<&str>, explanation: Explanation) -> Self {
        let whose = match object {
            Some(object) => format!("of `{object}` "),
            None => String::new(),
        };
        let name = |cause: &Cause| match object {
            Some(_) => cause.name_on_object(),
            None => cause.name(),
        };
        let turn = explanation.turned.as_ref();
        let turn = turn.map_or(String::new(), |turn| format!("{} and ", name(turn)));
        let mut text = format!(
            "{} {whose}{turn}{}",
            buffer.name(),
            name(&explanation.cause)
        );
        if !explanation.looks_like.is_empty() {
            let others: Vec<String> = explanation.looks_like.iter().map(name).collect();
            text += &format!(
                "; in this scene that looks the same as: {}",
                others.join(", ")
            );
        }
        text += &explanation.advise(object.is_some());
        Self {
            buffer,
            object: object.map(str::to_owned),
            explanation,
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

    /// Adds text.
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
