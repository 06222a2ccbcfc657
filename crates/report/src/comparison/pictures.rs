//! Pictures of a case in two runs.

use frame::Plane;
use judge::Pair;
use measure::{Error, ErrorMaps, RenderFile, StoredRun};

use crate::pixels::png::{embed_file, embed_picture};

/// Pictures of one case, each embedded in an address.
pub struct Pictures {
    /// Output of the filter in either run.
    pub first: String,
    pub second: String,
    pub truth: Option<String>,
    /// Change of the visible difference from the truth.
    pub change: Option<String>,
}

impl Pictures {
    /// Reads the pictures; none if one of the runs has no picture of the case.
    pub fn read(sides: [&StoredRun; 2], pair: &Pair) -> Result<Option<Self>, Error> {
        let [first, second] = pair.files(sides, "output.png");
        let (Some(first), Some(second)) = (embed_file(&first)?, embed_file(&second)?) else {
            return Ok(None);
        };
        let truth = RenderFile::Truth(pair.first.alignment).picture();
        Ok(Some(Self {
            first,
            second,
            truth: embed_file(
                &sides[0]
                    .folder()
                    .join(pair.first.scene.folder())
                    .join(truth),
            )?,
            change: change(sides, pair)?,
        }))
    }
}

fn change(sides: [&StoredRun; 2], pair: &Pair) -> Result<Option<String>, Error> {
    let files = ["errors.exr", "output.exr"].map(|name| pair.files(sides, name));
    if !files.as_flattened().iter().all(|file| file.is_file()) {
        return Ok(None);
    }
    let flip = |case, side: &StoredRun| ErrorMaps::read(case, side.folder())?.map("flip");
    let (first, second) = (flip(pair.first, sides[0])?, flip(pair.second, sides[1])?);
    if !first.same_size(&second) {
        return Ok(None);
    }
    let worse: Plane = first.zip(&second, |first, second| second - first);
    Ok(Some(embed_picture(&worse.map(|worse| color(*worse)))))
}

/// Colours a change: orange is worse and blue better, as elsewhere on the page; black is no change,
/// full colour a half or more.
fn color(worse: f32) -> [f32; 3] {
    let full = if worse > 0.0 {
        [0.98, 0.55, 0.15]
    } else {
        [0.30, 0.62, 1.0]
    };
    let strength = (2.0 * worse.abs()).min(1.0).sqrt();
    full.map(|value| value * strength)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_change_is_black_and_the_two_ways_differ() {
        assert_eq!(color(0.0), [0.0; 3]);
        let ([worse, _, _], [_, _, better]) = (color(0.5), color(-0.5));
        assert!(worse > 0.9 && better > 0.9);
        assert!(color(0.5)[2] < 0.3 && color(-0.5)[0] < 0.4);
    }
}
