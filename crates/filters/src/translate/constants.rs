//! Specialisation constants of SPIR-V, replaced by constants with the values of filter.toml.
//!
//! naga reads no `OpSpecConstantOp`, which compilers make of arithmetic on them, and no size of workgroups that depends on them.

use std::collections::{BTreeMap, BTreeSet};

use super::words::{Instruction, Words, decoration, op};

/// Number of the built-in that is the size of a workgroup, and of the execution mode that gives it.
const WORKGROUP_SIZE: u32 = 25;
const LOCAL_SIZE: u32 = 17;

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

/// Sets the constants that are `given` by name or number, and computes all that depend on them. Fails for one that is not there, unless
/// `may_miss`.
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
        return Err(constants.refuse_missing(missing));
    }
    for instruction in &mut words.instructions {
        if let Some(replaced) = constants.replace(instruction)? {
            *instruction = replaced;
        }
    }
    size_workgroups(words, &constants.values);
    words
        .instructions
        .retain(|it| it.opcode != op::DECORATE || it.operands.get(1) != Some(&decoration::SPEC_ID));
    Ok(())
}

fn list_types(words: &Words) -> BTreeMap<u32, Scalar> {
    let bools = words.all(op::TYPE_BOOL).map(|[id]| (id, Scalar::Bool));
    let floats = (words.all(op::TYPE_FLOAT)).filter(|[_, width]| *width == 32);
    let integers = (words.all(op::TYPE_INT)).filter(|[_, width, _]| *width == 32);
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
    let names = words.find_names();
    (words.all(op::DECORATE))
        .filter(|[_, kind, _]| *kind == decoration::SPEC_ID)
        .map(|[id, _, number]| {
            let name = names.get(&id).cloned().filter(|name| !name.is_empty());
            (id, [name, Some(number.to_string())])
        })
        .collect()
}

/// Gives entry points the size of workgroups that a constant has.
fn size_workgroups(words: &mut Words, values: &BTreeMap<u32, Value>) {
    let sizes: Vec<u32> = (words.all(op::DECORATE))
        .filter(|[_, kind, built_in]| [*kind, *built_in] == [decoration::BUILT_IN, WORKGROUP_SIZE])
        .map(|[id, ..]| id)
        .collect();
    let Some(Value::Composite(sides)) = sizes.first().and_then(|id| values.get(id)) else {
        return;
    };
    let sides: Vec<u32> = (sides.iter())
        .filter_map(|side| match values.get(side) {
            Some(Value::Scalar(side)) => Some(*side),
            _ => None,
        })
        .collect();
    for instruction in &mut words.instructions {
        if let (op::EXECUTION_MODE, [_, LOCAL_SIZE, size @ ..], 3) = (
            instruction.opcode,
            &mut instruction.operands[..],
            sides.len(),
        ) && size.len() == 3
        {
            size.copy_from_slice(&sides);
        }
    }
}

