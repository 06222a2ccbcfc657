//! The adapter of a run, in words.

use filters::AdapterDescription;

/// Names the adapter that kernels ran on: `llvmpipe (LLVM 19), vulkan`.
pub fn adapter_text(adapter: &Option<AdapterDescription>) -> String {
    match adapter {
        Some(adapter) => format!("{}, {}", adapter.name, adapter.backend),
        None => "none, every filter is a command".to_owned(),
    }
}
