//! Instructions of a SPIR-V module, read from its words and written back.

use std::collections::{BTreeMap, BTreeSet};

/// Group and binding of a resource.
pub(super) type Place = (u32, u32);

/// The first word of every module.
const MAGIC: u32 = 0x0723_0203;

/// Upper limit on ids. The largest shaders of engines have a hundredth of it.
const MAX_IDS: u32 = 1 << 20;

/// Upper limit on branches, on types and on composite constants of a module, each: naga recurses where they lie within one another.
const MAX_NESTABLE: usize = 10_000;

/// Opcodes that the passes over a module look at.
pub(super) mod op {
    pub const NAME: u32 = 5;
    pub const MEMBER_NAME: u32 = 6;
    pub const EXECUTION_MODE: u32 = 16;
    pub const CAPABILITY: u32 = 17;
    pub const TYPE_BOOL: u32 = 20;
    pub const TYPE_INT: u32 = 21;
    pub const TYPE_FLOAT: u32 = 22;
    pub const TYPE_IMAGE: u32 = 25;
    pub const TYPE_SAMPLER: u32 = 26;
    pub const TYPE_SAMPLED_IMAGE: u32 = 27;
    pub const TYPE_ARRAY: u32 = 28;
    pub const TYPE_RUNTIME_ARRAY: u32 = 29;
    pub const TYPE_STRUCT: u32 = 30;
    pub const TYPE_POINTER: u32 = 32;
    pub const TYPE_FUNCTION: u32 = 33;
    pub const CONSTANT_TRUE: u32 = 41;
    pub const CONSTANT_FALSE: u32 = 42;
    pub const CONSTANT: u32 = 43;
    pub const CONSTANT_COMPOSITE: u32 = 44;
    pub const SPEC_CONSTANT_TRUE: u32 = 48;
    pub const SPEC_CONSTANT_FALSE: u32 = 49;
    pub const SPEC_CONSTANT: u32 = 50;
    pub const SPEC_CONSTANT_COMPOSITE: u32 = 51;
    pub const SPEC_CONSTANT_OP: u32 = 52;
    pub const FUNCTION: u32 = 54;
    pub const FUNCTION_PARAMETER: u32 = 55;
    pub const FUNCTION_CALL: u32 = 57;
    pub const VARIABLE: u32 = 59;
    pub const IMAGE_TEXEL_POINTER: u32 = 60;
    pub const LOAD: u32 = 61;
    pub const STORE: u32 = 62;
    pub const COPY_MEMORY: u32 = 63;
    pub const ACCESS_CHAIN: u32 = 65;
    pub const PTR_ACCESS_CHAIN: u32 = 67;
    pub const ARRAY_LENGTH: u32 = 68;
    pub const IN_BOUNDS_PTR_ACCESS_CHAIN: u32 = 70;
    pub const DECORATE: u32 = 71;
    pub const MEMBER_DECORATE: u32 = 72;
    pub const COMPOSITE_EXTRACT: u32 = 81;
    pub const COPY_OBJECT: u32 = 83;
    pub const SAMPLED_IMAGE: u32 = 86;
    pub const IMAGE_FETCH: u32 = 95;
    pub const IMAGE_READ: u32 = 98;
    pub const IMAGE_WRITE: u32 = 99;
    pub const IMAGE_QUERY_SIZE_LOD: u32 = 103;
    pub const IMAGE_QUERY_SIZE: u32 = 104;
    pub const IMAGE_QUERY_SAMPLES: u32 = 107;
    pub const U_CONVERT: u32 = 113;
    pub const S_CONVERT: u32 = 114;
    pub const BITCAST: u32 = 124;
    pub const S_NEGATE: u32 = 126;
    pub const I_ADD: u32 = 128;
    pub const I_SUB: u32 = 130;
    pub const I_MUL: u32 = 132;
    pub const U_DIV: u32 = 134;
    pub const S_DIV: u32 = 135;
    pub const U_MOD: u32 = 137;
    pub const S_REM: u32 = 138;
    pub const S_MOD: u32 = 139;
    pub const LOGICAL_EQUAL: u32 = 164;
    pub const LOGICAL_NOT_EQUAL: u32 = 165;
    pub const LOGICAL_OR: u32 = 166;
    pub const LOGICAL_AND: u32 = 167;
    pub const LOGICAL_NOT: u32 = 168;
    pub const SELECT: u32 = 169;
    pub const I_EQUAL: u32 = 170;
    pub const I_NOT_EQUAL: u32 = 171;
    pub const U_GREATER_THAN: u32 = 172;
    pub const S_GREATER_THAN: u32 = 173;
    pub const U_GREATER_THAN_EQUAL: u32 = 174;
    pub const S_GREATER_THAN_EQUAL: u32 = 175;
    pub const U_LESS_THAN: u32 = 176;
    pub const S_LESS_THAN: u32 = 177;
    pub const U_LESS_THAN_EQUAL: u32 = 178;
    pub const S_LESS_THAN_EQUAL: u32 = 179;
    pub const SHIFT_RIGHT_LOGICAL: u32 = 194;
    pub const SHIFT_RIGHT_ARITHMETIC: u32 = 195;
    pub const SHIFT_LEFT_LOGICAL: u32 = 196;
    pub const BITWISE_OR: u32 = 197;
    pub const BITWISE_XOR: u32 = 198;
    pub const BITWISE_AND: u32 = 199;
    pub const NOT: u32 = 200;
    pub const PHI: u32 = 245;
    pub const LOOP_MERGE: u32 = 246;
    pub const SELECTION_MERGE: u32 = 247;
    pub const SWITCH: u32 = 251;
    pub const RETURN_VALUE: u32 = 254;
}

