//! Velocity of single objects that lacks a part of their motion, or has too much: the structure is
//! named, and no unit.

use engine::{Buffer, CaptureAudit, Cause, Defect};
use glam::Vec3;
use scene::{Parent, Scene, Shape};
use tracer::PointMotion;

use super::*;

/// Takes the velocity of some objects from another motion, and audits it.
fn audit_mixed(drawn: &DrawnScene, objects: &[&str], motion: &PointMotion) -> CaptureAudit {
    let other = trace_velocity(drawn.scene, motion);
    audit_changed(drawn, objects, |at, _| other.pixels[at])
}

/// Changes the velocity of some objects, by pixel, and audits it.
fn audit_changed(
    drawn: &DrawnScene,
    objects: &[&str],
    change: impl Fn(usize, [f32; 2]) -> [f32; 2],
) -> CaptureAudit {
    let ids = objects.iter().map(|name| id_of(drawn.scene, name));
    let ids: Vec<u32> = ids.collect();
    let mut velocity = drawn.capture.velocity.clone();
    let seen = drawn.capture.object_id.as_ref().unwrap();
    for (at, id) in seen.pixels.iter().enumerate() {
        if ids.contains(id) {
            velocity.pixels[at] = change(at, velocity.pixels[at]);
        }
    }
    drawn.audit_velocity(velocity)
}

/// Expects one finding per object, with a cause, and no advice on units or conventions.
#[track_caller]
fn expect_each(audit: &CaptureAudit, objects: &[&str], is_cause: impl Fn(&Cause) -> bool) {
    assert_eq!(audit.findings.len(), objects.len(), "{:#?}", audit.findings);
    for object in objects {
        let is_own = |defect: &&Defect| defect.object.as_deref() == Some(object);
        let finding = audit.findings.iter().find(is_own);
        let finding = finding.unwrap_or_else(|| panic!("{object}: {:#?}", audit.findings));
        assert_eq!(finding.buffer, Buffer::Velocity);
        assert!(is_cause(&finding.explanation.cause), "{finding:#?}");
        for word in ["unit", "convention may", "velocity_scale", "times as long"] {
            assert!(!finding.text.contains(word), "{word}: {}", finding.text);
        }
    }
}

/// The moving scene, in which the disc is the car's child.
fn with_child() -> Scene {
    let mut scene = load_moving();
    let [disc, car] = ["disc", "car"].map(|name| id_of(&scene, name) as usize - 1);
    // A parent comes before its children.
    scene.objects.swap(disc, car);
    let (parent, child) = (disc.min(car), disc.max(car));
    if scene.objects[parent].name != "car" {
        scene.objects.swap(disc, car);
    }
    scene.objects[child].parent = Parent::Object(parent);
    for key in &mut scene.objects[child].motion.keys {
        key.translation.x += 0.5;
        key.translation.y += 0.75;
        key.translation.z += 1.2;
    }
    scene
}

/// The moving scene, in which the disc changes its shape like a bone that bends: its upper half
/// leans over.
fn with_shapes() -> Scene {
    let mut scene = load_moving();
    let disc = &scene.objects[id_of(&scene, "disc") as usize - 1];
    let mesh = &mut scene.meshes[disc.mesh];
    let shape = |time: f64| Shape {
        time,
        positions: (mesh.positions.iter())
            .map(|at| *at + 0.8 * time as f32 * at.y.max(0.0) * Vec3::new(1.0, 0.1, 0.3))
            .collect(),
        normals: Vec::new(),
    };
    mesh.shapes = vec![shape(-1.0), shape(1.0)];
    scene
}

static CHILD_SCENE: LazyLock<Scene> = LazyLock::new(with_child);
static LEANING_SCENE: LazyLock<Scene> = LazyLock::new(|| with_shapes().later_by(0.5));

/// The scene with a child.
pub(super) static CHILD: LazyLock<DrawnScene> = LazyLock::new(|| DrawnScene::new(&CHILD_SCENE));
/// The scene in which the disc changes its shape, half a frame later.
pub(super) static LEANING: LazyLock<DrawnScene> = LazyLock::new(|| DrawnScene::new(&LEANING_SCENE));

#[test]
fn an_instance_without_its_own_motion_is_named() {
    let without = PointMotion::WITHOUT_OBJECTS;
    let missing = |cause: &Cause| *cause == Cause::OwnMotionMissing;
    let verdict = audit_mixed(&MOVING, &["car"], &without);
    expect_each(&verdict, &["car"], missing);
    let text = &verdict.findings[0].text;
    let words = "velocity of `car` lacks its own motion; keep the matrix of each object, and of each instance";
    assert!(text.starts_with(words), "{text}");
}

