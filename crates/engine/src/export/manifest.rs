//! The manifest of an exported scene: what an engine needs and glTF cannot express.

use std::collections::BTreeMap;

use frame::{Alignment, Shutter, Size};
use scene::{Background, Lens, Scene};
use serde::Serialize;

use crate::export::light::SKY;
use crate::export::timeline::{FRAMES_PER_SECOND, Timeline};

/// Version of the layout of `manifest.json`.
const MANIFEST_FORMAT: u32 = 1;
/// Name of the file.
pub const MANIFEST: &str = "manifest.json";

/// Everything that an engine needs to draw an exported scene like the tracer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Manifest {
    /// Version of the layout.
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Name of the scene, with its variant.
    pub scene: String,
    /// Defect that the scene exposes.
    pub exposes: String,
    /// Size of the scene's own picture.
    pub size: Size,
    /// Seconds per frame of the animation.
    pub seconds_per_frame: f64,
    /// Animation time of the frame, in seconds.
    pub instant: f64,
    /// Animation time of the previous frame, which engines need for velocity.
    pub previous: f64,
    /// Animation time of the frame after, to which `velocity_next` leads.
    pub next: f64,
    /// Exposure in frames.
    pub exposure: f64,
    /// Animation times of the shutter's opening and closing, by its alignment.
    pub shutter: BTreeMap<&'static str, [f64; 2]>,
    /// Animation times of the sub-frames, by the shutter's alignment: the midpoints of equal parts
    /// of it.
    pub subframes: BTreeMap<&'static str, Vec<f64>>,
    /// True if the shutter does not open and close at once in all rows together, as the shutter's
    /// times assume.
    pub has_shutter_profile: bool,
    /// Vertical field of view in degrees.
    pub vertical_fov: f64,
    /// Lens of the camera, which glTF cannot describe; none for a pinhole.
    pub lens: Option<Lens>,
    /// Display exposure in stops; the picture's radiance does not include it.
    pub stops: f32,
    /// Irradiance of the sun on a surface that faces it, linear Rec.709; none without a sun.
    pub sun_irradiance: Option<[f32; 3]>,
    /// Angular radius of the sun in degrees; 0 casts sharp shadows.
    pub sun_angular_radius: Option<f64>,
    /// Radiance of every direction, OpenEXR: its middle is towards -Z, its right quarter towards
    /// +X, its top towards +Y.
    pub sky: &'static str,
    /// Radiance of the sky if it is the same in all directions.
    pub sky_constant: Option<[f32; 3]>,
    /// Name of each object by its id, which is also its node's number; 0 is the background.
    pub objects: Vec<String>,
    /// Notes for engines on the meaning of the numbers, a sentence each.
    pub conventions: Vec<&'static str>,
}

const CONVENTIONS: [&str; 8] = [
    "Units are metres and linear Rec.709 radiance; the space is right-handed with +Y up, and the camera looks along its own -Z.",
    "Light: the directional light's intensity is its irradiance, without any factor for lumens; a white diffuse surface that \
     faces it sends irradiance / pi.",
    "Every surface is two-sided, casts shadows and receives indirect light; emissive surfaces light others.",
    "The picture is without fog, tone curve or exposure; its pixels are box-filtered.",
    "Without a lens the camera is a pinhole. With one, truths and the frame's colour are out of focus, by a thin lens that does not \
     darken the picture; velocity and depth are the pinhole's.",
    "The animation stops before its first key and after its last one, but the scene's motion goes on; draw only times between them.",
    "Expected velocity, to compare with the suite's: pixels per frame, +x right, +y down, the position at the instant minus the \
     position one frame before.",
    "If a filter reads them: velocity_next is the position one frame later minus the position at the instant, likewise; velocity_z \
     is the depth at the instant minus the depth one frame before, in metres.",
];

impl Manifest {
    /// Describes a scene on its timeline, with a number of sub-frames.
    pub fn of(scene: &Scene, program: &str, timeline: &Timeline, subframes: u32) -> Self {
        let shutters = Alignment::ALL.map(|alignment| {
            let shutter = alignment.shutter(scene.exposure);
            let shutter = shutter.expect("a scene's exposure was checked when it was read");
            (alignment.name(), shutter)
        });
        let ends =
            |shutter: Shutter| [shutter.open, shutter.close].map(|time| timeline.seconds(time));
        let midpoints = |shutter: Shutter| -> Vec<f64> {
            let parts = (0..subframes).map(|at| (f64::from(at) + 0.5) / f64::from(subframes));
            parts
                .map(|part| timeline.seconds(shutter.at(part)))
                .collect()
        };
        Self {
            format: MANIFEST_FORMAT,
            program: program.to_owned(),
            scene: scene.id.to_string(),
            exposes: scene.exposes.clone(),
            size: Size::new(scene.width, scene.height),
            seconds_per_frame: 1.0 / FRAMES_PER_SECOND,
            instant: timeline.seconds(0.0),
            previous: timeline.seconds(-1.0),
            next: timeline.seconds(1.0),
            exposure: scene.exposure,
            shutter: shutters.map(|(name, shutter)| (name, ends(shutter))).into(),
            subframes: shutters
                .map(|(name, shutter)| (name, midpoints(shutter)))
                .into(),
            has_shutter_profile: scene.shutter_profile != frame::ShutterProfile::default(),
            vertical_fov: scene.camera.vertical_fov_at(0.0).to_degrees(),
            lens: scene.camera.lens,
            stops: scene.display.stops,
            sun_irradiance: scene.sun.map(|sun| sun.irradiance.to_array()),
            sun_angular_radius: scene.sun.map(|sun| sun.angular_radius.to_degrees()),
            sky: SKY,
            sky_constant: match &scene.background {
                Background::Constant(radiance) => Some(radiance.to_array()),
                _ => None,
            },
            objects: scene.object_names(),
            conventions: CONVENTIONS.to_vec(),
        }
    }

    /// Writes the `capture.toml` of a capture of this scene, except for the engine's name.
    pub fn capture_template(&self) -> String {
        format!(
            "# Copy this file to the folder of the engine's pictures, and name the engine.\n\
             engine = \"my engine 1.0\"\n\
             scene = \"{}\"\n\
             exposure = {:?}\n\
             alignment = \"trailing\"  # or centred, leading\n\
             subframes = {}  # manifest.json has their times\n",
            self.scene,
            self.exposure,
            self.subframes[Alignment::Trailing.name()].len()
        )
    }
}
