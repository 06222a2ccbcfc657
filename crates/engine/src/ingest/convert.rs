//! Conversion of a capture to this program's files.

use std::path::Path;

use filters::EXCLUSION;
use frame::{
    Display, ExrFile, FAR_DEPTH, Frame, FrameOptions, Image, Provenance, Raster, Reprojection,
    Truth, VelocityKind, display_srgb, read_bounded, write_exr, write_png,
};
use measure::{
    BLURRED, EXCLUSION_FILE, Error, INGESTED_FORMAT, IngestedScene, MAX_TAKEN_BYTES, PROGRAM,
    RenderFile, Sharing, engine_name, ladder_folder, lock_folder, mark_reached, name_in_one_word,
    refuse_long_names, refuse_scene, velocity_wheel,
};
use scene::SceneId;
use tracer::Watch;

use crate::capture::folder::Capture;
use crate::ingest::engine_truth::{EngineTruth, NOT_TRACED, average_subframes, part_of};
use crate::ingest::moving::usual_top_speed;
use crate::ingest::objects::{draw_coverage, name_objects};
use crate::statistics::median;

/// An ingested capture.
pub struct Ingested {
    /// The scene, as its record describes it.
    pub scene: IngestedScene,
    /// The truth; none if the capture has no sub-frames.
    pub truth: Option<Truth>,
    /// Part of the pixels where anything moves, by colour or velocity; none without a truth.
    pub moving: Option<f64>,
    /// Part of the pixels that change between sub-frames although no velocity reaches them: by
    /// noise, shadows, or wrong velocity. None without a truth or velocity.
    pub restless: Option<f64>,
    /// Radiance of the engine's blurred picture relative to the truth, or to the frame without a
    /// truth: the median over pixels that no velocity reaches. 1 for a blur that neither adds nor
    /// removes light; none without a picture, or if no lit pixel is still.
    pub gain: Option<f64>,
}

/// A capture to ingest, and what it does not say.
pub struct IngestPlan<'a> {
    /// The capture.
    pub capture: &'a Capture,
    /// Exposures at which the pictures are shown and compared.
    pub display: Display,
    /// Object names of the scene that the engine drew; none if there is no such scene.
    pub names: Option<Vec<String>>,
    /// Folder to write, which names the scene.
    pub out: &'a Path,
}

/// Writes the frame of a capture, the truth of its sub-frames and the engine's own blurred picture.
pub fn ingest(plan: IngestPlan, watch: Watch) -> Result<Ingested, Error> {
    let IngestPlan {
        capture,
        display,
        names,
        out,
    } = plan;
    refuse_scene(out)?;
    refuse_other_files(out)?;
    capture.check_subframes()?;
    let objects = name_objects(capture, names)?;
    let hash = hash_capture(capture, display, &objects)?;
    let mut scene = describe_scene(capture, hash, out)?;
    let provenance = Provenance {
        scene: scene.id.to_string(),
        program: PROGRAM.to_owned(),
        seed: 0,
        samples_per_pixel: 1,
        replicates: 1,
        traversal: NOT_TRACED.to_owned(),
        content_hash: scene.hash.clone(),
        engine: Some(scene.engine.clone()),
    };
    let (exposure, alignment) = capture.shutter()?;
    let shutter = alignment.shutter(exposure);
    let shutter = shutter.expect("the exposure was checked when it was read");
    let averaged = average_subframes(capture, shutter, alignment, &objects, &provenance, watch)?;
    let frame = make_frame(capture, &scene, display, objects, provenance);
    if let Some(averaged) = &averaged {
        let rungs = averaged.ladder.rungs.iter();
        scene.ladder = rungs.map(|rung| rung.subframes).collect();
    }
    let restless = averaged.as_ref().map(|averaged| averaged.restless);
    let restless = restless.filter(|_| !scene.lacks_velocity());
    let truth = write_files(capture, &scene, &frame, averaged, out)?;
    let unblurred = (truth.as_ref()).map_or(frame.color, |truth| truth.mean().color);
    // Noise changes colours where nothing moves, but not velocity.
    let reached = match &truth {
        Some(truth) if scene.lacks_velocity() => truth.support.moving.clone(),
        _ => mark_reached(&capture.velocity, shutter),
    };
    let blurred = capture.blurred.as_ref();
    let moving = truth.as_ref().map(|truth| part_of(&truth.support.moving));
    Ok(Ingested {
        gain: blurred.and_then(|picture| median_ratio(picture, &unblurred, &reached)),
        scene,
        truth,
        moving,
        restless,
    })
}