#[test]
fn a_child_that_moves_as_its_parent_alone_is_told_from_one_that_does_not_move() {
    let [child, all] = [PointMotion::WITHOUT_OWN, PointMotion::WITHOUT_OBJECTS];
    let missing = |due: Cause| move |cause: &Cause| *cause == due;
    let verdict = audit_mixed(&CHILD, &["disc"], &child);
    expect_each(&verdict, &["disc"], missing(Cause::OwnMotionMissing));
    let verdict = audit_mixed(&CHILD, &["disc"], &all);
    expect_each(&verdict, &["disc"], missing(Cause::ObjectMotionMissing));
}

#[test]
fn bones_and_morphs_that_are_not_kept_are_named() {
    let without = PointMotion::WITHOUT_SHAPES;
    let missing = |cause: &Cause| *cause == Cause::DeformationMissing;
    let verdict = audit_mixed(&LEANING, &["disc"], &without);
    expect_each(&verdict, &["disc"], missing);
    let text = &verdict.findings[0].text;
    assert!(
        text.contains("keep bones, morph weights or vertices"),
        "{text}"
    );
}

#[test]
fn jitter_in_one_pass_is_an_offset_on_its_objects_and_no_scale() {
    for offset in [[-0.3, 0.2], [0.45, -0.1], [0.0, 0.4]] {
        let verdict = audit_changed(&MOVING, &["car", "disc"], |_, [x, y]| {
            [x + offset[0], y + offset[1]]
        });
        let is_offset = |cause: &Cause| match cause {
            Cause::Offset(fitted) => {
                let [x, y] = [0, 1].map(|axis| fitted[axis] - f64::from(offset[axis]));
                x.hypot(y) < 1e-3
            }
            _ => false,
        };
        expect_each(&verdict, &["car", "disc"], is_offset);
        let text = &verdict.findings[0].text;
        assert!(
            text.contains("as of jitter in the pass that draws it"),
            "{text}"
        );
    }
}

#[test]
fn an_object_of_another_sign_or_length_is_named_without_advice_on_the_convention() {
    let turned = audit_changed(&MOVING, &["car"], |_, [x, y]| [-x, -y]);
    let twice = audit_changed(&MOVING, &["car"], |_, [x, y]| [2.0 * x, 2.0 * y]);
    for (verdict, words) in [
        (turned, "velocity of `car` has the wrong sign"),
        (twice, "velocity of `car` is twice too long"),
    ] {
        let text = &verdict.findings[0].text;
        assert!(text.starts_with(words), "{text}");
        assert!(
            text.ends_with("; the convention fits other objects"),
            "{text}"
        );
    }
}

#[test]
fn a_buffer_of_half_the_resolution_is_named() {
    let velocity = &MOVING.capture.velocity;
    let block = |x: u32, y: u32| [x / 2 * 2, y / 2 * 2];
    let cornered = Vectors::from_fn(WIDTH, HEIGHT, |x, y| {
        let [x, y] = block(x, y);
        *velocity.at(x + 1, y)
    });
    let mean = Vectors::from_fn(WIDTH, HEIGHT, |x, y| {
        let [x, y] = block(x, y);
        let four = [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]];
        let sum = |axis: usize| {
            four.map(|[x, y]| velocity.at(x, y)[axis])
                .iter()
                .sum::<f32>()
        };
        [0, 1].map(|axis| 0.25 * sum(axis))
    });
    for half in [cornered, mean] {
        let verdict = MOVING.audit_velocity(half);
        let is_half = |cause: &Cause| *cause == Cause::LowResolution(2);
        let finding = expect(&verdict, Buffer::Velocity, None, is_half);
        let words = "velocity has 1/2 of the resolution: 2x2 pixels share a vector";
        assert!(finding.text.starts_with(words), "{}", finding.text);
    }
}

#[test]
fn a_shape_of_another_key_is_named_with_its_time() {
    // Keys at -0.75 and 1.25 frames; the first one is the rest pose.
    let scene = with_shapes().later_by(-0.25);
    let mut later = scene.clone();
    let disc = later.objects[id_of(&scene, "disc") as usize - 1].mesh;
    let right = later.meshes[disc].clone();
    let place = |time: f64| -> Vec<Vec3> {
        let positions = right.at(time).positions();
        positions.map(|position| position.as_vec3()).collect()
    };
    // The picture moves from the shape at 1.25 to that of the instant.
    let shape = |time: f64, positions: Vec<Vec3>| Shape {
        time,
        positions,
        normals: Vec::new(),
    };
    later.meshes[disc].shapes = vec![shape(-1.0, place(1.25)), shape(0.0, place(0.0))];
    later.meshes[disc].positions = place(1.25);
    let other = trace_velocity(&later, &PointMotion::RIGHT);
    let drawn = DrawnScene::new(&scene);
    let verdict = audit_changed(&drawn, &["disc"], |at, _| other.pixels[at]);
    expect_each(&verdict, &["disc"], |cause| {
        *cause == Cause::OtherPose(1.25)
    });
    let text = &verdict.findings[0].text;
    assert!(text.contains("its key shape at +1.25 frames"), "{text}");
}
