//! Error maps of a finished case: those in errors.exr, and others, which are measured again.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use frame::{ExrFile, Picture, Plane, read_exr};
use metrics::{ErrorMap, Measurement, Reference};

use super::case::Case;
use crate::Error;

/// Maps in errors.exr: those that people look at, and the probes' maps, which only the filter itself could make again.
pub const KEPT_MAPS: [ErrorMap; 6] = [
    ErrorMap::Flip,
    ErrorMap::LabelTotalVariation,
    ErrorMap::Bleed,
    ErrorMap::Unity,
    ErrorMap::GatherOffset,
    ErrorMap::GatherSpread,
];

/// The error maps of one case.
pub struct ErrorMaps<'a> {
    case: &'a Case,
    /// Folder of run.json.
    folder: PathBuf,
    /// errors.exr.
    file: ExrFile,
    /// Measurement of maps that the file lacks, made once for all of them.
    again: OnceCell<Measurement>,
}

impl<'a> ErrorMaps<'a> {
    /// Reads the maps of a case below `folder`, which is run.json's.
    pub fn read(case: &'a Case, folder: &Path) -> Result<Self, Error> {
        Ok(Self {
            file: read_exr(&folder.join(&case.folder).join("errors.exr"))?,
            case,
            folder: folder.to_owned(),
            again: OnceCell::new(),
        })
    }

    /// Returns pixels per row and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.file.width, self.file.height)
    }

    /// Returns a map by its name. A map that errors.exr lacks is measured again, from output.exr, the frame and the truth.
    pub fn map(&self, name: &str) -> Result<Plane, Error> {
        let map = ErrorMap::ALL.into_iter().find(|map| map.name() == name);
        let is_held = (self.file.channels.iter()).any(|channel| channel.name == name);
        match map {
            Some(map) if !is_held && !KEPT_MAPS.contains(&map) => {
                let measurement = match self.again.get() {
                    Some(measurement) => measurement,
                    None => {
                        let measured = self.measure_again()?;
                        self.again.get_or_init(|| measured)
                    }
                };
                let plane = measurement.map(map);
                Ok(plane.expect("probes have maps of their own").clone())
            }
            _ => Ok(self.file.plane(name)?),
        }
    }

    fn measure_again(&self) -> Result<Measurement, Error> {
        let Self { case, folder, .. } = self;
        let (frame, truth) = case.read_frame_and_truth(folder)?;
        let mut output = read_exr(&folder.join(&case.folder).join("output.exr"))?;
        let picture = Picture::take_from(&mut output, "", &truth.objects)?;
        let reference = Reference::new(&frame, &truth, None, &frame.display.into())?;
        Ok(reference.measure(&picture)?)
    }
}