/// Writes all files of an ingested capture, and pictures of them for people; returns the truth.
fn write_files(
    capture: &Capture,
    scene: &IngestedScene,
    frame: &Frame,
    averaged: Option<EngineTruth>,
    out: &Path,
) -> Result<Option<Truth>, Error> {
    let _lock = lock_folder(out, [], Sharing::Alone)?;
    let stops = frame.display.stops;
    let show = |name: &str, image: &Image| write_png(&out.join(name), &display_srgb(image, stops));
    let mut files = vec![RenderFile::Frame.to_string()];
    frame.write(&out.join(RenderFile::Frame.path()))?;
    show(&RenderFile::Frame.picture(), &frame.color)?;
    write_png(&out.join("velocity.png"), &velocity_wheel(frame))?;
    if let Some(picture) = &capture.blurred {
        write_picture(&out.join(BLURRED), picture, scene, &frame.provenance)?;
        files.push(BLURRED.to_owned());
        show("blurred.png", picture)?;
    }
    if let Some(mask) = &capture.exclusion {
        let mut file = ExrFile::new(mask.width, mask.height);
        file.push_plane(EXCLUSION, mask);
        write_exr(&out.join(EXCLUSION_FILE), &file)?;
        files.push(EXCLUSION_FILE.to_owned());
    }
    let mut written = None;
    if let Some(EngineTruth { truth, ladder, .. }) = averaged {
        let alignment = truth.alignment;
        ladder.write_rungs(&out.join(ladder_folder(alignment)))?;
        let rungs = scene.ladder.iter();
        files.extend(rungs.map(|rung| RenderFile::Rung(alignment, *rung).to_string()));
        let file = RenderFile::Truth(alignment);
        truth.write(&out.join(file.path()))?;
        files.push(file.to_string());
        show(&file.picture(), &truth.mean().color)?;
        written = Some(truth);
    }
    scene.write(&files)?;
    Ok(written)
}

/// Returns the median ratio of two pictures' radiance over the pixels that are not left out; none
/// where the second one is black.
fn median_ratio(picture: &Image, other: &Image, left_out: &Raster<bool>) -> Option<f64> {
    let radiance = |pixel: &[f32; 3]| pixel.iter().map(|value| f64::from(*value)).sum::<f64>();
    let pairs = picture.pixels.iter().zip(&other.pixels);
    let ratios = (pairs.zip(&left_out.pixels))
        .filter(|((_, other), left_out)| !**left_out && radiance(other) > 0.0)
        .map(|((pixel, other), _)| radiance(pixel) / radiance(other));
    Some(median(ratios)).filter(|ratio| ratio.is_finite())
}

/// Refuses a folder with another frame, such as a run's folder of a scene.
fn refuse_other_files(out: &Path) -> Result<(), Error> {
    if out.join(RenderFile::Frame.path()).exists() && !IngestedScene::is_in(out) {
        Err(Error::Refused(format!(
            "{}: holds a frame that was not ingested, which would be overwritten; name a new folder",
            out.display()
        )))
    } else {
        Ok(())
    }
}

/// Describes the ingested capture, except its ladder.
fn describe_scene(capture: &Capture, hash: String, out: &Path) -> Result<IngestedScene, Error> {
    let (exposure, alignment) = capture.shutter()?;
    let subframes = capture.subframes.len() as u32;
    let length = usual_top_speed(&capture.velocity) * exposure;
    Ok(IngestedScene {
        format: INGESTED_FORMAT,
        program: PROGRAM.to_owned(),
        id: name_scene(capture, out)?,
        engine: capture.description.engine.clone(),
        scene: capture.description.scene.clone(),
        size: capture.color.size(),
        exposure,
        alignment,
        subframes,
        step: length / f64::from(subframes.max(1)),
        ladder: Vec::new(),
        has_picture: capture.blurred.is_some(),
        lacks: capture
            .lacks
            .iter()
            .map(|name| (*name).to_owned())
            .collect(),
        further_inputs: [
            ("velocity_next", capture.velocity_next.is_some()),
            ("velocity_z", capture.velocity_z.is_some()),
            (EXCLUSION, capture.exclusion.is_some()),
        ]
        .into_iter()
        .filter(|(_, is_there)| *is_there)
        .map(|(name, _)| name.to_owned())
        .collect(),
        hash,
        folder: out.to_owned(),
    })
}

