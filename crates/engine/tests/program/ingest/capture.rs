//! A capture, made from our own scene like an engine's with its own conventions.

use std::fs;
use std::path::PathBuf;

use frame::{
    Alignment, Channel, ExrFile, FAR_DEPTH, Frame, Image, Raster, Samples, VelocityKind, read_exr,
    write_exr, write_half_exr,
};
use scene::load_scene;
use tests::{settings, unwatched};
use tracer::trace_frame;

use crate::sandbox::Sandbox;

pub const EXPOSURE: f64 = 0.5;
pub const WIDTH: u32 = 96;
pub const HEIGHT: u32 = 54;
const NEAR: f32 = 0.1;

pub const DESCRIPTION: &str = include_str!("capture.toml");

/// Velocity in normalised device coordinates, upwards, and reversed depth with a far plane at
/// infinity.
pub const CONVENTION: &str = include_str!("engine.toml");

/// A folder `capture` in a sandbox, with the sandbox's plate as an engine would draw it.
pub struct Capture<'a> {
    sandbox: &'a Sandbox,
    /// The frame that it was made from.
    pub frame: Frame,
}

impl<'a> Capture<'a> {
    /// Writes the instant, in half floats like most engines.
    pub fn new(sandbox: &'a Sandbox) -> Self {
        Self::at(sandbox, 0.0)
    }

    /// Writes another time than the instant.
    pub fn at(sandbox: &'a Sandbox, time: f64) -> Self {
        let capture = Self {
            sandbox,
            frame: render_plate(sandbox, time),
        };
        fs::create_dir(sandbox.path("capture")).unwrap();
        capture.write("capture.toml", DESCRIPTION);
        capture.write("engine.toml", CONVENTION);
        let frame = &capture.frame;
        capture.write_color("color.exr", &frame.color);
        let [x, y] = [2.0 / WIDTH as f32, -2.0 / HEIGHT as f32];
        let axes = [(0, x), (1, y)];
        let velocity = axes.map(|(axis, by)| frame.velocity.map(|motion| motion[axis] * by));
        let reversed = frame.depth.map(|depth| {
            if *depth == FAR_DEPTH {
                0.0
            } else {
                NEAR / depth
            }
        });
        for (name, planes) in [("velocity.exr", &velocity[..]), ("depth.exr", &[reversed])] {
            let mut file = ExrFile::new(WIDTH, HEIGHT);
            for (channel, plane) in ["R", "G"].iter().zip(planes) {
                file.push_plane(channel, plane);
            }
            write_half_exr(&capture.path(name), file).unwrap();
        }
        let mut file = ExrFile::new(WIDTH, HEIGHT);
        file.channels.push(Channel {
            name: "object".into(),
            samples: Samples::U32(frame.object_id.pixels.clone()),
        });
        write_exr(&capture.path("object.exr"), &file).unwrap();
        capture
    }

    pub fn with_subframes(self, count: u32) -> Self {
        self.add_subframes(count, false)
    }

    /// Adds sub-frames at the midpoints of equal parts of the shutter, with or without object ids,
    /// and as the engine's blur the mean of the first four.
    pub fn add_subframes(self, count: u32, has_ids: bool) -> Self {
        fs::create_dir(self.path("subframes")).unwrap();
        let shutter = Alignment::Trailing.shutter(EXPOSURE).unwrap();
        let mut blurred = self.frame.color.map(|_| [0.0; 3]);
        for index in 0..count {
            let time = shutter.at((f64::from(index) + 0.5) / f64::from(count));
            let frame = render_plate(self.sandbox, time);
            let (color, ids) = (&frame.color, has_ids.then_some(&frame.object_id));
            self.write_picture(&format!("subframes/{index:04}.exr"), color, ids);
            if index < 4 {
                blurred = blurred.zip(color, |sum, color| {
                    std::array::from_fn(|channel| sum[channel] + 0.25 * color[channel])
                });
            }
        }
        self.write_color("blurred.exr", &blurred);
        self
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.sandbox.path("capture").join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    /// Writes colour with the convention's exposure.
    pub fn write_color(&self, name: &str, color: &Image) {
        self.write_picture(name, color, None);
    }

    /// Reads colour as [`Capture::write_color`] wrote it.
    pub fn read_color(&self, name: &str) -> Image {
        let color = read_exr(&self.path(name)).unwrap().color("").unwrap();
        color.map(|pixel| pixel.map(|value| 0.5 * value))
    }

    /// Writes colour, and the ids of objects as floats, -1 for the background.
    pub fn write_picture(&self, name: &str, color: &Image, ids: Option<&Raster<u32>>) {
        let mut file = ExrFile::new(color.width, color.height);
        file.push_color("", &color.map(|pixel| pixel.map(|value| 2.0 * value)));
        if let Some(ids) = ids {
            let ids = ids.map(|id| if *id == 0 { -1.0 } else { *id as f32 });
            file.push_plane("object", &ids);
        }
        write_half_exr(&self.path(name), file).unwrap();
    }
}

/// Renders the scene of a folder at a time, with the velocity that engines have.
pub fn render_instant(folder: PathBuf, samples_per_pixel: u32, time: f64) -> Frame {
    let scene = load_scene(folder, None).unwrap().later_by(time);
    let mut settings = settings([WIDTH, HEIGHT], samples_per_pixel);
    settings.options.velocity = VelocityKind::PreviousFrame;
    trace_frame(&scene, &settings, &unwatched).unwrap()
}

fn render_plate(sandbox: &Sandbox, time: f64) -> Frame {
    render_instant(sandbox.path("scenes/plate"), 16, time)
}
