//! Choice and opening of the adapter that runs the filters.

use std::sync::{Mutex, RwLock};

use super::device::{AdapterDescription, Clock, Device, FEATURES, Gpu, LoopLimit, TIMESTAMPS};
use super::loop_probe::find_loop_limit;
use crate::{FilterError, Format};

/// Lists every adapter of this machine; index or name choose one in [`Gpu::new`].
pub fn list_adapters() -> Vec<AdapterDescription> {
    find_adapters().iter().map(describe).collect()
}

impl Gpu {
    /// Opens the adapter with that index in [`list_adapters`], or the first whose name contains the
    /// text (in any case). `None` chooses the first of the fastest kind: discrete, integrated,
    /// virtual, then software.
    pub fn new(adapter: Option<&str>) -> Result<Self, FilterError> {
        let adapters = find_adapters();
        if adapters.is_empty() {
            return Err(FilterError::NoAdapter);
        }
        let chosen = match adapter {
            None => adapters.iter().min_by_key(|adapter| rank(adapter)),
            Some(wanted) => choose(&adapters, wanted),
        };
        let chosen = chosen.ok_or_else(|| {
            let names = adapters.iter().enumerate();
            let names =
                names.map(|(index, candidate)| format!("{index}: {}", candidate.get_info().name));
            FilterError::Refused(format!(
                "no adapter is called \"{}\"; found: {}",
                adapter.unwrap_or_default(),
                names.collect::<Vec<_>>().join("; ")
            ))
        })?;
        let device = Device::open(chosen)?;
        let lanes = chosen.get_info().subgroup_max_size;
        let mut gpu = Self {
            adapter: describe(chosen),
            clock: if chosen.features().contains(TIMESTAMPS) {
                Clock::Timestamps
            } else {
                Clock::WallClock
            },
            loop_limit: None,
            stored_formats: list_stored_formats(chosen),
            packs_halves: (chosen.get_downlevel_capabilities().flags)
                .contains(wgpu::DownlevelFlags::SHADER_F16_IN_F32),
            interrupted: || false,
            opened: chosen.clone(),
            device: RwLock::new(device),
            given_up: Mutex::new(None),
        };
        gpu.loop_limit = find_loop_limit(&gpu)?.map(|iterations| LoopLimit { iterations, lanes });
        Ok(gpu)
    }
}

/// Lists the formats in which shaders can store textures.
fn list_stored_formats(adapter: &wgpu::Adapter) -> Vec<Format> {
    let features = adapter.features() & FEATURES;
    let is_open = features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);
    let is_stored = |format: &Format| {
        let granted = if is_open {
            adapter.get_texture_format_features(format.wgpu())
        } else {
            format.wgpu().guaranteed_format_features(features)
        };
        (granted.allowed_usages).contains(wgpu::TextureUsages::STORAGE_BINDING)
    };
    Format::ALL.iter().copied().filter(is_stored).collect()
}

fn find_adapters() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        // The driver's validation layers would print to the terminal what wgpu already reports.
        flags: wgpu::InstanceFlags::empty(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()))
}

fn choose<'a>(adapters: &'a [wgpu::Adapter], wanted: &str) -> Option<&'a wgpu::Adapter> {
    if let Ok(index) = wanted.parse::<usize>() {
        return adapters.get(index);
    }
    let wanted = wanted.to_lowercase();
    adapters
        .iter()
        .find(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted))
}

/// Kinds of devices by name, the fastest first.
const KINDS: [(wgpu::DeviceType, &str); 5] = [
    (wgpu::DeviceType::DiscreteGpu, "discrete"),
    (wgpu::DeviceType::IntegratedGpu, "integrated"),
    (wgpu::DeviceType::VirtualGpu, "virtual"),
    (wgpu::DeviceType::Cpu, "software"),
    (wgpu::DeviceType::Other, "other"),
];

fn rank(adapter: &wgpu::Adapter) -> usize {
    let device_type = adapter.get_info().device_type;
    let rank = KINDS.iter().position(|(kind, _)| *kind == device_type);
    rank.expect("every kind of device has a name")
}

fn describe(adapter: &wgpu::Adapter) -> AdapterDescription {
    let info = adapter.get_info();
    AdapterDescription {
        name: info.name,
        driver: [info.driver, info.driver_info].join(" ").trim().to_owned(),
        backend: info.backend.to_string(),
        kind: KINDS[rank(adapter)].1.to_owned(),
    }
}
