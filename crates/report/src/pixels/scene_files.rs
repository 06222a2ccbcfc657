//! Files of one scene in a run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{
    Alignment, ExrFile, Frame, Image, Picture, Plane, Regions, Size, Truth, read_exr, regions,
};
use measure::{
    Case, Error, ErrorMaps, FilterFrame, ReferencePicture, RenderFile, Run, read_exclusion,
    read_further_velocities,
};
use metrics::{Side, mark_shared, object_sides};

use super::layer::Layer;
use super::planes::Planes;
use super::png::{embed_picture, thumbnail};

/// Pictures with the numbers of their planes.
pub type Layers = Vec<(Layer, Vec<usize>)>;

/// The frame of a scene, its truths, and the planes of all its pictures.
pub struct SceneFiles {
    /// Without its guard band.
    pub frame: Frame,
    /// With it, and with all velocities and the mask that filters got, but without coverage.
    pub whole: FilterFrame,
    /// Truths by alignment.
    pub truths: BTreeMap<Alignment, TruthFile>,
    /// The planes of all its cases.
    pub planes: Planes,
    /// Accumulation in every profile, with its title, by alignment.
    pub accumulations: BTreeMap<Alignment, (String, Image)>,
    /// Plane of the object visible at each pixel's centre.
    pub objects: usize,
    /// Folder of the run.
    folder: PathBuf,
    /// Folder of the same scene as rendered, if an engine drew this one.
    traced: Option<PathBuf>,
    /// Pictures that every case of the scene shows.
    shared: Layers,
}

/// One truth.
pub struct TruthFile {
    /// Mean of all replicates.
    pub mean: Picture,
    /// Offset from each pixel to its surface's position at the instant, in pixels: mean over the
    /// shutter.
    pub offset: frame::Vectors,
    /// Regions that scores are pooled over.
    pub regions: Regions,
    /// Root of the truth's own noise in each pixel, which is a part of the squared error against
    /// `mean`, in units of radiance. Negative where the frame has the same noise: a filter that
    /// leaves such a pixel alone hands it on, and it is no part of the error there.
    pub noise: Plane,
    /// Sides of each moving object's bleed, with the object's index.
    sides: Vec<(usize, frame::Raster<Side>)>,
    /// Truth and knowability.
    layers: Layers,
}

impl TruthFile {
    /// Returns the planes of its red, green and blue.
    pub fn color_planes(&self) -> Vec<usize> {
        self.layers[0].1.clone()
    }
}

/// Files of one case in a run.
pub struct CaseFiles<'a> {
    pub output: Image,
    pub errors: ErrorMaps<'a>,
    pub layers: Layers,
}

impl SceneFiles {
    /// Reads the frame of a scene and the accumulations of its profiles; `cases` are all of the
    /// scene, `folder` is the run's.
    pub fn read(run: &Run, cases: &[&Case], folder: &Path) -> Result<Self, Error> {
        let path = cases[0].render_path(folder, RenderFile::Frame);
        let mut whole = Frame::read(&path)?;
        let frame = whole.cropped();
        whole.coverage.clear();
        let frame_folder = path.parent().unwrap_or(folder);
        read_further_velocities(&mut whole, frame_folder)?;
        let exclusion = read_exclusion(&whole, frame_folder)?;
        check_size(&path, frame.size(), run.render.size())?;
        let mut accumulations = BTreeMap::new();
        for case in cases.iter().filter(|case| is_in_profiles(case)) {
            let path = folder.join(&case.folder).join("output.exr");
            let file = read_exr(&path)?;
            check_size(&path, file.size(), frame.size())?;
            let named = (format!("{} sub-frames", case.preset), file.color("")?);
            accumulations.insert(case.alignment, named);
        }
        let mut planes = Planes::default();
        let axes = [0, 1].map(|axis| frame.velocity.map(|motion| motion[axis]));
        let velocity = axes.map(|plane| planes.add(&plane));
        let depth = planes.add(&frame.depth);
        let ids = frame.object_id.map(|id| *id as f32);
        Ok(Self {
            shared: vec![
                (Layer::Instant, planes.add_image(&frame.color)),
                (Layer::Velocity, velocity.to_vec()),
                (Layer::Depth, vec![depth]),
            ],
            objects: planes.add(&ids),
            truths: BTreeMap::new(),
            accumulations,
            traced: find_traced(run, cases[0]).map(|case| folder.join(case.scene.folder())),
            folder: folder.to_owned(),
            frame,
            whole: FilterFrame {
                frame: whole,
                exclusion,
            },
            planes,
        })
    }

