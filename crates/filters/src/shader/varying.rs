//! Values that a vertex stage hands to a fragment shader.

use wgpu::naga::{Binding, Handle, Interpolation, Module, Sampling, Scalar, Type, TypeInner};

/// Value at a location.
#[derive(Clone, Debug)]
pub(crate) struct Varying {
    pub location: u32,
    ty: TypeInner,
    interpolation: Option<Interpolation>,
    sampling: Option<Sampling>,
}

impl Varying {
    /// Lists the values of an argument or a result: itself, or its members.
    pub fn list(module: &Module, ty: Handle<Type>, binding: &Option<Binding>) -> Vec<Self> {
        let values = match &module.types[ty].inner {
            TypeInner::Struct { members, .. } => members
                .iter()
                .map(|member| (member.ty, &member.binding))
                .collect(),
            _ => vec![(ty, binding)],
        };
        let read = |(ty, binding): (Handle<Type>, &Option<Binding>)| match *binding {
            Some(Binding::Location {
                location,
                interpolation,
                sampling,
                ..
            }) => Some(Self {
                location,
                ty: module.types[ty].inner.clone(),
                interpolation,
                sampling,
            }),
            _ => None,
        };
        values.into_iter().filter_map(read).collect()
    }

    /// Counts its floats of 32 bits; none for other numbers.
    pub fn count_floats(&self) -> Option<usize> {
        match self.ty {
            TypeInner::Scalar(Scalar::F32) => Some(1),
            TypeInner::Vector {
                size,
                scalar: Scalar::F32,
            } => Some(size as usize),
            _ => None,
        }
    }
}

/// Gives the values that a vertex stage writes the interpolation that the fragment shader declares.
/// Engines declare it in the fragment shader alone; wgpu wants both to agree.
pub(crate) fn follow_interpolation(vertex: &mut Module, read: &[Varying]) {
    let result = &vertex.entry_points[0].function.result;
    let Some(ty) = result.as_ref().map(|result| result.ty) else {
        return;
    };
    let mut followed = vertex.types[ty].clone();
    let TypeInner::Struct { members, .. } = &mut followed.inner else {
        return;
    };
    for member in members {
        if let Some(Binding::Location {
            location,
            interpolation,
            sampling,
            ..
        }) = &mut member.binding
            && let Some(wanted) = read.iter().find(|varying| varying.location == *location)
        {
            (*interpolation, *sampling) = (wanted.interpolation, wanted.sampling);
        }
    }
    if vertex.types.get(&followed).is_none() {
        vertex.types.replace(ty, followed);
    }
}
