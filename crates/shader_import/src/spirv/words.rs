//! Instructions of a SPIR-V module, read from its words and written back.

use std::collections::{BTreeMap, BTreeSet};

use spirv::{Decoration, MAGIC_NUMBER, Op, StorageClass};

/// Group and binding of a resource.
pub(super) type Place = (u32, u32);

/// Upper limit on ids. The largest shaders of engines have a hundredth of it.
const MAX_IDS: u32 = 1 << 20;

/// Upper limit on branches, on types and on composite constants of a module, each: naga recurses if
/// they are nested.
const MAX_NESTABLE: usize = 10_000;

/// Storage class of textures and samplers.
pub(super) const UNIFORM_CONSTANT: u32 = StorageClass::UniformConstant as u32;

/// One instruction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Instruction {
    pub op: Op,
    /// The words after the first.
    pub operands: Vec<u32>,
}

impl Instruction {
    pub fn new(op: Op, operands: impl Into<Vec<u32>>) -> Self {
        Self {
            op,
            operands: operands.into(),
        }
    }

    /// Returns the first `COUNT` operands, if there are as many.
    pub fn first<const COUNT: usize>(&self) -> Option<[u32; COUNT]> {
        self.operands.get(..COUNT)?.try_into().ok()
    }
}

/// A SPIR-V module.
#[derive(Clone, Debug)]
pub(super) struct Words {
    version: u32,
    generator: u32,
    /// All ids are smaller.
    bound: u32,
    pub instructions: Vec<Instruction>,
}

