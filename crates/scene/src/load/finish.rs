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
    /// Builds the finish. Without a roughness it is diffuse, whatever the index: exporters write an
    /// index for every material. `names` are the file's for roughness, metallic and index; the
    /// error has the number of the wrong value among them, and says why.
    pub fn build(self, names: [&str; 3]) -> Result<Finish, (usize, String)> {
        let refuse =
            |wrong: usize, reason: String| Err((wrong, format!("{} {reason}", names[wrong])));
        let Some(roughness) = self.roughness else {
            return if self.metallic {
                let reason = "makes a metal without a roughness; give it one (0 is a mirror)";
                refuse(1, reason.into())
            } else {
                Ok(Finish::Diffuse)
            };
        };
        if roughness != 0.0 && !(Finish::SMOOTHEST..=1.0).contains(&roughness) {
            let smoothest = Finish::SMOOTHEST;
            let reason = format!("is {roughness}; allowed: 0 (a mirror) and {smoothest} to 1");
            return refuse(0, reason);
        }
        if self.metallic {
            return Ok(Finish::Conductor { roughness });
        }
        let index = self.index.unwrap_or(DEFAULT_INDEX);
        if !(1.0..=Finish::DENSEST).contains(&index) {
            let reason = format!("is {index}; allowed: 1 to {}", Finish::DENSEST);
            return refuse(2, reason);
        }
        // A coat of index 1 reflects nothing.
        Ok(if index == 1.0 {
            Finish::Diffuse
        } else {
            Finish::Coated { roughness, index }
        })
    }
}
