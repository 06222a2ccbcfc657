//! Surfaces, their textures, and the light that they scatter.

pub(crate) mod brdf;
pub(crate) mod brdf_sample;
pub(crate) mod diffuse_lobe;
pub(crate) mod fresnel;
pub(crate) mod ggx;
pub(crate) mod glossy_brdf;
pub(crate) mod glossy_material;
pub(crate) mod passage;
pub(crate) mod surface;
