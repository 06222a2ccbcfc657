//! Rays per second. The variants take turns, part by part, and the best of several turns of every
//! part counts, so that a busy machine does not change the rates.

mod frames;
mod made_scene;
mod written_scenes;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::DVec3;
use made_scene::{SHUTTER, made_scene};
use scene::Scene;
use tracer::{Ray, Stage, View};

/// Rays of one turn.
const RAYS: usize = 1 << 16;
/// Parts that are timed one by one, short enough to find the machine free now and then.
const PARTS: usize = 16;
/// Turns of each variant.
const TURNS: u32 = 16;
/// Part of the scene's size by which bounces leave their surface.
const LIFT: f64 = 1e-6;

fn main() {
    if !std::env::args().any(|word| word == "truths") {
        print_rates();
    }
    frames::report();
}

/// A ray and its time in frames.
type TimedRay = (Ray, f64);

/// The query of a ray.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The closest hit of camera rays over the whole picture.
    Primary,
    /// The closest hit of one cosine-distributed bounce from each of theirs.
    Diffuse,
    /// Occlusion between their hits and a distant light.
    Shadow,
}

const KINDS: [Kind; 3] = [Kind::Primary, Kind::Diffuse, Kind::Shadow];

/// A scene with rays through it.
struct Field<'a> {
    stage: Stage<'a>,
    rays: [Vec<TimedRay>; 3],
}

impl<'a> Field<'a> {
    /// Prepares rays at times in `[from, to]`. At one time nothing moves.
    fn new(scene: &'a Scene, [from, to]: [f64; 2]) -> Self {
        let stage = Stage::new(scene, from, to);
        let primary = camera_rays(scene, [from, to]);
        let (diffuse, shadow) = bounces(&stage, &primary);
        Self {
            stage,
            rays: [primary, diffuse, shadow],
        }
    }

    /// Traces a part of the rays of a kind; returns the number that hit something.
    fn trace(&self, kind: Kind, part: usize) -> usize {
        let mut poses = self.stage.poses();
        let rays = &self.rays[kind as usize];
        let [start, end] = [part, part + 1].map(|part| part * rays.len() / PARTS);
        let rays = rays[start..end].iter();
        rays.filter(|(ray, time)| match kind {
            Kind::Primary | Kind::Diffuse => self.stage.closest(poses.at(*time), ray).is_some(),
            Kind::Shadow => self.stage.is_blocked(poses.at(*time), ray, f64::INFINITY),
        })
        .count()
    }

    fn portable(self) -> Self {
        let stage = self.stage.portable();
        Self { stage, ..self }
    }

    /// The rate of the best of several turns, rays per second.
    fn rate(&self, kind: Kind, best: Duration) -> f64 {
        self.rays[kind as usize].len() as f64 / best.as_secs_f64()
    }
}

/// Prints the rays per second of each kind, and the ratios of variants.
fn print_rates() {
    let scene = made_scene();
    let in_mid_shutter = [0.5 * (SHUTTER[0] + SHUTTER[1]); 2];
    let fields = [in_mid_shutter, SHUTTER].map(|times| Field::new(&scene, times));
    let triangles: usize = (scene.objects.iter())
        .map(|object| scene.meshes[object.mesh].triangles.len())
        .sum();
    println!(
        "\n{triangles} triangles, one thread, {RAYS} rays, best of {TURNS} turns of each of {PARTS} parts, Mray/s"
    );
    println!(
        "{:10} {:>8} {:>8} {:>14} {:>9} {:>14}",
        "", "still", "moving", "still/moving", "portable", "still/portable"
    );
    let portable = Field::new(&scene, in_mid_shutter).portable();
    for kind in KINDS {
        let best = best_of([
            &|part| once(|| fields[0].trace(kind, part)),
            &|part| once(|| fields[1].trace(kind, part)),
            &|part| once(|| portable.trace(kind, part)),
        ]);
        let [still, moving, portable] = best.map(|best| fields[0].rate(kind, best) / 1e6);
        let name = format!("{kind:?}").to_lowercase();
        println!(
            "{name:10} {still:8.2} {moving:8.2} {:14.2} {portable:9.2} {:14.2}",
            still / moving,
            still / portable
        );
    }
    println!("{} path", fields[0].stage.traversal());
}

/// Measures the time of some work.
fn once(work: impl Fn() -> usize) -> Duration {
    let start = Instant::now();
    black_box(work());
    start.elapsed()
}

/// Measures several works in parts and in turns; returns for each the sum of its parts' shortest
/// times.
fn best_of<const N: usize>(works: [&dyn Fn(usize) -> Duration; N]) -> [Duration; N] {
    let mut best = [[Duration::MAX; PARTS]; N];
    for _ in 0..TURNS {
        for part in 0..PARTS {
            for (best, work) in best.iter_mut().zip(works) {
                best[part] = work(part).min(best[part]);
            }
        }
    }
    best.map(|parts| parts.iter().sum())
}

/// A number in [0, 1) that depends on its arguments alone: R2 points (Roberts 2018), rotated per
/// dimension.
fn number(index: usize, dimension: usize) -> f64 {
    const STEPS: [f64; 3] = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_3,
        0.549_700_477_901_970_2,
    ];
    (0.5 + (index + 1) as f64 * STEPS[dimension % 3] + dimension as f64 * 0.37).fract()
}

/// Camera rays in rows from left to right, as a renderer takes them, each with a time of its own.
fn camera_rays(scene: &Scene, [from, to]: [f64; 2]) -> Vec<TimedRay> {
    let view = View::new(&scene.camera, 0.0, scene.width, scene.height);
    let columns = 341; // about 16:9
    let rows = RAYS / columns;
    (0..RAYS)
        .map(|index| {
            let x = ((index % columns) as f64 + 0.5) / columns as f64 * f64::from(scene.width);
            let y = ((index / columns) as f64 + 0.5) / rows as f64 * f64::from(scene.height);
            let time = from + number(index, 0) * (to - from);
            (view.ray(x, y), time)
        })
        .collect()
}

/// One bounce and one shadow ray from each hit, at the time of the camera ray.
fn bounces(stage: &Stage, primary: &[TimedRay]) -> (Vec<TimedRay>, Vec<TimedRay>) {
    let light = DVec3::new(0.3, 1.0, 0.4).normalize();
    let mut poses = stage.poses();
    (primary.iter().enumerate())
        .filter_map(|(index, (ray, time))| {
            let hit = stage.closest(poses.at(*time), ray)?;
            let normal = stage.facet(&mut poses, ray, &hit);
            let origin = ray.at(hit.t) + LIFT * hit.t * normal;
            let (tangent, bitangent) = normal.any_orthonormal_pair();
            let [radius, angle] = [number(index, 1).sqrt(), TAU * number(index, 2)];
            let direction = radius * angle.cos() * tangent
                + radius * angle.sin() * bitangent
                + (1.0 - radius * radius).sqrt() * normal;
            let shadow = Ray {
                origin,
                direction: light,
            };
            Some(((Ray { origin, direction }, *time), (shadow, *time)))
        })
        .unzip()
}
