//! Objects in an engine's pictures, by their ids.

use frame::{Plane, Raster, Size};
use measure::Error;

use crate::capture::folder::{Capture, SUBFRAMES};
use crate::files::refuse;

/// Name of what is no object.
const BACKGROUND: &str = "background";
/// Upper limit on objects: each needs memory in every picture.
const MAX_OBJECTS: usize = 64;

/// Names the objects by their ids: as in the scene that the engine drew, or by their numbers. Only
/// the background if the frame or its sub-frames have no ids: then nobody knows what the open
/// shutter saw.
pub fn name_objects(capture: &Capture, known: Option<Vec<String>>) -> Result<Vec<String>, Error> {
    let Some(ids) = &capture.object_id else {
        return Ok(vec![BACKGROUND.to_owned()]);
    };
    let mut largest = largest_id(ids);
    for index in 0..capture.subframes.len() {
        match capture.read_subframe_objects(index)? {
            Some(ids) => largest = largest.max(largest_id(&ids)),
            None if index == 0 => return Ok(vec![BACKGROUND.to_owned()]),
            None => {
                return refuse!(
                    capture.subframes[index],
                    "has no channel \"object\", which the sub-frames before it have; allowed: ids in all of them, or in none"
                );
            }
        }
    }
    let named = match known {
        Some(names) => names,
        None => (0..=largest.min(MAX_OBJECTS))
            .map(|id| match id {
                0 => BACKGROUND.to_owned(),
                id => format!("object_{id}"),
            })
            .collect(),
    };
    if largest < named.len() && named.len() <= MAX_OBJECTS + 1 {
        Ok(named)
    } else {
        refuse!(
            capture.folder,
            "object.exr and {SUBFRAMES} hold ids up to {largest}; allowed: up to {}, as the scene's manifest.json numbers its \
                 objects; draw these ids, or leave object.exr out",
            named.len().min(MAX_OBJECTS + 1) - 1
        )
    }
}

/// Draws, per object, 1 where a picture shows it and 0 elsewhere.
pub fn draw_coverage(
    ids: Option<&Raster<u32>>,
    Size { width, height }: Size,
    count: usize,
) -> Vec<Plane> {
    let Some(ids) = ids.filter(|_| count > 1) else {
        return vec![Plane::filled(width, height, 1.0)];
    };
    (0..count as u32)
        .map(|object| ids.map(|id| f32::from(*id == object)))
        .collect()
}

fn largest_id(ids: &Raster<u32>) -> usize {
    ids.pixels.iter().copied().max().unwrap_or(0) as usize
}