/// Names the scene by the folder, with the engine as its variant.
fn name_scene(capture: &Capture, out: &Path) -> Result<SceneId, Error> {
    let folder = out.file_name().and_then(|name| name.to_str());
    let is_plain = |name: &&str| !name.contains('@') && name_in_one_word(name) == **name;
    match folder.filter(is_plain) {
        Some(folder) => {
            let engine = name_in_one_word(engine_name(&capture.description.engine));
            let id = SceneId::new(folder, Some(&engine));
            refuse_long_names(&id.folder())?;
            Ok(id)
        }
        None => Err(Error::Refused(format!(
            "{}: its last part names the scene; allowed: letters, digits and . _ - +, such as out/engine/railing",
            out.display()
        ))),
    }
}

fn make_frame(
    capture: &Capture,
    scene: &IngestedScene,
    display: Display,
    objects: Vec<String>,
    provenance: Provenance,
) -> Frame {
    let (width, height) = (capture.color.width, capture.color.height);
    let sky = capture.depth.pixels.iter().zip(&capture.velocity.pixels);
    let mut moving_sky = sky.filter(|(depth, _)| **depth >= FAR_DEPTH);
    Frame {
        provenance,
        exposure: scene.exposure,
        frames_per_second: None,
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            sky_velocity: moving_sky.any(|(_, velocity)| *velocity != [0.0, 0.0]),
            ..FrameOptions::default()
        },
        guard_band: 0,
        reprojection: Reprojection::STILL,
        camera: None,
        display,
        coverage: draw_coverage(
            capture.object_id.as_ref(),
            capture.color.size(),
            objects.len(),
        ),
        object_id: match (&capture.object_id, objects.len()) {
            (Some(ids), 2..) => ids.clone(),
            _ => Raster::filled(width, height, 0),
        },
        objects,
        color: capture.color.clone(),
        velocity: capture.velocity.clone(),
        velocity_next: capture.velocity_next.clone(),
        velocity_z: capture.velocity_z.clone(),
        depth: capture.depth.clone(),
        samples: None,
    }
}

fn write_picture(
    path: &Path,
    picture: &Image,
    scene: &IngestedScene,
    provenance: &Provenance,
) -> Result<(), Error> {
    let mut file = ExrFile::new(picture.width, picture.height);
    file.push_color("", picture);
    file.set("kind", "output");
    file.set("exposure", scene.exposure);
    file.set("alignment", scene.alignment);
    provenance.set(&mut file);
    Ok(write_exr(path, &file)?)
}

/// Hashes all that determines the files: the pictures' source files, how they are read, and what
/// the scene that the engine drew adds.
fn hash_capture(capture: &Capture, display: Display, objects: &[String]) -> Result<String, Error> {
    let mut hasher = blake3::Hasher::new();
    let how = format!(
        "{PROGRAM}\n{:?}\n{:?}\n{display:?}\n{objects:?}",
        capture.description, capture.convention
    );
    hasher.update(how.as_bytes());
    let colors = |image: &Image| image.pixels.clone().into_iter().flatten();
    let ids = capture.object_id.iter().flat_map(|ids| &ids.pixels);
    let next = capture.velocity_next.iter().flat_map(|next| &next.pixels);
    let z = capture.velocity_z.iter().flat_map(|z| &z.pixels);
    let mask = capture.exclusion.iter().flat_map(|mask| &mask.pixels);
    let values = colors(&capture.color)
        .chain(capture.velocity.pixels.iter().flatten().copied())
        .chain(next.flatten().chain(z).chain(mask).copied())
        .chain(capture.depth.pixels.iter().copied())
        .chain(ids.map(|id| *id as f32))
        .chain(capture.blurred.iter().flat_map(colors));
    for value in values {
        hasher.update(&value.to_le_bytes());
    }
    for path in &capture.subframes {
        hasher.update(&read_bounded(path, MAX_TAKEN_BYTES)?);
    }
    Ok(hasher.finalize().to_hex().to_string())
}