/// Decorations that the passes look at.
pub(super) mod decoration {
    pub const SPEC_ID: u32 = 1;
    pub const ROW_MAJOR: u32 = 4;
    pub const COL_MAJOR: u32 = 5;
    pub const BUILT_IN: u32 = 11;
    pub const NON_WRITABLE: u32 = 24;
    pub const NON_READABLE: u32 = 25;
    pub const BINDING: u32 = 33;
    pub const DESCRIPTOR_SET: u32 = 34;
    pub const OFFSET: u32 = 35;
}

/// Storage class of textures and samplers.
pub(super) const UNIFORM_CONSTANT: u32 = 0;

/// One instruction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Instruction {
    pub opcode: u32,
    /// The words after the first.
    pub operands: Vec<u32>,
}

impl Instruction {
    pub fn new(opcode: u32, operands: impl Into<Vec<u32>>) -> Self {
        Self {
            opcode,
            operands: operands.into(),
        }
    }

    /// Returns the operands if they begin with as many as asked for.
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
        if words[0] == MAGIC.swap_bytes() {
            return Err("the module is big-endian; allowed: little-endian SPIR-V".into());
        }
        if words[0] != MAGIC {
            return Err(format!(
                "begins with {:#010x}; allowed: SPIR-V, which begins with {MAGIC:#010x}",
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
            instructions.push(Instruction::new(opcode, &words[at + 1..end]));
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

    /// Refuses a module that may be nested deeper than a stack.
    fn check_nesting(&self) -> Result<(), String> {
        for (what, opcodes) in [
            (
                "branches",
                [op::LOOP_MERGE, op::SELECTION_MERGE, op::SWITCH],
            ),
            ("types", [op::TYPE_ARRAY, op::TYPE_STRUCT, op::TYPE_POINTER]),
            (
                "composite constants",
                [
                    op::CONSTANT_COMPOSITE,
                    op::SPEC_CONSTANT_COMPOSITE,
                    op::SPEC_CONSTANT_OP,
                ],
            ),
        ] {
            let opcodes = |instruction: &&Instruction| opcodes.contains(&instruction.opcode);
            let found = self.instructions.iter().filter(opcodes).count();
            if found > MAX_NESTABLE {
                return Err(format!(
                    "has {found} {what}; allowed: at most {MAX_NESTABLE}; divide the pass"
                ));
            }
        }
        Ok(())
    }

    /// Returns an id that nothing has.
    pub fn new_id(&mut self) -> u32 {
        self.bound = self.bound.saturating_add(1);
        self.bound - 1
    }

    /// Lists the operands of all instructions of one kind that have at least `COUNT`.
    pub fn all<const COUNT: usize>(&self, opcode: u32) -> impl Iterator<Item = [u32; COUNT]> {
        (self.instructions.iter())
            .filter(move |instruction| instruction.opcode == opcode)
            .filter_map(Instruction::first)
    }

    /// Finds the groups and bindings of variables.
    pub fn find_places(&self) -> BTreeMap<u32, Place> {
        let mut places = BTreeMap::<u32, Place>::new();
        for [target, kind, value] in self.all(op::DECORATE) {
            match kind {
                decoration::DESCRIPTOR_SET => places.entry(target).or_default().0 = value,
                decoration::BINDING => places.entry(target).or_default().1 = value,
                _ => {}
            }
        }
        places
    }

    /// Finds the names of ids.
    pub fn find_names(&self) -> BTreeMap<u32, String> {
        let named = self.instructions.iter().filter(|it| it.opcode == op::NAME);
        let named = named.filter_map(|it| it.operands.split_first());
        named.map(|(id, name)| (*id, read_text(name))).collect()
    }

    /// Finds the names of members, by struct and index.
    pub fn find_member_names(&self) -> BTreeMap<[u32; 2], String> {
        let named = (self.instructions.iter()).filter(|it| it.opcode == op::MEMBER_NAME);
        let named = named.filter_map(|it| it.operands.split_first_chunk());
        named
            .map(|(member, name)| (*member, read_text(name)))
            .collect()
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
        let header = [MAGIC, self.version, self.generator, self.bound, 0];
        let instructions = self.instructions.iter().flat_map(|instruction| {
            let count = instruction.operands.len() as u32 + 1;
            let first = count << 16 | instruction.opcode;
            [first]
                .into_iter()
                .chain(instruction.operands.iter().copied())
        });
        let words = header.into_iter().chain(instructions);
        words.flat_map(u32::to_le_bytes).collect()
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
    fn a_module_is_written_as_it_was_read() {
        let words = [MAGIC, 0x1_0300, 7, 9, 0, 2 << 16 | 17, 1, 1 << 16 | 56];
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let read = Words::read(&bytes).unwrap();
        assert_eq!(read.instructions.len(), 2);
        assert_eq!(read.write(), bytes);
    }

    #[test]
    fn damaged_modules_are_refused() {
        let module = |words: &[u32]| -> Vec<u8> {
            words.iter().flat_map(|word| word.to_le_bytes()).collect()
        };
        for (bytes, says) in [
            (vec![3, 2, 35], "cut short"),
            (module(&[1, 2, 3, 4, 5]), "begins with"),
            (module(&[MAGIC.swap_bytes(), 2, 3, 4, 5]), "big-endian"),
            (module(&[MAGIC, 2, 3, 4, 5, 3 << 16, 1]), "word 5"),
            (module(&[MAGIC, 2, 3, 4, 5, 17]), "of 0 words"),
            (module(&[MAGIC, 2, 3, u32::MAX, 5]), "has ids up to"),
        ] {
            let refusal = Words::read(&bytes).unwrap_err();
            assert!(refusal.contains(says), "{refusal}");
        }
    }
}
