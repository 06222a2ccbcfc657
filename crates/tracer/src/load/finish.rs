//! How a surface reflects, from the numbers that files give.

use crate::Finish;

/// Of a coat for which none is given: glass, and most paints and plastics.
const DEFAULT_INDEX: f32 = 1.5;

/// What a file may say about a finish.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Numbers {
    pub roughness: Option<f32>,
    pub metallic: bool,
    pub index: Option<f32>,
}

/// One of the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    Roughness,
    Metallic,
    Index,
}

impl Numbers {
    /// What the finish was made from.
    pub fn of(finish: Finish) -> Self {
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

    /// Without a roughness nothing glosses, whatever the index: exporters write one for every material. The error is the
    /// number that is amiss, and why.
    pub fn finish(self) -> Result<Finish, (Number, String)> {
        let Some(roughness) = self.roughness else {
            return if self.metallic {
                let reason = "makes a metal, of no roughness; give it one (0 is a mirror)";
                Err((Number::Metallic, reason.into()))
            } else {
                Ok(Finish::Diffuse)
            };
        };
        if roughness != 0.0 && !(Finish::SMOOTHEST..=1.0).contains(&roughness) {
            let smoothest = Finish::SMOOTHEST;
            let reason = format!("is {roughness}; allowed: 0 (a mirror) and {smoothest} to 1");
            return Err((Number::Roughness, reason));
        }
        if self.metallic {
            return Ok(Finish::Conductor { roughness });
        }
        let index = self.index.unwrap_or(DEFAULT_INDEX);
        if !(1.0..=Finish::DENSEST).contains(&index) {
            let densest = Finish::DENSEST;
            return Err((
                Number::Index,
                format!("is {index}; allowed: 1 to {densest}"),
            ));
        }
        // A coat of air reflects nothing.
        Ok(if index == 1.0 {
            Finish::Diffuse
        } else {
            Finish::Coated { roughness, index }
        })
    }
}