    /// Returns the planes of the frame's red, green and blue.
    pub fn color_planes(&self) -> &[usize] {
        &self.shared[0].1
    }

    /// Draws a small truth, of any alignment, as an address that embeds the picture.
    pub fn thumbnail(&self) -> String {
        let truth = self.truths.values().next();
        let image = truth.map_or(&self.frame.color, |truth| &truth.mean.color);
        embed_picture(&thumbnail(image, self.frame.display.stops))
    }

    /// Reads a case's truth.
    fn read_truth(&mut self, case: &Case) -> Result<TruthFile, Error> {
        let alignment = case.alignment;
        let path = case.render_path(&self.folder, RenderFile::Truth(alignment));
        let truth = Truth::read(&path)?;
        check_size(&path, truth.size(), self.frame.size())?;
        if truth.objects != self.frame.objects {
            return Err(Error::Refused(format!(
                "{}: its objects are {}, those of the scene's frame {}; run the scene again",
                path.display(),
                truth.objects.join(", "),
                self.frame.objects.join(", ")
            )));
        }
        let mean = truth.mean();
        let at_instant = truth.at_instant_mean();
        let placed = &at_instant.placed;
        let objects = 1..truth.objects.len();
        let regions = regions(&truth);
        let mut layers = vec![(Layer::Truth, self.planes.add_image(&mean.color))];
        match &truth.provenance.engine {
            None => {
                let unknowable = self.planes.add(&at_instant.unknowable);
                layers.push((Layer::Knowability, vec![unknowable]));
            }
            Some(_) => layers.extend(self.read_traced_truth(alignment)?),
        }
        Ok(TruthFile {
            offset: at_instant.offset.zip(placed, |offset, placed| {
                offset.map(|sum| if *placed > 0.0 { sum / placed } else { 0.0 })
            }),
            noise: mark_noise(&truth, &self.frame.color, &mean.color, &regions),
            regions,
            sides: objects
                .filter_map(|id| Some((id, object_sides(&self.frame, &truth.support, id as u32)?)))
                .collect(),
            layers,
            mean,
        })
    }

    /// Reads the tracer's truth of a scene that an engine drew; none if the run has none.
    fn read_traced_truth(
        &mut self,
        alignment: Alignment,
    ) -> Result<Option<(Layer, Vec<usize>)>, Error> {
        let traced = self.traced.as_ref();
        let path = traced.map(|folder| folder.join(RenderFile::Truth(alignment).path()));
        let Some(path) = path.filter(|path| path.is_file()) else {
            return Ok(None);
        };
        let truth = Truth::read(&path)?;
        check_size(&path, truth.size(), self.frame.size())?;
        let planes = self.planes.add_image(&truth.mean().color);
        Ok(Some((Layer::TracedTruth, planes)))
    }

