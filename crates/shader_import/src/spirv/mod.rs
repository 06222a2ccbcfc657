//! SPIR-V, changed so that naga reads it, and read by naga.

mod branches;
mod combined_samplers;
mod constants;
mod control_flow;
mod fall_through;
mod flow_reader;
mod matrices;
mod next_block;
mod storage_images;
mod words;

pub use constants::refuse_missing;
pub use fall_through::falls_through_wrongly;

use naga::{ResourceBinding, StorageFormat, front};

use crate::language::Language;
use crate::naga_error::{explain, tidy};
use crate::open_module::OpenModule;
use branches::drop_default_cases;
use combined_samplers::split_combined_samplers;
use constants::set_constants;
use control_flow::check_control_flow;
use fall_through::settle_fall_through;
use matrices::find_by_rows;
use storage_images::StorageImages;
use words::{Place, Words};

/// Finds the format in which filter.toml has the storage texture at a place and with a name.
pub type FindFormat<'a> = dyn Fn(ResourceBinding, &str) -> Option<StorageFormat> + 'a;

/// Reads SPIR-V that a compiler of `language` made. `constants` are values of specialisation
/// constants, by name or number.
pub fn read(
    compiled: &[u8],
    language: Language,
    is_vertex: bool,
    constants: &[(String, f64)],
    find_format: &FindFormat,
) -> Result<OpenModule, String> {
    let mut words = Words::read(compiled)?;
    set_constants(&mut words, constants, is_vertex)?;
    let by_rows = find_by_rows(&words, language);
    let mut owners = split_combined_samplers(&mut words)?;
    let images = StorageImages::prepare(&mut words);
    let is_hlsl = matches!(language, Language::Hlsl | Language::Slang);
    let options = front::spv::Options {
        // Clip space of Vulkan has +y down, HLSL's and Slang's up.
        adjust_coordinate_space: is_vertex && !is_hlsl,
        ..front::spv::Options::default()
    };
    drop_default_cases(&mut words);
    let module = front::spv::parse_u8_slice(&words.write(), &options);
    let mut module = module.map_err(|error| {
        format!(
            "its SPIR-V cannot be read: {}; allowed: the SPIR-V of Vulkan 1.1 shaders without extensions",
            tidy(&explain(&error))
        )
    })?;
    check_control_flow(&words, &options)?;
    settle_fall_through(&mut module);
    let bound = |(group, binding): Place| ResourceBinding { group, binding };
    images.narrow(&mut module, |place, name, is_open| {
        find_format(bound(place), name).filter(|_| is_hlsl || is_open)
    });
    owners.extend(images.owners);
    let owners = owners.into_iter();
    Ok(OpenModule {
        module,
        owners: (owners.map(|(split, owner)| (bound(split), bound(owner)))).collect(),
        by_rows,
    })
}
