//! Motion of an imported scene.

use tracer::Family;

use crate::Error;

/// Speeds; at least one is given.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motions {
    /// The stand turns by so many degrees per frame.
    pub spin: Option<f64>,
    /// The stand goes so many pixels per frame to the right, at the model's middle and 640x360.
    pub slide: Option<f64>,
    /// The camera goes so many degrees per frame around the model.
    pub orbit: Option<f64>,
}

impl Motions {
    /// Refuses a scene in which nothing moves.
    pub fn check(&self) -> Result<(), Error> {
        match (self.spin, self.slide, self.orbit) {
            (None, None, None) => Err(Error::Usage(
                "nothing would move; give one or more of --spin 20deg/frame, --slide 40px/frame, --orbit 3deg/frame"
                    .to_owned(),
            )),
            _ => Ok(()),
        }
    }

    /// What a scene that moves so belongs to.
    pub fn family(&self) -> Family {
        match (self.spin, self.slide) {
            (Some(_), _) => Family::Rotation,
            (None, Some(_)) => Family::Translation,
            (None, None) => Family::Camera,
        }
    }

    /// `it turns 20 degrees per frame, and it slides 40 pixels per frame`
    pub fn sentence(&self) -> String {
        let says = [
            self.spin
                .map(|speed| format!("it turns {speed} degrees per frame")),
            self.slide
                .map(|speed| format!("it slides {speed} pixels per frame")),
            (self.orbit)
                .map(|speed| format!("the camera goes around it by {speed} degrees per frame")),
        ];
        let says: Vec<String> = says.into_iter().flatten().collect();
        says.join(", and ")
    }
}