impl Words {
    /// Reads a module. Fails if it is cut short or is no SPIR-V.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        if bytes.len() < 20 || !bytes.len().is_multiple_of(4) {
            return Err(format!(
                "{} bytes are no SPIR-V module, or it is cut short: a module has five words of four bytes, and more",
                bytes.len()
            ));
        }
        let words: Vec<u32> = (bytes.chunks_exact(4))
            .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
            .collect();
        if words[0] == MAGIC_NUMBER.swap_bytes() {
            return Err("the module is big-endian; allowed: little-endian SPIR-V".into());
        }
        if words[0] != MAGIC_NUMBER {
            return Err(format!(
                "begins with {:#010x}; allowed: SPIR-V, which begins with {MAGIC_NUMBER:#010x}",
                words[0]
            ));
        }
        if words[3] > MAX_IDS {
            return Err(format!(
                "has ids up to {}; allowed: at most {MAX_IDS}",
                words[3]
            ));
        }
        let mut instructions = Vec::new();
        let mut at = 5;
        while at < words.len() {
            let count = (words[at] >> 16) as usize;
            let end = at + count;
            if count == 0 || end > words.len() {
                return Err(format!(
                    "word {at}: an instruction of {count} words, where {} are left; the module is cut short or damaged",
                    words.len() - at
                ));
            }
            let opcode = words[at] & 0xffff;
            let op = Op::from_u32(opcode).ok_or_else(|| {
                format!("word {at}: {opcode} is no instruction of SPIR-V; the module is damaged")
            })?;
            instructions.push(Instruction::new(op, &words[at + 1..end]));
            at = end;
        }
        let read = Self {
            version: words[1],
            generator: words[2],
            bound: words[3],
            instructions,
        };
        read.check_nesting()?;
        Ok(read)
    }

    /// Refuses a module that may be nested too deeply for a stack.
    fn check_nesting(&self) -> Result<(), String> {
        for (what, ops) in [
            ("branches", [Op::LoopMerge, Op::SelectionMerge, Op::Switch]),
            ("types", [Op::TypeArray, Op::TypeStruct, Op::TypePointer]),
            (
                "composite constants",
                [
                    Op::ConstantComposite,
                    Op::SpecConstantComposite,
                    Op::SpecConstantOp,
                ],
            ),
        ] {
            let count = (self.instructions.iter())
                .filter(|instruction| ops.contains(&instruction.op))
                .count();
            if count > MAX_NESTABLE {
                return Err(format!(
                    "has {count} {what}; allowed: at most {MAX_NESTABLE}; divide the pass"
                ));
            }
        }
        Ok(())
    }

    /// Returns an unused id.
    pub fn new_id(&mut self) -> u32 {
        self.bound = self.bound.saturating_add(1);
        self.bound - 1
    }

    /// Lists the operands of all instructions of one kind that have at least `COUNT`.
    pub fn all<const COUNT: usize>(&self, op: Op) -> impl Iterator<Item = [u32; COUNT]> {
        (self.instructions.iter())
            .filter(move |instruction| instruction.op == op)
            .filter_map(Instruction::first)
    }

    /// Lists the ids with a decoration that has a value, each with the value.
    pub fn decorated(&self, decoration: Decoration) -> impl Iterator<Item = (u32, u32)> {
        (self.all(Op::Decorate))
            .filter(move |[_, kind, _]| *kind == decoration as u32)
            .map(|[id, _, value]| (id, value))
    }

    /// Replaces each instruction for which `replace` returns others.
    pub fn rewrite(
        &mut self,
        mut replace: impl FnMut(&mut Self, &Instruction) -> Option<Vec<Instruction>>,
    ) {
        let old = std::mem::take(&mut self.instructions);
        let mut rewritten = Vec::with_capacity(old.len());
        for instruction in old {
            match replace(self, &instruction) {
                Some(replaced) => rewritten.extend(replaced),
                None => rewritten.push(instruction),
            }
        }
        self.instructions = rewritten;
    }

    /// Finds the groups and bindings of variables.
    pub fn find_places(&self) -> BTreeMap<u32, Place> {
        let mut places = BTreeMap::<u32, Place>::new();
        for (variable, group) in self.decorated(Decoration::DescriptorSet) {
            places.entry(variable).or_default().0 = group;
        }
        for (variable, binding) in self.decorated(Decoration::Binding) {
            places.entry(variable).or_default().1 = binding;
        }
        places
    }

    /// Finds the names of ids (`Op::Name`, one word), or of members by struct and index
    /// (`Op::MemberName`, two words).
    pub fn find_names<const COUNT: usize>(&self, op: Op) -> BTreeMap<[u32; COUNT], String> {
        let named = self
            .instructions
            .iter()
            .filter(|instruction| instruction.op == op);
        let named = named.filter_map(|instruction| instruction.operands.split_first_chunk());
        let named = named.map(|(id, name)| (*id, read_text(name)));
        named.filter(|(_, name)| !name.is_empty()).collect()
    }

    /// Finds a binding for each of these variables that no other has, in the same group.
    pub fn find_free_places(&self, variables: &[u32]) -> BTreeMap<u32, Place> {
        let places = self.find_places();
        let mut used: BTreeSet<Place> = places.values().copied().collect();
        let mut free = BTreeMap::new();
        for variable in variables {
            let Some((group, _)) = places.get(variable) else {
                continue;
            };
            let mut bindings = (0..).filter(|binding| !used.contains(&(*group, *binding)));
            let place = (*group, bindings.next().expect("few numbers are used"));
            used.insert(place);
            free.insert(*variable, place);
        }
        free
    }

    /// Writes the module.
    pub fn write(&self) -> Vec<u8> {
        let mut words = vec![MAGIC_NUMBER, self.version, self.generator, self.bound, 0];
        for Instruction { op, operands } in &self.instructions {
            words.push((operands.len() as u32 + 1) << 16 | *op as u32);
            words.extend(operands);
        }
        words.into_iter().flat_map(u32::to_le_bytes).collect()
    }
}

/// Reads a text that ends with a zero.
fn read_text(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let bytes: Vec<u8> = bytes.take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damaged_modules_are_refused() {
        let module = |words: &[u32]| -> Vec<u8> {
            words.iter().flat_map(|word| word.to_le_bytes()).collect()
        };
        for (bytes, says) in [
            (
                module(&[MAGIC_NUMBER.swap_bytes(), 2, 3, 4, 5]),
                "big-endian",
            ),
            (module(&[MAGIC_NUMBER, 2, 3, 4, 5, 3 << 16, 1]), "word 5"),
            (module(&[MAGIC_NUMBER, 2, 3, 4, 5, 17]), "of 0 words"),
            (
                module(&[MAGIC_NUMBER, 2, 3, 4, 5, 1 << 16 | 999]),
                "999 is no instruction",
            ),
            (module(&[MAGIC_NUMBER, 2, 3, u32::MAX, 5]), "has ids up to"),
        ] {
            let refusal = Words::read(&bytes).unwrap_err();
            assert!(refusal.contains(says), "{refusal}");
        }
    }
}
