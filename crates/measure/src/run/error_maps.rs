//! Error maps of a finished case: those in errors.exr, and others, which are measured again.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use frame::{Display, ExrFile, Frame, Image, Picture, Plane, Size, Truth, read_exr};
use half::f16;
use metrics::{ErrorMap, Measurement, Reference, flip_ldr};

use super::case::Case;
use crate::Error;

/// Maps in errors.exr: those of mattes, and the probes' maps, which only the filter itself could
/// make again.
pub const KEPT_MAPS: [ErrorMap; 5] = [
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
    /// FLIP, which is quicker to make again alone.
    flip: OnceCell<Plane>,
}

impl<'a> ErrorMaps<'a> {
    /// Reads the maps of a case below `folder`, which is run.json's.
    pub fn read(case: &'a Case, folder: &Path) -> Result<Self, Error> {
        Ok(Self {
            file: read_exr(&folder.join(&case.folder).join("errors.exr"))?,
            case,
            folder: folder.to_owned(),
            again: OnceCell::new(),
            flip: OnceCell::new(),
        })
    }

    /// Returns the size of the maps.
    pub fn size(&self) -> Size {
        self.file.size()
    }

    /// Makes the map of FLIP from the picture and its truth, as halves like those of the file.
    pub fn add_flip(&self, truth: &Image, output: &Image, display: Display) {
        let short = |error: &f32| f16::from_f32(*error).to_f32();
        let make = || flip_ldr(truth, output, &display.into()).map(short);
        self.flip.get_or_init(make);
    }

    /// Returns a map by its name. A map that errors.exr lacks is measured again, from output.exr,
    /// the frame and the truth.
    pub fn map(&self, name: &str) -> Result<Plane, Error> {
        let map = ErrorMap::ALL.into_iter().find(|map| map.name() == name);
        let is_held = (self.file.channels.iter()).any(|channel| channel.name == name);
        match map {
            Some(ErrorMap::Flip) if !is_held => {
                if self.flip.get().is_none() {
                    let (frame, truth, output) = self.read_pictures()?;
                    self.add_flip(&truth.mean().color, &output.color, frame.display);
                }
                Ok(self.flip.get().expect("it was made").clone())
            }
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

    fn read_pictures(&self) -> Result<(Frame, Truth, Picture), Error> {
        let Self { case, folder, .. } = self;
        let (frame, truth) = case.read_frame_and_truth(folder)?;
        let mut output = read_exr(&folder.join(&case.folder).join("output.exr"))?;
        let picture = Picture::take_from(&mut output, "", &truth.objects)?;
        Ok((frame, truth, picture))
    }

    fn measure_again(&self) -> Result<Measurement, Error> {
        let (frame, truth, picture) = self.read_pictures()?;
        let reference = Reference::new(&frame, &truth, None, &frame.display.into())?;
        Ok(reference.measure(&picture)?)
    }
}