    /// Reads the files of a case.
    pub fn read_case<'c>(&mut self, case: &'c Case) -> Result<CaseFiles<'c>, Error> {
        let folder = self.folder.join(&case.folder);
        let file = read_exr(&folder.join("output.exr"))?;
        file.expect_finite()?;
        let errors = ErrorMaps::read(case, &self.folder)?;
        let output = file.color("")?;
        let (pixels, size) = (output.size(), self.frame.size());
        check_size(&folder.join("output.exr"), pixels, size)?;
        check_size(&folder.join("errors.exr"), errors.size(), size)?;
        if !self.truths.contains_key(&case.alignment) {
            let truth = self.read_truth(case)?;
            self.truths.insert(case.alignment, truth);
        }
        let truth = &self.truths[&case.alignment];
        errors.add_flip(&truth.mean.color, &output, self.frame.display);
        let bleeds = read_bleeds(&file, &self.frame.objects, truth)?;
        let colors = self.planes.add_image(&output);
        let truths = truth.color_planes();
        let mut layers = [self.shared.clone(), truth.layers.clone()].concat();
        layers.push((Layer::SignedError, [colors.clone(), truths].concat()));
        layers.push((Layer::Output, colors));
        let bleeds = bleeds.map(|plane| self.planes.add(&plane));
        let mut maps = vec![(Layer::Flip, "flip")];
        // If the objects in a pixel are unknown, nothing is wrong about them.
        if self.frame.objects.len() > 1 || case.drawn.is_none() {
            layers.push((Layer::Bleed, bleeds.to_vec()));
            maps.push((Layer::LabelTotalVariation, "label_tv"));
        }
        for (layer, name) in maps {
            layers.push((layer, vec![self.planes.add(&errors.map(name)?)]));
        }
        let mut channels = file.channels.iter();
        if channels.any(|channel| channel.name == "dilated.X") {
            let axes = [file.plane("dilated.X")?, file.plane("dilated.Y")?];
            let planes = axes.map(|plane| self.planes.add(&plane));
            layers.push((Layer::Dilated, planes.to_vec()));
        }
        layers.sort_by_key(|(layer, _)| *layer as usize);
        Ok(CaseFiles {
            output,
            errors,
            layers,
        })
    }
}

/// Computes the noise of a truth in each pixel: see [`TruthFile::noise`]. A report's score is the
/// product of the errors against both halves: the squared error against the mean of the halves,
/// less the square of half their difference.
fn mark_noise(truth: &Truth, frame: &Image, mean: &Image, regions: &Regions) -> Plane {
    let halves = truth.halves.each_ref().map(|half| &half.color);
    let noise = halves[0].zip(halves[1], |a, b| {
        let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
        (squares.sum::<f32>() / 12.0).sqrt()
    });
    let shared = mark_shared(frame, halves, mean, regions);
    noise.zip(
        &shared,
        |noise, shared| if *shared { -noise } else { *noise },
    )
}

/// Finds a case of the scene that an engine drew, rendered by the same run with the same exposure.
pub fn find_traced<'a>(run: &'a Run, case: &Case) -> Option<&'a Case> {
    let scene = case.drawn.as_ref()?.scene.as_ref()?;
    let mut cases = run.cases.iter();
    cases.find(|other| {
        other.drawn.is_none() && other.scene == *scene && other.exposure == case.exposure
    })
}

/// Refuses a file of another size than the run's pictures.
fn check_size(path: &Path, size: Size, expected: Size) -> Result<(), Error> {
    if size == expected {
        return Ok(());
    }
    Err(Error::Refused(format!(
        "{}: has {size} pixels, the run's pictures have {expected}; run it again",
        path.display()
    )))
}

/// Returns whether a case is the accumulation in every profile.
fn is_in_profiles(case: &Case) -> bool {
    case.reference() == Some(ReferencePicture::Accumulation(16))
}

/// Reads beside, ahead and behind: the sum over moving objects of their matte where the truth never
/// shows them.
fn read_bleeds(file: &ExrFile, objects: &[String], truth: &TruthFile) -> Result<[Plane; 3], Error> {
    let mut bleeds = [(); 3].map(|()| truth.regions.moving.map(|_| 0.0));
    let wanted = [Side::Lateral, Side::Leading, Side::Trailing];
    for (object, sides) in &truth.sides {
        let matte = file.plane(&format!("coverage.{}", objects[*object]))?;
        for (bleed, wanted) in bleeds.iter_mut().zip(wanted) {
            let share = |matte: &f32, side: &Side| if *side == wanted { *matte } else { 0.0 };
            *bleed = bleed.zip(&matte.zip(sides, share), |sum, share| sum + share);
        }
    }
    Ok(bleeds)
}
