//! Specialisation constants of SPIR-V, replaced by constants with the values of filter.toml.
//!
//! naga reads neither `OpSpecConstantOp`, which compilers make of arithmetic on them, nor sizes of
//! workgroups that depend on them.

use std::collections::{BTreeMap, BTreeSet};

use spirv::{BuiltIn, Decoration, ExecutionMode, Op};

use super::words::{Instruction, Words};

/// Type of a constant of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scalar {
    Bool,
    Signed,
    Unsigned,
    Float,
}

/// Value of a constant: the bits of a scalar, where true is 1, or the ids of components.
#[derive(Clone, Debug, PartialEq)]
enum Value {
    Scalar(u32),
    Composite(Vec<u32>),
}

/// Constants of a module, found so far.
struct Constants<'a> {
    types: BTreeMap<u32, Scalar>,
    values: BTreeMap<u32, Value>,
    /// Names and numbers of specialisation constants, by id.
    called: BTreeMap<u32, [Option<String>; 2]>,
    given: &'a [(String, f64)],
}

/// Sets the constants that are `given` by name or number, and computes all that depend on them.
/// Fails for a missing one, unless `may_miss`.
pub(super) fn set_constants(
    words: &mut Words,
    given: &[(String, f64)],
    may_miss: bool,
) -> Result<(), String> {
    let mut constants = Constants {
        types: list_types(words),
        values: BTreeMap::new(),
        called: list_names(words),
        given,
    };
    let names = constants.called.values().flatten().flatten();
    let names: BTreeSet<&String> = names.collect();
    let missing = given.iter().find(|(name, _)| !names.contains(name));
    if let Some((missing, _)) = missing.filter(|_| !may_miss) {
        let known = (constants.called.values())
            .filter_map(|[name, number]| name.clone().or(number.clone()));
        return Err(refuse_missing(missing, &known.collect::<Vec<_>>()));
    }
    for instruction in &mut words.instructions {
        if let Some(replaced) = constants.replace(instruction)? {
            *instruction = replaced;
        }
    }
    size_workgroups(words, &constants.values);
    let number = Decoration::SpecId as u32;
    (words.instructions).retain(|instruction| {
        instruction.op != Op::Decorate || instruction.operands.get(1) != Some(&number)
    });
    Ok(())
}

fn list_types(words: &Words) -> BTreeMap<u32, Scalar> {
    let bools = words.all(Op::TypeBool).map(|[id]| (id, Scalar::Bool));
    let floats = (words.all(Op::TypeFloat)).filter(|[_, width]| *width == 32);
    let integers = (words.all(Op::TypeInt)).filter(|[_, width, _]| *width == 32);
    let integers = integers.map(|[id, _, signed]| match signed {
        0 => (id, Scalar::Unsigned),
        _ => (id, Scalar::Signed),
    });
    bools
        .chain(floats.map(|[id, _]| (id, Scalar::Float)))
        .chain(integers)
        .collect()
}

/// Lists the names and numbers of specialisation constants.
fn list_names(words: &Words) -> BTreeMap<u32, [Option<String>; 2]> {
    let names = words.find_names(Op::Name);
    (words.decorated(Decoration::SpecId))
        .map(|(id, number)| (id, [names.get(&[id]).cloned(), Some(number.to_string())]))
        .collect()
}

/// Gives entry points the size of workgroups that a constant has.
fn size_workgroups(words: &mut Words, values: &BTreeMap<u32, Value>) {
    let mut built_in = words.decorated(Decoration::BuiltIn);
    let size = built_in.find(|(_, kind)| *kind == BuiltIn::WorkgroupSize as u32);
    let Some(Value::Composite(sides)) = size.and_then(|(id, _)| values.get(&id)) else {
        return;
    };
    let sides: Vec<u32> = (sides.iter())
        .filter_map(|side| match values.get(side) {
            Some(Value::Scalar(side)) => Some(*side),
            _ => None,
        })
        .collect();
    drop(built_in);
    for instruction in &mut words.instructions {
        if let (Op::ExecutionMode, [_, mode, size @ ..]) =
            (instruction.op, &mut instruction.operands[..])
            && *mode == ExecutionMode::LocalSize as u32
            && size.len() == sides.len()
        {
            size.copy_from_slice(&sides);
        }
    }
}

/// Replaces the bits of an infinite float, which naga refuses, by those of the largest with its
/// sign.
fn make_finite(bits: u32) -> u32 {
    let number = f32::from_bits(bits);
    if number.is_infinite() {
        f32::MAX.copysign(number).to_bits()
    } else {
        bits
    }
}

