//! Error maps of a finished case: those that errors.exr holds, and others, which are measured again.

use std::path::Path;

use frame::{ExrFile, Frame, Picture, Plane, Truth, read_exr};
use metrics::{ErrorMap, Reference};

use super::case::Case;
use crate::Error;

/// Maps that errors.exr holds: those that people look at, and those of probes, which only the filter itself could make again.
pub const KEPT_MAPS: [ErrorMap; 6] = [
    ErrorMap::Flip,
    ErrorMap::LabelTotalVariation,
    ErrorMap::Bleed,
    ErrorMap::Unity,
    ErrorMap::GatherOffset,
    ErrorMap::GatherSpread,
];

/// Reads a map, by its name, of a case below `folder`, that of run.json; `errors` is the case's errors.exr. Measures one that the
/// file does not hold again, from output.exr, the frame and the truth.
pub fn read_error_map(
    case: &Case,
    folder: &Path,
    errors: &ExrFile,
    name: &str,
) -> Result<Plane, Error> {
    let map = ErrorMap::ALL.into_iter().find(|map| map.name() == name);
    let is_held = errors.channels.iter().any(|channel| channel.name == name);
    match map {
        Some(map) if !is_held && !KEPT_MAPS.contains(&map) => measure_again(case, folder, map),
        _ => Ok(errors.plane(name)?),
    }
}

fn measure_again(case: &Case, folder: &Path, map: ErrorMap) -> Result<Plane, Error> {
    let scene = folder.join(&case.scene);
    let frame = Frame::read(&scene.join("frame.exr"))?.cropped();
    let truth = Truth::read(&scene.join(format!("truth_{}.exr", case.alignment)))?;
    let output = read_exr(&folder.join(&case.folder).join("output.exr"))?;
    let mattes = truth.objects.iter();
    let picture = Picture {
        color: output.color("")?,
        coverage: mattes
            .map(|object| output.plane(&format!("coverage.{object}")))
            .collect::<Result<_, _>>()?,
    };
    let reference = Reference::new(&frame, &truth, None, &frame.display.into())?;
    let measurement = reference.measure(&picture)?;
    let plane = measurement.map(map);
    Ok(plane.expect("probes have maps of their own").clone())
}
