//! Reference pictures.

/// Name of the filter and of the reference picture that leave the frame as it is.
pub const IDENTITY: &str = "identity";
const SCATTER_ORACLE: &str = "scatter_oracle";
const ACCUMULATE: &str = "accumulate";

/// A picture to compare filters with: no filter made it, and no bound limits it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReferencePicture {
    /// The frame as it is: `identity`.
    Identity,
    /// The one-frame oracle, [`metrics::scatter_oracle`]: `scatter_oracle`.
    ScatterOracle,
    /// The mean of a number of sub-frames: `accumulate:16`.
    Accumulation(u32),
}

impl ReferencePicture {
    /// Finds the picture that a case names like a filter with its preset.
    pub(super) fn find(name: &str, preset: &str) -> Option<Self> {
        match name {
            IDENTITY => Some(Self::Identity),
            SCATTER_ORACLE => Some(Self::ScatterOracle),
            ACCUMULATE => preset.parse().ok().map(Self::Accumulation),
            _ => None,
        }
    }

    /// Returns the name in files and tables, in place of a filter's.
    pub fn name(self) -> &'static str {
        match self {
            Self::Identity => IDENTITY,
            Self::ScatterOracle => SCATTER_ORACLE,
            Self::Accumulation(_) => ACCUMULATE,
        }
    }

    /// Returns what stands in place of a preset: the number of sub-frames, or nothing.
    pub fn preset(self) -> String {
        match self {
            Self::Identity | Self::ScatterOracle => String::new(),
            Self::Accumulation(subframes) => subframes.to_string(),
        }
    }
}

#[test]
fn reference_pictures_are_found_by_their_names() {
    for picture in [
        ReferencePicture::Identity,
        ReferencePicture::ScatterOracle,
        ReferencePicture::Accumulation(16),
    ] {
        let named = ReferencePicture::find(picture.name(), &picture.preset());
        assert_eq!(named, Some(picture));
    }
    assert_eq!(ReferencePicture::find("jump_flood", "paper"), None);
    assert_eq!(ReferencePicture::find("accumulate", "few"), None);
}