impl Constants<'_> {
    /// Remembers a constant, and returns what a specialisation constant is replaced by.
    fn replace(&mut self, instruction: &Instruction) -> Result<Option<Instruction>, String> {
        let (op, operands) = (instruction.op, &instruction.operands[..]);
        let [ty, id, rest @ ..] = operands else {
            return Ok(None);
        };
        let scalar = self.types.get(ty).copied();
        let default = match (op, rest) {
            (Op::ConstantTrue | Op::SpecConstantTrue, []) => Value::Scalar(1),
            (Op::ConstantFalse | Op::SpecConstantFalse, []) => Value::Scalar(0),
            (Op::Constant | Op::SpecConstant, [bits]) if scalar.is_some() => Value::Scalar(*bits),
            // A number of another width keeps its value.
            (Op::SpecConstant, _) => {
                return match self.find_given(*id) {
                    None => Ok(Some(Instruction::new(Op::Constant, operands))),
                    Some((name, _)) => Err(format!(
                        "specialisation constant \"{name}\" is not a 32-bit value; allowed: bool, int, uint and float"
                    )),
                };
            }
            (Op::ConstantComposite | Op::SpecConstantComposite, parts) => {
                Value::Composite(parts.to_vec())
            }
            (Op::SpecConstantOp, [operation, operands @ ..]) => {
                let op = Op::from_u32(*operation).unwrap_or(Op::Nop);
                self.compute(op, operands, scalar)?
            }
            _ => return Ok(None),
        };
        let value = match (scalar, self.find_given(*id)) {
            (Some(scalar), Some((name, given))) => Value::Scalar(encode(scalar, name, given)?),
            _ => default,
        };
        let replaced = match (&value, scalar) {
            (Value::Scalar(0), Some(Scalar::Bool)) => {
                Instruction::new(Op::ConstantFalse, [*ty, *id])
            }
            (Value::Scalar(_), Some(Scalar::Bool)) => {
                Instruction::new(Op::ConstantTrue, [*ty, *id])
            }
            (Value::Scalar(bits), Some(Scalar::Float)) => {
                Instruction::new(Op::Constant, [*ty, *id, make_finite(*bits)])
            }
            (Value::Scalar(bits), _) => Instruction::new(Op::Constant, [*ty, *id, *bits]),
            (Value::Composite(parts), _) => {
                let operands = [*ty, *id].into_iter().chain(parts.iter().copied());
                Instruction::new(Op::ConstantComposite, operands.collect::<Vec<u32>>())
            }
        };
        self.values.insert(*id, value);
        Ok(Some(replaced))
    }

    /// Finds the value that is given for a specialisation constant.
    fn find_given(&self, id: u32) -> Option<(&str, f64)> {
        let names = self.called.get(&id)?;
        let is_own = |name: &str| names.iter().flatten().any(|alias| alias == name);
        let given = self.given.iter().find(|(name, _)| is_own(name));
        given.map(|(name, value)| (&name[..], *value))
    }

    /// Computes a constant that is made of others.
    fn compute(
        &self,
        operation: Op,
        operands: &[u32],
        result: Option<Scalar>,
    ) -> Result<Value, String> {
        let find = |id: &u32| self.values.get(id);
        let scalar = |id: &u32| match find(id) {
            Some(Value::Scalar(bits)) => Some(*bits),
            _ => None,
        };
        let computed = match (operation, operands) {
            (Op::CompositeExtract, [composite, index]) => match find(composite) {
                Some(Value::Composite(parts)) => parts.get(*index as usize).and_then(find).cloned(),
                _ => None,
            },
            _ => (operands.iter().map(scalar).collect::<Option<Vec<u32>>>())
                .filter(|_| result.is_some())
                .and_then(|operands| compute(operation, &operands))
                .map(Value::Scalar),
        };
        computed.ok_or_else(|| {
            format!(
                "computes a constant by {operation:?} from others; allowed: arithmetic, comparisons and choices of single \
                 numbers of 32 bits"
            )
        })
    }
}

/// Says which constants there are.
pub fn refuse_missing(missing: &str, known: &[String]) -> String {
    format!(
        "has no specialisation constant \"{missing}\", which filter.toml sets; it has: {}",
        if known.is_empty() {
            "none".to_owned()
        } else {
            known.join(", ")
        }
    )
}

