//! An opened GPU.

use std::sync::{Arc, Mutex, OnceLock, PoisonError, RwLock, RwLockReadGuard};

use serde::{Deserialize, Serialize};

use crate::{FilterError, Format};

/// Features that read the GPU's own clock between passes.
pub(super) const TIMESTAMPS: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// Features that shaders of engines may need: samplers that interpolate 32-bit floats or have a
/// border, and storage textures in more formats.
const SHADERS_OF_ENGINES: wgpu::Features = wgpu::Features::FLOAT32_FILTERABLE
    .union(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES)
    .union(wgpu::Features::RG11B10UFLOAT_RENDERABLE)
    .union(wgpu::Features::SHADER_F64)
    .union(wgpu::Features::ADDRESS_MODE_CLAMP_TO_BORDER);

/// Features that filters use where an adapter has them.
pub(super) const FEATURES: wgpu::Features = TIMESTAMPS.union(SHADERS_OF_ENGINES);

/// Description of an adapter, as a run records it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdapterDescription {
    /// The device's name.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// Graphics interface: `vulkan`, `metal`, `dx12`.
    pub backend: String,
    /// Kind of device: `discrete`, `integrated`, `virtual`, `software` or `other`.
    pub kind: String,
}

/// Clock that durations are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The GPU's own clock, read between two pieces of work.
    Timestamps,
    /// The computer's clock, read before each piece is submitted and once the GPU is idle. It
    /// includes submission and waiting, so short work seems longer.
    WallClock,
}

/// Loop iterations that an adapter grants one invocation, all its loops together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopLimit {
    /// Iterations after which every loop ends.
    pub iterations: u32,
    /// Most invocations that run in lockstep and share the limit: if they branch apart, their
    /// iterations add up.
    pub lanes: u32,
}

impl LoopLimit {
    /// Returns the iterations of one invocation above which the picture may be wrong: its lockstep
    /// neighbours may take as many.
    pub fn safe(self) -> u32 {
        self.iterations / self.lanes.max(1)
    }
}

/// An opened GPU.
#[derive(Debug)]
pub struct Gpu {
    /// Description of the adapter.
    pub adapter: AdapterDescription,
    /// Clock for durations: timestamps if the adapter has them.
    pub clock: Clock,
    /// Loop iterations that it grants an invocation; `None` if it ends no loop early.
    pub loop_limit: Option<LoopLimit>,
    /// Formats in which its shaders can store textures.
    pub(super) stored_formats: Vec<Format>,
    /// True if its shaders convert between floats of 32 and of 16 bits.
    pub(super) packs_halves: bool,
    /// Function polled while the GPU works; work stops when it returns true. The default never
    /// does.
    pub interrupted: fn() -> bool,
    pub(super) opened: wgpu::Adapter,
    pub(super) device: RwLock<Device>,
    /// Locked while a thread waits for its work; the pass that was given up, if one was.
    pub(super) given_up: Mutex<Option<String>>,
}

/// An open device. It may get lost, and is opened again then.
#[derive(Debug)]
pub(super) struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// What the driver says once the device is lost.
    lost: Arc<OnceLock<String>>,
}

impl Device {
    /// Opens a device of an adapter with all features that filters need and all its limits.
    pub fn open(adapter: &wgpu::Adapter) -> Result<Self, FilterError> {
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("shuttertruth"),
            required_features: adapter.features() & FEATURES,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let opened = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) = opened.map_err(|error| {
            FilterError::Refused(format!(
                "adapter \"{}\" cannot be used: {error}; choose another adapter",
                adapter.get_info().name
            ))
        })?;
        let lost = Arc::new(OnceLock::new());
        let said = lost.clone();
        device.set_device_lost_callback(move |_, reason| _ = said.set(reason));
        let is_lost = lost.clone();
        // After a loss, everything fails, and the loss is reported.
        device.on_uncaptured_error(Arc::new(move |error| {
            assert!(is_lost.get().is_some(), "wgpu error: {error}");
        }));
        Ok(Self {
            device,
            queue,
            lost,
        })
    }
}

impl Gpu {
    /// Returns the open device.
    pub(super) fn device(&self) -> wgpu::Device {
        self.read_device().device.clone()
    }

    /// Returns the open device's queue.
    pub(super) fn queue(&self) -> wgpu::Queue {
        self.read_device().queue.clone()
    }

    /// Says why the device is lost, if it is.
    pub(super) fn find_loss(&self) -> Option<String> {
        self.read_device().lost.get().cloned()
    }

    fn read_device(&self) -> RwLockReadGuard<'_, Device> {
        self.device.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// Opens the device again if it is lost. What was made for the lost one stays unusable.
    pub(super) fn reopen_if_lost(&self) -> Result<(), FilterError> {
        if self.find_loss().is_some() {
            let device = Device::open(&self.opened)?;
            *self.device.write().unwrap_or_else(PoisonError::into_inner) = device;
        }
        Ok(())
    }

