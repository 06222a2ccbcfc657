//! Check that naga keeps the control flow of a SPIR-V module.
//!
//! naga turns branches into `if`, `switch` and `loop`. A branch that leaves several of these at
//! once, such as one out of a `switch` to the end of the loop around it, becomes a `break` of the
//! innermost (<https://github.com/gfx-rs/wgpu/issues/4449>). So each block gets a mark, and where
//! control goes from one mark to the next must be the same on both sides.

use std::collections::BTreeMap;

use naga::{AddressSpace, front};
use spirv::Op;

use super::branches::{Branches, mark_blocks};
use super::flow_reader::Reader;
use super::next_block::Next;
use super::words::Words;

/// Refuses a module in whose translation a branch leads to another place.
pub(super) fn check_control_flow(
    words: &Words,
    options: &front::spv::Options,
) -> Result<(), String> {
    let mut marked = words.clone();
    mark_blocks(&mut marked);
    let module = front::spv::parse_u8_slice(&marked.write(), options)
        .map_err(|error| format!("its control flow cannot be checked: {error}"))?;
    let variables = module.global_variables.iter();
    let mut private = variables.filter(|(_, variable)| variable.space == AddressSpace::Private);
    let Some((mark, _)) = private.next_back() else {
        return Ok(());
    };
    let mut marks = BTreeMap::new();
    for (_, function) in module.functions.iter() {
        Reader::new(&module, function, mark).list_marks(&mut marks);
    }
    for branches in Branches::list(words) {
        let reached = branches.list_reached();
        let keeps = |block: &u32| {
            let nexts: Option<&Vec<Next>> = marks.get(block);
            nexts.is_some_and(|nexts| nexts.iter().all(|next| next.is(&branches.exits[block])))
        };
        if !(reached.iter()).all(|block| branches.exits.contains_key(block) && keeps(block)) {
            return Err(refuse(words, branches.function));
        }
    }
    Ok(())
}

fn refuse(words: &Words, function: u32) -> String {
    let names = words.find_names::<1>(Op::Name);
    let name = names.get(&[function]).map_or("", |name| &name[..]);
    let name = name.split('(').next().unwrap_or_default();
    let place = if name.is_empty() {
        "one of its functions".to_owned()
    } else {
        format!("its function \"{name}\"")
    };
    format!(
        "naga, which translates it, changes the control flow of {place}: a branch leads to another place there, as from a `switch` to \
         the end of the loop around it; compile it without optimisation, or write the function without `return` in a `switch` in a \
         loop and without `case`s that fall through to `default`"
    )
}
