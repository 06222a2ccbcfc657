//! Faces of OBJ files with more than three corners: their triangles cover them once.

use glam::{DVec2, DVec3, Vec3};
use scene::Mesh;
use tests::random::{Numbers, Random};

use super::polygons::{
    ARROW, DOOR, FRAME, Plane, Polygon, WINDOW, distance, draw_star, grow, polygon, surrounds,
    turn_and_reverse,
};
use crate::Folder;

/// Scene that shows `mesh.obj`.
const SCENE: &str = "exposes = \"faces\"\nfamily = \"limits\"\nexposure = 0.5\nsize = [1, 1]\n\
    [camera]\nposition = [0, 0, 9]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n\
    [background]\nconstant = [1, 1, 1]\n[object.model]\nmesh = \"mesh.obj\"\n";

/// Loads faces through a scene, and returns the triangles of each. No triangle may be without area.
fn load_faces(faces: &[Vec<Vec3>]) -> Vec<Vec<[Vec3; 3]>> {
    let mesh = load_mesh(faces);
    let corner = |vertex: u32| mesh.positions[vertex as usize];
    let mut triangles = mesh.triangles.iter().map(|vertices| vertices.map(corner));
    let take = |face: &Vec<Vec3>| triangles.by_ref().take(face.len() - 2).collect();
    let cut: Vec<Vec<[Vec3; 3]>> = faces.iter().map(take).collect();
    assert!(
        cut.iter()
            .zip(faces)
            .all(|(cut, face)| cut.len() == face.len() - 2)
    );
    assert_eq!(triangles.next(), None);
    cut
}

fn load_mesh(faces: &[Vec<Vec3>]) -> Mesh {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let vertex = |v: &Vec3| format!("v {} {} {}\n", v.x, v.y, v.z);
    let mut text: String = faces.iter().flatten().map(vertex).collect();
    let mut next = 1;
    for face in faces {
        let vertices = next..next + face.len();
        next = vertices.end;
        text += &format!(
            "f{}\n",
            vertices.map(|v| format!(" {v}")).collect::<String>()
        );
    }
    folder.write("mesh.obj", text);
    let mut scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    scene.meshes.remove(0)
}

/// Twice the area of a triangle, as a vector across it.
fn across([a, b, c]: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
    (b - a).cross(c - a)
}

/// Checks that triangles have the area of a face together, and that none is turned over.
fn assert_covers(face: &[Vec3], triangles: &[[Vec3; 3]], what: &str) {
    let fan = face[1..]
        .windows(2)
        .map(|pair| across([face[0], pair[0], pair[1]]));
    let normal: DVec3 = fan.sum();
    let areas = triangles.iter().map(|triangle| across(*triangle));
    assert!(
        areas.clone().all(|area| area.dot(normal) > 0.0),
        "{what}: one is turned over"
    );
    let area: f64 = areas.map(DVec3::length).sum();
    // Rounding of vertices to 32 bits.
    assert!(
        (area / normal.length() - 1.0).abs() < 1e-5,
        "{what}: {area} of {}",
        normal.length()
    );
}

#[test]
fn a_concave_face_covers_its_area_and_no_more() {
    for (points, area) in [
        (&ARROW[..], 1.0),
        (&DOOR, 10.0),
        (&WINDOW, 9.0),
        (&FRAME, 8.0),
    ] {
        for face in turn_and_reverse(&Plane::XY.place(&polygon(points))) {
            let triangles = load_faces(std::slice::from_ref(&face)).remove(0);
            assert_covers(&face, &triangles, "from some corner");
            let sum: f64 = triangles
                .into_iter()
                .map(|corners| 0.5 * across(corners).length())
                .sum();
            assert!((sum - area).abs() < 1e-9, "{sum} of {area}");
        }
    }
}

#[test]
fn random_faces_are_covered_once_from_every_corner_and_in_every_plane() {
    let mut random = Random::new(1);
    let mut numbers = Numbers(2 << 32);
    let polygons = (0..60).map(|index| match index % 3 {
        0 => draw_star(&mut random),
        _ => grow(&mut random),
    });
    let polygons: Vec<Polygon> = polygons.collect();
    let concave = polygons.iter().filter(|polygon| polygon.len() > 12).count();
    assert!(concave > 20, "{concave} have many corners");
    for polygon in polygons {
        let turned = turn_and_reverse(&polygon).into_iter();
        let faces = turned.map(|polygon| Plane::random(&mut numbers).place(&polygon));
        let faces: Vec<Vec<Vec3>> = faces.collect();
        for (face, triangles) in faces.iter().zip(load_faces(&faces)) {
            assert_covers(face, &triangles, &format!("{polygon:?}"));
        }
    }
}