impl Constants<'_> {
    fn refuse_missing(&self, missing: &str) -> String {
        let known: Vec<String> = (self.called.values())
            .filter_map(|[name, number]| name.clone().or(number.clone()))
            .collect();
        refuse_missing(missing, &known)
    }

    /// Remembers a constant, and returns what a specialisation constant is replaced by.
    fn replace(&mut self, instruction: &Instruction) -> Result<Option<Instruction>, String> {
        let (opcode, operands) = (instruction.opcode, &instruction.operands[..]);
        let [ty, id, rest @ ..] = operands else {
            return Ok(None);
        };
        let scalar = self.types.get(ty).copied();
        let own = match (opcode, rest) {
            (op::CONSTANT_TRUE | op::SPEC_CONSTANT_TRUE, []) => Value::Scalar(1),
            (op::CONSTANT_FALSE | op::SPEC_CONSTANT_FALSE, []) => Value::Scalar(0),
            (op::CONSTANT | op::SPEC_CONSTANT, [bits]) if scalar.is_some() => Value::Scalar(*bits),
            // A number of another width keeps its value.
            (op::SPEC_CONSTANT, _) => {
                self.refuse_given(*id)?;
                return Ok(Some(Instruction::new(op::CONSTANT, operands)));
            }
            (op::CONSTANT_COMPOSITE | op::SPEC_CONSTANT_COMPOSITE, parts) => {
                Value::Composite(parts.to_vec())
            }
            (op::SPEC_CONSTANT_OP, [operation, operands @ ..]) => {
                self.compute(*operation, operands, scalar)?
            }
            _ => return Ok(None),
        };
        let value = match (scalar, self.find_given(*id)) {
            (Some(scalar), Some((name, given))) => Value::Scalar(encode(scalar, name, given)?),
            _ => own,
        };
        let replaced = match (&value, scalar) {
            (Value::Scalar(0), Some(Scalar::Bool)) => {
                Instruction::new(op::CONSTANT_FALSE, [*ty, *id])
            }
            (Value::Scalar(_), Some(Scalar::Bool)) => {
                Instruction::new(op::CONSTANT_TRUE, [*ty, *id])
            }
            (Value::Scalar(bits), _) => Instruction::new(op::CONSTANT, [*ty, *id, *bits]),
            (Value::Composite(parts), _) => {
                let operands = [*ty, *id].into_iter().chain(parts.iter().copied());
                Instruction::new(op::CONSTANT_COMPOSITE, operands.collect::<Vec<u32>>())
            }
        };
        self.values.insert(*id, value);
        Ok(Some(replaced))
    }

    /// Finds the value that is given for a specialisation constant.
    fn find_given(&self, id: u32) -> Option<(&str, f64)> {
        let names = self.called.get(&id)?;
        let is_own = |name: &str| names.iter().flatten().any(|own| own == name);
        let given = self.given.iter().find(|(name, _)| is_own(name));
        given.map(|(name, value)| (&name[..], *value))
    }

    fn refuse_given(&self, id: u32) -> Result<(), String> {
        match self.find_given(id) {
            None => Ok(()),
            Some((name, _)) => Err(format!(
                "specialisation constant \"{name}\" has not 32 bits; allowed: bool, int, uint and float"
            )),
        }
    }

    /// Computes what is made of other constants.
    fn compute(
        &self,
        operation: u32,
        operands: &[u32],
        result: Option<Scalar>,
    ) -> Result<Value, String> {
        let unknown = || {
            format!(
                "computes a constant by instruction {operation} from others; allowed: arithmetic, comparisons and choices of \
                 single numbers of 32 bits"
            )
        };
        let find = |id: &u32| self.values.get(id);
        if operation == op::COMPOSITE_EXTRACT {
            let [composite, index] = operands else {
                return Err(unknown());
            };
            let parts = match find(composite) {
                Some(Value::Composite(parts)) => parts,
                _ => return Err(unknown()),
            };
            let part = parts.get(*index as usize).and_then(find);
            return part.cloned().ok_or_else(unknown);
        }
        let scalars: Option<Vec<u32>> = (operands.iter())
            .map(|id| match find(id) {
                Some(Value::Scalar(bits)) => Some(*bits),
                _ => None,
            })
            .collect();
        let computed = match (&scalars.ok_or_else(unknown)?[..], result) {
            (_, None) => None,
            ([a], _) => compute_one(operation, *a),
            ([a, b], _) => compute_two(operation, *a, *b),
            ([condition, yes, no], _) if operation == op::SELECT => {
                Some(if *condition != 0 { *yes } else { *no })
            }
            _ => None,
        };
        computed.map(Value::Scalar).ok_or_else(unknown)
    }
}

