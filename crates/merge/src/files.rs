//! Pictures of folded runs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use frame::{Alignment, read_attribute};
use measure::{
    CASE_FILES, Error, FRAME_FILES, RenderFile, RenderPath, Run, StoredRun, list_files, truth_files,
};

use crate::gather::{Files, gather};

/// Pictures that a run names, of a case or of one frame of a sequence.
struct Pictures<'a> {
    /// Folder of the scene.
    scene: PathBuf,
    /// Folder of the case.
    case: &'a Path,
    alignment: Alignment,
    truth_hash: &'a str,
}

/// Gathers the files of all cases and their scenes. A file in two parts must be the same in both,
/// and every picture must be in some part. Follows no links.
pub fn gather_files(parts: &[StoredRun]) -> Result<Files, Error> {
    let lists = parts.iter().map(|part| {
        let pictures = list_pictures(&part.run)
            .flat_map(|pictures| [pictures.scene, pictures.case.to_owned()]);
        let folders: BTreeSet<PathBuf> = pictures.collect();
        let mut files = list_files(part.folder())?;
        files.retain(|file| {
            let scene = RenderPath::parse(file).map(|render| render.scene.folder());
            let folder = scene.as_deref().or(file.parent());
            folder.is_some_and(|folder| folders.contains(folder))
        });
        Ok((part.folder(), files))
    });
    let files = gather(lists.collect::<Result<Vec<_>, Error>>()?)?;
    for part in parts {
        list_pictures(&part.run)
            .try_for_each(|pictures| check_pictures(part, &pictures, &files))?;
    }
    Ok(files)
}

/// Lists the pictures of a run's cases, and of all frames of its sequences.
fn list_pictures(run: &Run) -> impl Iterator<Item = Pictures<'_>> {
    let cases = run.cases.iter().map(|case| Pictures {
        scene: case.scene.folder(),
        case: &case.folder,
        alignment: case.alignment,
        truth_hash: &case.truth_hash,
    });
    let frames = run.sequences.iter().flat_map(|sequence| {
        sequence.frames.iter().map(|frame| Pictures {
            scene: frame.scene.clone(),
            case: &frame.folder,
            alignment: sequence.alignment,
            truth_hash: &frame.truth_hash,
        })
    });
    cases.chain(frames)
}

/// Refuses a case if no part has its pictures or its scene's, or if it was measured against another
/// truth.
fn check_pictures(part: &StoredRun, pictures: &Pictures, files: &Files) -> Result<(), Error> {
    let of_case = CASE_FILES.iter().map(|name| pictures.case.join(name));
    let of_frame = FRAME_FILES.iter().map(|name| pictures.scene.join(name));
    let of_truth = truth_files(pictures.alignment).map(|name| pictures.scene.join(name));
    let mut all = of_case.chain(of_frame).chain(of_truth);
    if let Some(missing) = all.find(|below| !files.contains_key(below)) {
        return Err(Error::Refused(format!(
            "{}: no part holds {}, or it is a link; copy the folders of runs as a whole, or measure that case again",
            part.path.display(),
            missing.display()
        )));
    }
    let truth = &files[&pictures
        .scene
        .join(RenderFile::Truth(pictures.alignment).path())];
    let hash = read_attribute(truth, "content_hash").unwrap_or_default();
    if hash == pictures.truth_hash {
        Ok(())
    } else {
        Err(Error::Refused(format!(
            "{}: the truth of {} has the hash {}, and {} has {hash}; measure that case again",
            part.path.display(),
            pictures.case.display(),
            pictures.truth_hash,
            truth.display()
        )))
    }
}