/// Two hundred files. A point in a face is in one of its triangles, and a point beside the face in
/// none.
#[test]
fn triangles_of_generated_files_contain_the_points_that_their_faces_surround() {
    let mut random = Random::new(3);
    let mut numbers = Numbers(4 << 32);
    let mut inside = 0;
    for file in 0..200 {
        let holed = [&DOOR[..], &WINDOW, &FRAME][file % 3];
        let polygons = [draw_star(&mut random), grow(&mut random), polygon(holed)];
        let planes = [(); 3].map(|()| Plane::random(&mut numbers));
        let faces = [0, 1, 2].map(|index| planes[index].place(&polygons[index]));
        for (index, triangles) in load_faces(&faces).into_iter().enumerate() {
            let flat = |corners: [Vec3; 3]| corners.map(|corner| planes[index].flatten(corner));
            let triangles: Vec<Polygon> = triangles.into_iter().map(|t| flat(t).to_vec()).collect();
            for _ in 0..200 {
                let point =
                    DVec2::new(random.real(-1.0, 4.0).into(), random.real(-1.0, 4.0).into());
                let point = if index < 2 { point.fract() } else { point };
                let sides = polygons[index]
                    .iter()
                    .zip(polygons[index].iter().cycle().skip(1));
                let triangle_sides = triangles
                    .iter()
                    .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
                let mut sides = sides.map(|(a, b)| [*a, *b]).chain(triangle_sides);
                if sides.any(|side| distance(point, side) < 1e-4) {
                    // Rounding of vertices to 32 bits decides.
                    continue;
                }
                let covering = triangles
                    .iter()
                    .filter(|triangle| surrounds(triangle, point));
                let due = usize::from(surrounds(&polygons[index], point));
                assert_eq!(
                    covering.count(),
                    due,
                    "file {file}, {point} of {:?}",
                    polygons[index]
                );
                inside += due;
            }
        }
    }
    assert!(inside > 10_000, "{inside} points were inside");
}

/// Neighbouring faces meet in all their corners, also in those in the middle of a straight side.
#[test]
fn every_side_of_a_face_is_a_side_of_a_triangle() {
    for points in [&DOOR[..], &FRAME] {
        for face in turn_and_reverse(&Plane::XY.place(&polygon(points))) {
            let triangles = load_faces(std::slice::from_ref(&face)).remove(0);
            for (from, to) in face.iter().zip(face.iter().cycle().skip(1)) {
                let mut sides = triangles
                    .iter()
                    .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
                assert!(sides.any(|side| side == [from, to]), "{from} to {to}");
            }
        }
    }
}

#[test]
fn a_convex_face_is_a_fan_from_its_first_corner_and_so_is_a_twisted_one() {
    let corners = |points: &[[f32; 3]]| points.iter().copied().map(Vec3::from).collect();
    let flat = corners(&[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 1.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 1.0, 0.0],
    ]);
    assert_eq!(
        load_mesh(&[flat]).triangles,
        [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    );
    // The quad's sides cross if seen from +Z, but one passes far above the other.
    let twisted = corners(&[
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 1.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.2],
    ]);
    assert_eq!(load_mesh(&[twisted]).triangles, [[0, 1, 2], [0, 2, 3]]);
}

/// The triangles cover the area that the sides surround, in any plane.
#[test]
fn a_quad_that_crosses_itself_is_two_triangles_that_meet_there() {
    let mut numbers = Numbers(5 << 32);
    let tie = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [2.0, 1.0]];
    let uneven = [[0.0, 0.0], [3.0, 0.0], [0.0, 1.0], [1.5, 1.0]];
    for (points, area) in [(&tie, 1.0), (&uneven, 1.25)] {
        for turned in turn_and_reverse(&polygon(points)) {
            let mesh = load_mesh(&[Plane::random(&mut numbers).place(&turned)]);
            let corners = mesh.triangles.iter();
            let corners = corners.map(|t| t.map(|vertex| mesh.positions[vertex as usize]));
            let sum: f64 = corners.map(|corners| 0.5 * across(corners).length()).sum();
            // Rounding of vertices to 32 bits.
            assert!((sum - area).abs() < 1e-5, "{sum} of {area}: {turned:?}");
            assert_eq!(mesh.positions.len(), 5);
        }
    }
}

#[test]
fn other_faces_that_cross_themselves_are_refused() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let star = "v 0 3 0\nv 2 -3 0\nv -3 1 0\nv 3 1 0\nv -2 -3 0\n";
    // Two ends of a snake over each other: its area is counted twice there.
    let snake = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 1 4 0\nv 1 -1 0\nv 2 -1 0\nv 2 3 0\nv 3 3 0\nv 3 1 0\nv 0 1 0\n";
    // Around its first corner by 390 degrees: a fan would cover 30 of them twice.
    let spiral = "v 0 0 0\nv 4 0 0\nv -3 3 0\nv -1 -4 0\nv 3.4 2 0\n";
    for (vertices, count) in [(star, 5), (snake, 10), (spiral, 5)] {
        let corners: Vec<String> = (1..=count).map(|corner| corner.to_string()).collect();
        folder.write(
            "mesh.obj",
            format!("{vertices}f 1 2 3\nf {}\n", corners.join(" ")),
        );
        let error = folder.load().expect_err("its surface is not defined");
        assert_eq!(error.line, Some(count + 2), "{error}");
        assert!(error.reason.contains("crosses itself"), "{error}");
    }
}

#[test]
fn key_shapes_are_cut_as_the_first_of_them() {
    let folder = Folder::new();
    let shapes = "shapes = [{ time = -1, mesh = \"mesh.obj\" }, { time = 1, mesh = \"bent.obj\" }]";
    folder.write("scene.toml", SCENE.replace("mesh = \"mesh.obj\"", shapes));
    let arrow = "v -1 1 0\nv 0 -1 0\nv 1 1 0\nv 0 0 0\nf 1 2 3 4\n";
    folder.write("mesh.obj", arrow);
    folder.write("bent.obj", arrow.replace("v 0 0 0", "v 0 3 0"));
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let mesh = &scene.meshes[0];
    for (shape, doubled_area) in mesh.shapes.iter().zip([2.0, 8.0]) {
        let corner = |vertex: u32| shape.positions[vertex as usize];
        let areas = mesh
            .triangles
            .iter()
            .map(|vertices| across(vertices.map(corner)));
        assert_eq!(
            areas.map(|area| area.z).collect::<Vec<f64>>(),
            [0.5 * doubled_area; 2]
        );
    }
}