/// Says which constants there are.
pub(super) fn refuse_missing(missing: &str, known: &[String]) -> String {
    format!(
        "has no specialisation constant \"{missing}\", which filter.toml sets; it has: {}",
        match known.is_empty() {
            true => "none".to_owned(),
            false => known.join(", "),
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

fn compute_one(operation: u32, a: u32) -> Option<u32> {
    match operation {
        op::S_NEGATE => Some(a.wrapping_neg()),
        op::NOT => Some(!a),
        op::LOGICAL_NOT => Some(u32::from(a == 0)),
        op::U_CONVERT | op::S_CONVERT | op::BITCAST => Some(a),
        _ => None,
    }
}

/// Computes an operation on two numbers; none for one that is unknown, or that divides by zero.
fn compute_two(operation: u32, a: u32, b: u32) -> Option<u32> {
    let (signed_a, signed_b) = (a as i32, b as i32);
    let truth = |is: bool| Some(u32::from(is));
    match operation {
        op::I_ADD => Some(a.wrapping_add(b)),
        op::I_SUB => Some(a.wrapping_sub(b)),
        op::I_MUL => Some(a.wrapping_mul(b)),
        op::U_DIV => a.checked_div(b),
        op::S_DIV => signed_a.checked_div(signed_b).map(|it| it as u32),
        op::U_MOD => a.checked_rem(b),
        op::S_REM => signed_a.checked_rem(signed_b).map(|it| it as u32),
        // The result has the sign of the divisor.
        op::S_MOD => {
            let rest = signed_a.checked_rem(signed_b)?;
            let is_other = rest != 0 && (rest < 0) != (signed_b < 0);
            Some(rest.wrapping_add(if is_other { signed_b } else { 0 }) as u32)
        }
        op::SHIFT_RIGHT_LOGICAL => a.checked_shr(b),
        op::SHIFT_RIGHT_ARITHMETIC => signed_a.checked_shr(b).map(|it| it as u32),
        op::SHIFT_LEFT_LOGICAL => a.checked_shl(b),
        op::BITWISE_OR => Some(a | b),
        op::BITWISE_XOR => Some(a ^ b),
        op::BITWISE_AND => Some(a & b),
        op::LOGICAL_OR => truth(a != 0 || b != 0),
        op::LOGICAL_AND => truth(a != 0 && b != 0),
        op::LOGICAL_EQUAL | op::I_EQUAL => truth(a == b),
        op::LOGICAL_NOT_EQUAL | op::I_NOT_EQUAL => truth(a != b),
        op::U_GREATER_THAN => truth(a > b),
        op::S_GREATER_THAN => truth(signed_a > signed_b),
        op::U_GREATER_THAN_EQUAL => truth(a >= b),
        op::S_GREATER_THAN_EQUAL => truth(signed_a >= signed_b),
        op::U_LESS_THAN => truth(a < b),
        op::S_LESS_THAN => truth(signed_a < signed_b),
        op::U_LESS_THAN_EQUAL => truth(a <= b),
        op::S_LESS_THAN_EQUAL => truth(signed_a <= signed_b),
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
            (op::I_SUB, 2, 5, Some(minus(-3))),
            (op::S_DIV, minus(-7), 2, Some(minus(-3))),
            (op::U_DIV, 7, 0, None),
            (op::S_DIV, minus(i32::MIN), minus(-1), None),
            (op::S_REM, minus(-7), 3, Some(minus(-1))),
            (op::S_MOD, minus(-7), 3, Some(2)),
            (op::S_MOD, 7, minus(-3), Some(minus(-2))),
            (op::SHIFT_RIGHT_ARITHMETIC, minus(-8), 1, Some(minus(-4))),
            (op::SHIFT_LEFT_LOGICAL, 1, 32, None),
            (op::S_LESS_THAN, minus(-1), 1, Some(1)),
            (op::U_LESS_THAN, minus(-1), 1, Some(0)),
            (op::LOGICAL_AND, 1, 0, Some(0)),
            (op::SELECT, 1, 0, None),
        ] {
            assert_eq!(
                compute_two(operation, a, b),
                expected,
                "{operation}: {a}, {b}"
            );
        }
        assert_eq!(compute_one(op::S_NEGATE, 3), Some(minus(-3)));
    }
}
