//! Conversion of colours to Rec.709, from the primaries that a file states.

use exr::meta::attribute::Chromaticities;
use exr::meta::header::Header;
use glam::{DMat3, DVec3};

/// CIE xy of red, green, blue and white.
type Primaries = [[f32; 2]; 4];

/// Rec.709, whose white is D65.
const REC_709: Primaries = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]];
/// Largest difference of a coordinate that is rounding: programs write three to five digits.
const ROUNDING: f32 = 1e-4;
/// Responses of the eye's cones to XYZ, in which Bradford's adaptation scales white to white.
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);
/// Smallest determinant of primaries that span colours; Rec.709's is 0.11.
const FLAT: f64 = 1e-6;

/// Meaning of a file's colours, by its attributes. The default is this program's: Rec.709 without a
/// unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ColorMeaning {
    /// Primaries and white; none for Rec.709.
    primaries: Option<Primaries>,
    /// Luminance of the colour (1, 1, 1), in cd/m2, if the file states one.
    pub white_luminance: Option<f32>,
}

impl ColorMeaning {
    /// Reads the attributes `chromaticities` and `whiteLuminance`.
    pub(super) fn of(header: &Header) -> Self {
        let primaries = header.shared_attributes.chromaticities.map(primaries_of);
        Self {
            primaries: primaries.filter(|primaries| !is_rec_709(primaries)),
            white_luminance: header.own_attributes.white_luminance,
        }
    }

    /// Returns the matrix that converts linear colours to Rec.709, with Bradford's adaptation to
    /// D65; none if they are Rec.709. The error is a reason.
    pub(super) fn to_rec_709(self) -> Result<Option<DMat3>, String> {
        if let Some(luminance) = self.white_luminance {
            return Err(format!(
                "states a whiteLuminance of {luminance} cd/m2, and colours have no absolute unit here; save the picture without \
                 that attribute, or state a factor on its colours: color_scale = 1 in [convention]"
            ));
        }
        let Some(primaries) = self.primaries else {
            return Ok(None);
        };
        let refuse = || {
            format!(
                "states chromaticities of {}, which are no primaries of colours; save the picture in Rec.709",
                describe(&primaries)
            )
        };
        let from = to_xyz(&primaries).ok_or_else(refuse)?;
        let to = to_xyz(&REC_709).expect("Rec.709 has primaries");
        let whites = [primaries, REC_709].map(|[.., white]| BRADFORD * xyz(white));
        let adapt = BRADFORD.inverse() * DMat3::from_diagonal(whites[1] / whites[0]) * BRADFORD;
        let matrix = to.inverse() * adapt * from;
        if matrix.is_finite() {
            Ok(Some(matrix))
        } else {
            Err(refuse())
        }
    }

    /// Describes the conversion of the colours; none if they stay as they are.
    pub fn note(&self) -> Option<String> {
        self.primaries.map(|primaries| {
            format!(
                "colours were converted to Rec.709 (Bradford) from {}",
                describe(&primaries)
            )
        })
    }
}

/// Converts a colour.
pub(super) fn convert(matrix: &DMat3, color: &[f32; 3]) -> [f32; 3] {
    let [r, g, b] = color.map(f64::from);
    (*matrix * DVec3::new(r, g, b)).as_vec3().to_array()
}

fn primaries_of(attribute: Chromaticities) -> Primaries {
    let Chromaticities {
        red,
        green,
        blue,
        white,
    } = attribute;
    [red, green, blue, white].map(|place| [place.0, place.1])
}

fn is_rec_709(primaries: &Primaries) -> bool {
    let pairs = primaries.as_flattened().iter().zip(REC_709.as_flattened());
    pairs
        .into_iter()
        .all(|(one, other)| (one - other).abs() <= ROUNDING)
}

fn describe([red, green, blue, white]: &Primaries) -> String {
    format!("red {red:?}, green {green:?}, blue {blue:?}, white {white:?} (CIE xy)")
}

/// XYZ of a white with luminance 1.
fn xyz(white: [f32; 2]) -> DVec3 {
    let [x, y] = white.map(f64::from);
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

/// Returns the matrix from linear colours to XYZ, where (1, 1, 1) has the white's XYZ; none if the
/// primaries span no colours.
fn to_xyz([red, green, blue, white]: &Primaries) -> Option<DMat3> {
    let column = |place: &[f32; 2]| {
        let [x, y] = place.map(f64::from);
        DVec3::new(x, y, 1.0 - x - y)
    };
    let unscaled = DMat3::from_cols(column(red), column(green), column(blue));
    let spans = unscaled.determinant().abs() > FLAT && f64::from(white[1]) > FLAT;
    spans.then(|| unscaled * DMat3::from_diagonal(unscaled.inverse() * xyz(*white)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const XYZ: Primaries = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0]];
    const ACES_CG: Primaries = [
        [0.713, 0.293],
        [0.165, 0.83],
        [0.128, 0.044],
        [0.32168, 0.33767],
    ];

    fn matrix(primaries: Primaries) -> Result<Option<DMat3>, String> {
        let meaning = ColorMeaning {
            primaries: Some(primaries).filter(|primaries| !is_rec_709(primaries)),
            white_luminance: None,
        };
        meaning.to_rec_709()
    }

    fn assert_near(matrix: DMat3, due: [[f64; 3]; 3]) {
        // Published with that many digits.
        let due = DMat3::from_cols_array_2d(&due).transpose();
        assert!(matrix.abs_diff_eq(due, 5e-4), "{matrix} {due}");
    }

    #[test]
    fn white_stays_white_and_published_matrices_are_met() {
        for primaries in [XYZ, ACES_CG] {
            let white = convert(&matrix(primaries).unwrap().unwrap(), &[0.5; 3]);
            assert!(
                white.iter().all(|part| (part - 0.5).abs() < 1e-6),
                "{white:?}"
            );
        }
        // ACEScg to Rec.709 with Bradford, as in OpenColorIO's built-in transforms.
        assert_near(
            matrix(ACES_CG).unwrap().unwrap(),
            [
                [1.7050509927, -0.6217921207, -0.0832588720],
                [-0.1302564175, 1.1408047366, -0.0105483191],
                [-0.0240033568, -0.1289689761, 1.1529723329],
            ],
        );
    }

    #[test]
    fn rec_709_with_few_digits_is_left_alone() {
        let mut rounded = REC_709;
        rounded[3] = [0.31271, 0.32902];
        assert_eq!(matrix(rounded), Ok(None));
        assert_eq!(matrix(REC_709), Ok(None));
    }

    #[test]
    fn primaries_that_span_no_colours_are_refused() {
        let mut flat = REC_709;
        flat[2] = flat[1];
        let mut dark = REC_709;
        dark[3] = [0.3, 0.0];
        for primaries in [flat, dark, [[0.0; 2]; 4], [[f32::NAN; 2]; 4]] {
            let reason = matrix(primaries).unwrap_err();
            assert!(reason.contains("no primaries of colours"), "{reason}");
        }
    }
}