    /// Creates a buffer.
    pub(super) fn create_buffer(
        &self,
        label: &str,
        size: u64,
        usage: wgpu::BufferUsages,
    ) -> wgpu::Buffer {
        self.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use frame::{Image, Plane, Raster, Vectors};

    use super::*;
    use crate::gpu::place::Place;
    use crate::{Blur, Filter, Input, Kernels};

    /// Blurs a picture of 4x3 pixels.
    fn run(blur: &mut Blur) -> Result<Vec<Image>, FilterError> {
        let color = Raster::from_fn(4, 3, |x, y| [x as f32, y as f32, 1.0]);
        run_by(&color, |input| blur.run(input))
    }

    /// Runs a filter on a colour that moves to the right.
    fn run_by(
        color: &Image,
        run: impl FnOnce(&Input) -> Result<Vec<Image>, FilterError>,
    ) -> Result<Vec<Image>, FilterError> {
        let velocity: Vectors = Raster::filled(4, 3, [1.0, 0.0]);
        let depth: Plane = Raster::filled(4, 3, 2.0);
        run(&Input {
            color: &[color],
            velocity: &velocity,
            velocity_next: None,
            velocity_z: None,
            exclusion: None,
            depth: &depth,
            reprojection: None,
            camera: None,
            exposure: 1.0,
            frames_per_second: None,
            frame_index: 0,
        })
    }

    #[test]
    fn a_filter_that_loses_the_device_is_named_and_others_get_a_new_one() {
        let gpu = Gpu::new(None).unwrap();
        let filter = Filter::builtin("velocity_gather").unwrap();
        let settings = filter.settings(None).unwrap();
        let kernels = Kernels::compile(&gpu, &filter).unwrap();
        let make = || Blur::with_kernels(&kernels, &settings, 4, 3).unwrap();
        let mut blur = make();
        let expected = run(&mut blur).unwrap();
        gpu.device().destroy();
        let _ = gpu.device().poll(wgpu::PollType::Poll);
        for _ in 0..2 {
            let error = run(&mut blur).unwrap_err();
            let is_named =
                matches!(&error, FilterError::Lost { filter, .. } if filter == "velocity_gather");
            assert!(is_named, "{error}");
        }
        assert_eq!(run(&mut make()).unwrap(), expected);
        gpu.device().destroy();
        let _ = gpu.device().poll(wgpu::PollType::Poll);
        let other = Filter::builtin("identity").unwrap();
        let settings = other.settings(None).unwrap();
        let mut blur = Blur::new(&gpu, &other, &settings, 4, 3).unwrap();
        assert_eq!(run(&mut blur).unwrap()[0].at(3, 2), &[3.0, 2.0, 1.0]);
    }

    #[test]
    fn further_colours_are_blurred_as_by_themselves() {
        let gpu = Gpu::new(None).unwrap();
        let filter = Filter::builtin("jump_flood").unwrap();
        let settings = filter.settings(None).unwrap();
        let make = || Blur::new(&gpu, &filter, &settings, 4, 3).unwrap();
        let other = Raster::from_fn(4, 3, |x, _| [2.0, 1.0, x as f32]);
        let mut blur = make();
        let first = run(&mut blur).unwrap();
        let further = run_by(&other, |input| blur.run_further(input, input)).unwrap();
        assert_eq!(further, run_by(&other, |input| make().run(input)).unwrap());
        assert_ne!(further, first);
    }

    #[test]
    fn threads_that_share_a_device_get_their_own_pictures() {
        let gpu = Gpu::new(None).unwrap();
        let filter = Filter::builtin("identity").unwrap();
        let settings = filter.settings(None).unwrap();
        let blur_often = || {
            let mut blur = Blur::new(&gpu, &filter, &settings, 4, 3).unwrap();
            for _ in 0..300 {
                assert_eq!(run(&mut blur).unwrap()[0].at(3, 2), &[3.0, 2.0, 1.0]);
            }
        };
        std::thread::scope(|threads| {
            for _ in 0..4 {
                threads.spawn(blur_often);
            }
        });
    }

    #[test]
    fn the_work_of_another_thread_does_not_count_and_none_follows_a_pass_that_was_given_up() {
        let gpu = Gpu::new(None).unwrap();
        let mut filter = Filter::builtin("identity").unwrap();
        filter.time_limit = 1.0;
        let settings = filter.settings(None).unwrap();
        let mut blur = Blur::new(&gpu, &filter, &settings, 4, 3).unwrap();
        let place = Place {
            filter: "other",
            pass: "work",
        };
        let turn = gpu.take_turn(place).unwrap();
        std::thread::scope(|threads| {
            let other = threads.spawn(|| run(&mut blur));
            std::thread::sleep(std::time::Duration::from_secs_f64(1.5 * filter.time_limit));
            assert!(!other.is_finished());
            drop(turn);
            other.join().unwrap().unwrap();
        });
        gpu.take_turn(place).unwrap().give_up(place);
        let error = run(&mut blur).unwrap_err().to_string();
        let expected = "not run, since pass work of other was given up";
        assert!(error.contains(expected), "{error}");
    }
}
