//! The finish of a surface, from the numbers that files give.

use crate::Finish;

/// Refractive index of a coat if no file gives one: glass, most paints and plastics.
const DEFAULT_INDEX: f32 = 1.5;

/// Values that a file may give for a finish.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FinishValues {
    pub roughness: Option<f32>,
    pub metallic: bool,
    pub index: Option<f32>,
}

/// Name of one of the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FinishValue {
    Roughness,
    Metallic,
    Index,
}

impl From<Finish> for FinishValues {
    fn from(finish: Finish) -> Self {
        match finish {
            Finish::Diffuse => Self::default(),
            Finish::Conductor { roughness } => Self {
                roughness: Some(roughness),
                metallic: true,
                index: None,
            },
            Finish::Coated { roughness, index } => Self {
                roughness: Some(roughness),
                metallic: false,
                index: Some(index),
            },
        }
    }
}

impl FinishValues {
    /// Builds the finish. Without a roughness it is diffuse, whatever the index: exporters write an index for every
    /// material. The error names the wrong value and says why.
    pub fn build(self) -> Result<Finish, (FinishValue, String)> {
        let Some(roughness) = self.roughness else {
            return if self.metallic {
                let reason = "makes a metal without a roughness; give it one (0 is a mirror)";
                Err((FinishValue::Metallic, reason.into()))
            } else {
                Ok(Finish::Diffuse)
            };
        };
        if roughness != 0.0 && !(Finish::SMOOTHEST..=1.0).contains(&roughness) {
            let smoothest = Finish::SMOOTHEST;
            let reason = format!("is {roughness}; allowed: 0 (a mirror) and {smoothest} to 1");
            return Err((FinishValue::Roughness, reason));
        }
        if self.metallic {
            return Ok(Finish::Conductor { roughness });
        }
        let index = self.index.unwrap_or(DEFAULT_INDEX);
        if !(1.0..=Finish::DENSEST).contains(&index) {
            let reason = format!("is {index}; allowed: 1 to {}", Finish::DENSEST);
            return Err((FinishValue::Index, reason));
        }
        // A coat of index 1 reflects nothing.
        Ok(if index == 1.0 {
            Finish::Diffuse
        } else {
            Finish::Coated { roughness, index }
        })
    }
}
