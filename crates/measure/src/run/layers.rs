//! A case as one multi-layer OpenEXR file, for programs that group channels by layer.

use std::path::{Path, PathBuf};

use frame::{ExrFile, Frame, Size, Truth, read_exr, write_exr};
use metrics::ErrorMap;
use tracer::{Progress, TraceError, Watch};

use super::Run;
use super::case::Case;
use super::error_maps::ErrorMaps;
use crate::Error;

/// Error maps that become layers.
const MAPS: [ErrorMap; 3] = [
    ErrorMap::Flip,
    ErrorMap::LabelTotalVariation,
    ErrorMap::Bleed,
];

/// Writes one file per case below `out`, named like the case's folder below `folder`, which is
/// run.json's; returns their paths. Reports every case to `watch`.
pub fn write_layers(
    run: &Run,
    folder: &Path,
    out: &Path,
    watch: Watch,
) -> Result<Vec<PathBuf>, Error> {
    let mut written = Vec::new();
    let mut last: Option<(&Case, (Frame, Truth))> = None;
    for (done, case) in run.cases.iter().enumerate() {
        let progress = Progress {
            done: done as u64,
            total: run.cases.len() as u64,
        };
        if watch(progress).is_break() {
            return Err(TraceError::Cancelled.into());
        }
        // Cases of one scene and alignment follow one another.
        let truth = |case: &Case| (case.scene.clone(), case.alignment);
        let inputs = match last.take() {
            Some((other, inputs)) if truth(other) == truth(case) => inputs,
            _ => case.read_frame_and_truth(folder)?,
        };
        let path = out.join(format!("{}.exr", case.folder.display()));
        write_exr(&path, &collect_layers(run, case, &inputs, folder)?)?;
        written.push(path);
        last = Some((case, inputs));
    }
    Ok(written)
}

fn collect_layers(
    run: &Run,
    case: &Case,
    (frame, truth): &(Frame, Truth),
    folder: &Path,
) -> Result<ExrFile, Error> {
    let case_folder = folder.join(&case.folder);
    let output = read_exr(&case_folder.join("output.exr"))?;
    let errors = ErrorMaps::read(case, folder)?;
    let sizes = [
        ("frame.exr", frame.size()),
        ("output.exr", output.size()),
        ("errors.exr", errors.size()),
    ];
    if let Some((name, size)) = sizes.iter().find(|(_, size)| *size != truth.size()) {
        return Err(Error::Refused(format!(
            "{}: {name} has {size} pixels, the truth {}; run the case again",
            case_folder.display(),
            truth.size()
        )));
    }
    let mean = truth.mean();
    let Size { width, height } = truth.size();
    let mut file = ExrFile::new(width, height);
    file.push_color("truth", &mean.color);
    let color = output.color("")?;
    file.push_color("output", &color);
    file.push_color("instant", &frame.color);
    let signed = color.zip(&mean.color, |output, truth| {
        std::array::from_fn(|c| output[c] - truth[c])
    });
    file.push_color("signed", &signed);
    errors.add_flip(&mean.color, &color, frame.display);
    for map in MAPS {
        file.push_plane(map.name(), &errors.map(map.name())?);
    }
    file.push_vectors("velocity", &frame.velocity);
    file.push_plane("depth.Z", &frame.depth);
    for (object, plane) in truth.objects.iter().zip(&mean.coverage) {
        file.push_plane(&format!("coverage.{object}"), plane);
    }
    for object in &truth.objects {
        let matte = output.plane(&format!("coverage.{object}"))?;
        file.push_plane(&format!("output_coverage.{object}"), &matte);
    }
    file.set("kind", "layers");
    file.set("program", &run.program);
    file.set("scene", &case.scene);
    file.set("filter", case.name());
    file.set("alignment", case.alignment);
    file.set("exposure", case.exposure);
    file.set("truth_hash", &case.truth_hash);
    Ok(file)
}
