//! Picture files of a run: OpenEXR for programs, PNG for people.

use std::path::Path;

use crate::{LADDER, RenderFile};
use frame::{
    Alignment, Display, ExrFile, FileError, Frame, Image, Picture, Truth, Vectors, display_srgb,
    write_half_exr, write_png, write_small_exr,
};
use metrics::Measurement;
use rayon::prelude::*;

use crate::colors::{magma, velocity_wheel};
use crate::run::error_maps::KEPT_MAPS;

/// Files of a frame, in the folder of its scene.
pub const FRAME_FILES: [&str; 3] = ["frame.exr", "frame.png", "velocity.png"];
/// Files of a case, in its folder.
pub const CASE_FILES: [&str; 6] = [
    "output.png",
    "flip.png",
    "label_tv.png",
    "bleed.png",
    "output.exr",
    "errors.exr",
];

/// File with a filter's colours for parts of the frame's replicates, in the folder of a case of a
/// sequence with intervals.
pub(crate) const PARTS_FILE: &str = "output_parts.exr";

/// Names the layer of a part in [`PARTS_FILE`].
pub(crate) fn part_layer(index: usize) -> String {
    format!("part_{index}")
}

/// Writes [`PARTS_FILE`].
pub(crate) fn write_parts(folder: &Path, parts: &[Picture]) -> Result<(), FileError> {
    let Some(first) = parts.first() else {
        return Ok(());
    };
    let mut file = ExrFile::new(first.color.width, first.color.height);
    for (index, part) in parts.iter().enumerate() {
        file.push_color(&part_layer(index), &part.color);
    }
    file.set("kind", "output parts");
    write_small_exr(&folder.join(PARTS_FILE), file)
}

/// Names the picture of a truth and its file, in the folder of its scene.
pub fn truth_files(alignment: Alignment) -> [String; 2] {
    let file = RenderFile::Truth(alignment);
    [file.picture(), file.to_string()]
}

/// Writes a frame's PNGs next to its EXR file; returns the names of all.
pub fn write_frame(folder: &Path, frame: &Frame) -> Result<Vec<String>, FileError> {
    write_display_png(&folder.join("frame.png"), &frame.color, frame.display)?;
    write_png(&folder.join("velocity.png"), &velocity_wheel(frame))?;
    Ok(FRAME_FILES.map(str::to_owned).into())
}

/// Writes a truth's PNG next to its EXR file and its ladder's, if any; returns the names of all.
pub fn write_truth(
    folder: &Path,
    truth: &Truth,
    display: Display,
) -> Result<Vec<String>, FileError> {
    let alignment = truth.alignment;
    let files = truth_files(alignment);
    write_display_png(&folder.join(&files[0]), &truth.mean().color, display)?;
    let mut files = Vec::from(files);
    let rungs = LADDER.map(|rung| RenderFile::Rung(alignment, rung).to_string());
    files.extend(rungs.into_iter().filter(|rung| folder.join(rung).exists()));
    Ok(files)
}

/// Writes a case: the output, the dilated velocity if the filter has one, and the error maps;
/// returns the files' names.
pub fn write_case(
    folder: &Path,
    frame: &Frame,
    output: &Picture,
    dilated_velocity: Option<&Vectors>,
    measurement: &Measurement,
) -> Result<Vec<String>, FileError> {
    let maps = &measurement.maps;
    let [output_png, flip, label_tv, bleed, output_exr, errors] =
        CASE_FILES.map(|name| folder.join(name));
    let file = || output_file(&frame.objects, output, dilated_velocity);
    let writes: [&(dyn Fn() -> Result<(), FileError> + Sync); CASE_FILES.len()] = [
        &|| write_small_exr(&output_exr, file()),
        &|| write_half_exr(&errors, errors_file(measurement)),
        &|| write_display_png(&output_png, &output.color, frame.display),
        &|| write_png(&flip, &magma(&maps.flip)),
        &|| write_png(&label_tv, &magma(&maps.label_total_variation)),
        &|| write_png(&bleed, &magma(&maps.bleed)),
    ];
    writes.par_iter().try_for_each(|write| write())?;
    Ok(CASE_FILES.map(str::to_owned).into())
}

fn output_file(
    objects: &[String],
    output: &Picture,
    dilated_velocity: Option<&Vectors>,
) -> ExrFile {
    let mut file = ExrFile::new(output.color.width, output.color.height);
    output.push(&mut file, "", objects);
    if let Some(velocity) = dilated_velocity {
        for (axis, name) in ["dilated.X", "dilated.Y"].into_iter().enumerate() {
            file.push_plane(name, &velocity.map(|motion| motion[axis]));
        }
    }
    file.set("kind", "output");
    file
}

fn errors_file(measurement: &Measurement) -> ExrFile {
    let maps = &measurement.maps;
    let mut file = ExrFile::new(maps.flip.width, maps.flip.height);
    for map in KEPT_MAPS {
        if let Some(plane) = measurement.map(map) {
            file.push_plane(map.name(), plane);
        }
    }
    file.set("kind", "errors");
    file
}

fn write_display_png(path: &Path, image: &Image, display: Display) -> Result<(), FileError> {
    write_png(path, &display_srgb(image, display.stops))
}
