//! Branches of a SPIR-V module, and marks by which they are found again in what naga makes of it.

use std::collections::{BTreeMap, BTreeSet};

use spirv::{Op, StorageClass};

use super::words::{Instruction, Words};

/// Where control goes after a block.
#[derive(Debug, PartialEq)]
pub(super) enum Exit {
    To(u32),
    /// By a condition.
    Either {
        accept: u32,
        reject: u32,
    },
    /// By a number.
    Choice {
        cases: Vec<(i32, u32)>,
        default: u32,
    },
    /// Out of the function.
    Return,
    Kill,
    /// Nowhere: no input leads here.
    Unreachable,
}

/// A function, by the labels of its blocks.
pub(super) struct Branches {
    /// Its id.
    pub function: u32,
    first: Option<u32>,
    pub exits: BTreeMap<u32, Exit>,
}

impl Branches {
    /// Lists the branches of each function.
    pub fn list(words: &Words) -> Vec<Self> {
        let mut functions: Vec<Self> = Vec::new();
        let mut label = 0;
        for instruction in &words.instructions {
            match (instruction.op, &instruction.operands[..]) {
                (Op::Function, [_, function, ..]) => functions.push(Self {
                    function: *function,
                    first: None,
                    exits: BTreeMap::new(),
                }),
                (Op::Label, [block]) => label = *block,
                _ => {}
            }
            if let (Some(exit), Some(function)) = (read_exit(instruction), functions.last_mut()) {
                function.first.get_or_insert(label);
                function.exits.insert(label, exit);
            }
        }
        functions
    }

    /// Lists the blocks that control may reach.
    pub fn list_reached(&self) -> BTreeSet<u32> {
        let mut reached = BTreeSet::new();
        let mut waiting: Vec<u32> = self.first.into_iter().collect();
        while let Some(block) = waiting.pop() {
            if !reached.insert(block) {
                continue;
            }
            match self.exits.get(&block) {
                Some(Exit::To(next)) => waiting.push(*next),
                Some(Exit::Either { accept, reject }) => waiting.extend([accept, reject]),
                Some(Exit::Choice { cases, default }) => {
                    waiting.extend(cases.iter().map(|(_, next)| *next).chain([*default]));
                }
                _ => {}
            }
        }
        reached
    }
}

/// Reads where an instruction that ends a block leads; none for any other.
fn read_exit(instruction: &Instruction) -> Option<Exit> {
    Some(match (instruction.op, &instruction.operands[..]) {
        (Op::Branch, [next]) => Exit::To(*next),
        (Op::BranchConditional, [_, accept, reject, ..]) => Exit::Either {
            accept: *accept,
            reject: *reject,
        },
        (Op::Switch, [_, default, cases @ ..]) => Exit::Choice {
            default: *default,
            cases: (cases.chunks_exact(2))
                .map(|case| (case[0] as i32, case[1]))
                .collect(),
        },
        (Op::Return | Op::ReturnValue, _) => Exit::Return,
        (Op::Kill, _) => Exit::Kill,
        (Op::Unreachable, _) => Exit::Unreachable,
        _ => return None,
    })
}

/// Leaves out the numbers of a `switch` that lead where all others do. naga takes the first of them
/// for the next case.
pub(super) fn drop_default_cases(words: &mut Words) {
    for instruction in &mut words.instructions {
        if let (Op::Switch, [_, default, ..]) = (instruction.op, &instruction.operands[..]) {
            let default = *default;
            let (head, cases) = instruction.operands.split_at(2);
            let kept = cases.chunks(2).filter(|case| case.get(1) != Some(&default));
            instruction.operands = [head].into_iter().chain(kept).flatten().copied().collect();
        }
    }
}

/// Makes every block store its label in a private variable, the last that the module declares.
pub(super) fn mark_blocks(words: &mut Words) {
    let unsigned = (words.all(Op::TypeInt)).find(|[_, width, signed]| [*width, *signed] == [32, 0]);
    let number = unsigned.map_or_else(|| words.new_id(), |[id, ..]| id);
    let (pointer, variable) = (words.new_id(), words.new_id());
    let class = StorageClass::Private as u32;
    let labels: Vec<u32> = words.all(Op::Label).map(|[label]| label).collect();
    let marks: BTreeMap<u32, u32> = (labels.into_iter())
        .map(|label| (label, words.new_id()))
        .collect();
    let ty = Instruction::new(Op::TypeInt, [number, 32, 0]);
    let constants =
        (marks.iter()).map(|(label, id)| Instruction::new(Op::Constant, [number, *id, *label]));
    let declared = (unsigned.is_none().then_some(ty).into_iter())
        .chain(constants)
        .chain([
            Instruction::new(Op::TypePointer, [pointer, class, number]),
            Instruction::new(Op::Variable, [pointer, variable, class]),
        ]);
    let mut declared: Vec<Instruction> = declared.collect();
    let (mut label, mut after_merge) = (0, false);
    words.rewrite(|_, instruction| {
        let is_merge = matches!(instruction.op, Op::SelectionMerge | Op::LoopMerge);
        let is_marked = std::mem::replace(&mut after_merge, is_merge);
        let before = match (instruction.op, &instruction.operands[..]) {
            (Op::Function, _) => std::mem::take(&mut declared),
            (Op::Label, [block]) => {
                label = *block;
                return None;
            }
            _ if is_merge || (!is_marked && read_exit(instruction).is_some()) => {
                vec![Instruction::new(Op::Store, [variable, marks[&label]])]
            }
            _ => return None,
        };
        Some(before.into_iter().chain([instruction.clone()]).collect())
    });
}