/// Encodes a number as a constant; whole ones are rounded to the nearest.
fn encode(scalar: Scalar, name: &str, value: f64) -> Result<u32, String> {
    let (low, high) = match scalar {
        Scalar::Bool => return Ok(u32::from(value != 0.0)),
        Scalar::Float => (f64::from(f32::MIN), f64::from(f32::MAX)),
        Scalar::Signed => (f64::from(i32::MIN), f64::from(i32::MAX)),
        Scalar::Unsigned => (0.0, f64::from(u32::MAX)),
    };
    let rounded = match scalar {
        Scalar::Float => value,
        _ => value.round(),
    };
    if !(low..=high).contains(&rounded) {
        return Err(format!(
            "specialisation constants: {name} = {value} does not fit; allowed: from {low} to {high}"
        ));
    }
    Ok(match scalar {
        Scalar::Float => (rounded as f32).to_bits(),
        Scalar::Signed => rounded as i32 as u32,
        _ => rounded as u32,
    })
}

/// Computes an operation on numbers of 32 bits; none for one that is unknown, or that divides by
/// zero.
fn compute(operation: Op, operands: &[u32]) -> Option<u32> {
    let truth = |is: bool| Some(u32::from(is));
    let (a, b) = match *operands {
        [a] => {
            return match operation {
                Op::SNegate => Some(a.wrapping_neg()),
                Op::Not => Some(!a),
                Op::LogicalNot => truth(a == 0),
                Op::UConvert | Op::SConvert | Op::Bitcast => Some(a),
                _ => None,
            };
        }
        [a, b] => (a, b),
        [condition, yes, no] if operation == Op::Select => {
            return Some(if condition != 0 { yes } else { no });
        }
        _ => return None,
    };
    let (signed_a, signed_b) = (a as i32, b as i32);
    match operation {
        Op::IAdd => Some(a.wrapping_add(b)),
        Op::ISub => Some(a.wrapping_sub(b)),
        Op::IMul => Some(a.wrapping_mul(b)),
        Op::UDiv => a.checked_div(b),
        Op::SDiv => signed_a
            .checked_div(signed_b)
            .map(|quotient| quotient as u32),
        Op::UMod => a.checked_rem(b),
        Op::SRem => signed_a.checked_rem(signed_b).map(|rest| rest as u32),
        // The result has the sign of the divisor.
        Op::SMod => {
            let rest = signed_a.checked_rem(signed_b)?;
            let is_other = rest != 0 && (rest < 0) != (signed_b < 0);
            Some(rest.wrapping_add(if is_other { signed_b } else { 0 }) as u32)
        }
        Op::ShiftRightLogical => a.checked_shr(b),
        Op::ShiftRightArithmetic => signed_a.checked_shr(b).map(|shifted| shifted as u32),
        Op::ShiftLeftLogical => a.checked_shl(b),
        Op::BitwiseOr => Some(a | b),
        Op::BitwiseXor => Some(a ^ b),
        Op::BitwiseAnd => Some(a & b),
        Op::LogicalOr => truth(a != 0 || b != 0),
        Op::LogicalAnd => truth(a != 0 && b != 0),
        Op::LogicalEqual | Op::IEqual => truth(a == b),
        Op::LogicalNotEqual | Op::INotEqual => truth(a != b),
        Op::UGreaterThan => truth(a > b),
        Op::SGreaterThan => truth(signed_a > signed_b),
        Op::UGreaterThanEqual => truth(a >= b),
        Op::SGreaterThanEqual => truth(signed_a >= signed_b),
        Op::ULessThan => truth(a < b),
        Op::SLessThan => truth(signed_a < signed_b),
        Op::ULessThanEqual => truth(a <= b),
        Op::SLessThanEqual => truth(signed_a <= signed_b),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_computed_as_spir_v_says() {
        let minus = |value: i32| value as u32;
        for (operation, a, b, expected) in [
            (Op::ISub, 2, 5, Some(minus(-3))),
            (Op::SDiv, minus(-7), 2, Some(minus(-3))),
            (Op::UDiv, 7, 0, None),
            (Op::SDiv, minus(i32::MIN), minus(-1), None),
            (Op::SRem, minus(-7), 3, Some(minus(-1))),
            (Op::SMod, minus(-7), 3, Some(2)),
            (Op::SMod, 7, minus(-3), Some(minus(-2))),
            (Op::ShiftRightArithmetic, minus(-8), 1, Some(minus(-4))),
            (Op::ShiftLeftLogical, 1, 32, None),
            (Op::SLessThan, minus(-1), 1, Some(1)),
            (Op::ULessThan, minus(-1), 1, Some(0)),
            (Op::LogicalAnd, 1, 0, Some(0)),
            (Op::Select, 1, 0, None),
        ] {
            assert_eq!(
                compute(operation, &[a, b]),
                expected,
                "{operation:?}: {a}, {b}"
            );
        }
        assert_eq!(compute(Op::SNegate, &[3]), Some(minus(-3)));
        assert_eq!(compute(Op::Select, &[0, 5, 7]), Some(7));
    }
}
