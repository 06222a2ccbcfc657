//! The check of coordinates before trees are built.

use bvh::Aabb;
use scene::Scene;

use crate::error::TraceError;
use crate::limits::LARGEST_COORDINATE;

/// Refuses objects with too large coordinates: of their swept boxes, or of their meshes in their
/// own space.
pub(crate) fn check_coordinates(scene: &Scene, slices: &[Vec<Aabb>]) -> Result<(), TraceError> {
    let mesh_extents: Vec<f64> = (scene.meshes.iter())
        .map(|mesh| {
            let shapes = mesh.shapes.iter().flat_map(|shape| &shape.positions);
            let positions = mesh.positions.iter().chain(shapes);
            positions.fold(0.0, |largest: f64, position| {
                largest.max(f64::from(position.abs().max_element()))
            })
        })
        .collect();
    for (index, object) in scene.objects.iter().enumerate() {
        let swept = slices.iter().map(|swept| swept[index]);
        let corners = swept.flat_map(|swept| [swept.min, swept.max]);
        let mut coordinates = corners.map(|corner| {
            if corner.is_finite() {
                corner.abs().max_element()
            } else {
                f64::INFINITY
            }
        });
        let too_large = |coordinate: &f64| *coordinate > LARGEST_COORDINATE;
        if let Some(coordinate) = coordinates
            .find(too_large)
            .or(Some(mesh_extents[object.mesh]).filter(too_large))
        {
            return Err(TraceError::TooFar {
                scene: scene.id.to_string(),
                object: object.name.clone(),
                coordinate,
            });
        }
    }
    Ok(())
}
