//! The pictures that belong to a case.

use std::path::{Path, PathBuf};

use crate::Case;

/// One picture of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// What the open shutter saw.
    Truth,
    /// What the filter made.
    Output,
    /// What the filter got.
    Instant,
    /// Where the difference is seen.
    Flip,
    /// Where the shutter's time went to the wrong object.
    LabelTotalVariation,
    /// Where a mover is that never was there.
    Bleed,
    /// How the instant moves.
    Velocity,
}

impl Layer {
    /// Every picture, in the order of a page.
    pub const ALL: [Layer; 7] = [
        Layer::Truth,
        Layer::Output,
        Layer::Instant,
        Layer::Flip,
        Layer::LabelTotalVariation,
        Layer::Bleed,
        Layer::Velocity,
    ];

    /// The word in files and attributes.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Truth => "truth",
            Layer::Output => "output",
            Layer::Instant => "instant",
            Layer::Flip => "flip",
            Layer::LabelTotalVariation => "label_tv",
            Layer::Bleed => "bleed",
            Layer::Velocity => "velocity",
        }
    }

    /// What a reader calls it.
    pub fn title(self) -> &'static str {
        match self {
            Layer::Truth => "Truth",
            Layer::Output => "Output",
            Layer::Instant => "Instant",
            Layer::Flip => "FLIP",
            Layer::LabelTotalVariation => "Label TV",
            Layer::Bleed => "Bleed",
            Layer::Velocity => "Velocity",
        }
    }

    /// What there is to see.
    pub fn hint(self) -> &'static str {
        match self {
            Layer::Truth => "what the open shutter saw, path traced",
            Layer::Output => "what the filter made of the instant",
            Layer::Instant => "the frame that the filter got: sharp, at one instant",
            Layer::Flip => "visible difference from the truth: black is none, bright is 1",
            Layer::LabelTotalVariation => {
                "share of the shutter that went to the wrong object: black is none, bright is all"
            }
            Layer::Bleed => "mover where the truth never shows it: black is none, bright is all",
            Layer::Velocity => {
                "direction as hue, speed as brightness: full at the fastest pixel, black stands still"
            }
        }
    }

    /// The file of a case's picture, in the folder of run.json.
    pub fn file(self, case: &Case, folder: &Path) -> PathBuf {
        let scene = folder.join(&case.scene);
        let own = folder.join(&case.folder);
        match self {
            Layer::Truth => scene.join(format!("truth_{}.png", case.alignment)),
            Layer::Instant => scene.join("frame.png"),
            Layer::Velocity => scene.join("velocity.png"),
            Layer::Output | Layer::Flip | Layer::LabelTotalVariation | Layer::Bleed => {
                own.join(format!("{}.png", self.name()))
            }
        }
    }

    /// Whether it reaches beyond the picture where the frame has a guard band.
    pub fn has_band(self) -> bool {
        matches!(self, Layer::Instant | Layer::Velocity)
    }
}
