//! The surface at a hit: position, normals, colour and emission.

use bvh::Ray;
use glam::{DVec3, Vec2, Vec3, Vec4};
use scene::{Material, Mesh, Scene};

use crate::hit::Hit;
use crate::material::brdf::Brdf;
use crate::material::glossy_material::GlossyMaterial;
use crate::motion::pose::Pose;

/// A point of a surface at one time, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub position: DVec3,
    /// Unit normal of the facet, on the ray's side.
    pub facet: DVec3,
    /// Unit shading normal on the facet's side, interpolated if the mesh has normals.
    pub normal: DVec3,
    /// Albedo, or a metal's reflectance at normal incidence.
    pub color: Vec3,
    /// Index into the scene's materials.
    pub material: usize,
    pub emission: Vec3,
    /// Area of the whole triangle, square metres.
    pub area: f64,
}

/// The translucent surfaces that a ray sees; opaque ones it always sees, holes never.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sight {
    /// All that change the light.
    Everything,
    /// Those that velocity, depth and object id come from.
    Buffers,
    /// None.
    Opaque,
}

/// Finds per object whether it is opaque everywhere, without holes cut out by opacity and without
/// translucent parts.
pub(crate) fn find_solid_objects(scene: &Scene) -> Vec<bool> {
    let is_solid = |&material: &usize| {
        let material = &scene.materials[material];
        material.opacity >= Material::HOLE
            && material.opacity_texture.is_none()
            && material.translucency.is_none()
    };
    let objects = scene.objects.iter();
    objects
        .map(|object| object.materials.iter().all(is_solid))
        .collect()
}

/// Returns true if a ray of this sight sees a point of a triangle of an object that is not solid.
pub(crate) fn is_seen(
    sight: Sight,
    scene: &Scene,
    (object, triangle): (usize, u32),
    weights: [f64; 2],
) -> bool {
    let opacity = || opacity(scene, object, triangle, weights);
    let Some(translucency) = find_material(scene, object, triangle).translucency else {
        return opacity() >= Material::HOLE;
    };
    let changes_light =
        || translucency.glass.is_some() || translucency.filter != Vec3::ONE || opacity() > 0.0;
    match sight {
        Sight::Everything => changes_light(),
        Sight::Buffers => translucency.in_buffers && changes_light(),
        Sight::Opaque => false,
    }
}

impl Surface {
    /// The surface that `ray` meets at `hit`, the object being at `pose`.
    pub fn at(scene: &Scene, pose: &Pose, ray: &Ray, hit: &Hit) -> Surface {
        let mesh = &scene.meshes[scene.objects[hit.object].mesh];
        let scaled = scaled_normal(scene, pose, hit);
        let facet = face_towards(scaled.normalize_or_zero(), -ray.direction);
        let texcoord = interpolate_texcoord(mesh, hit.triangle, hit.weights);
        let index = material_index(scene, hit.object, hit.triangle);
        let material = &scene.materials[index];
        Surface {
            position: ray.at(hit.t),
            facet,
            normal: shading_normal(mesh, pose, hit)
                .map_or(facet, |normal| face_towards(normal, facet)),
            color: apply_texture(scene, material.diffuse, material.diffuse_texture, texcoord),
            material: index,
            emission: apply_texture(
                scene,
                material.emission,
                material.emission_texture,
                texcoord,
            ),
            area: 0.5 * scaled.length(),
        }
    }

    /// The BRDF towards the ray that met the surface; none if it scatters nothing.
    pub fn brdf<'a>(&self, glossy: Option<&'a GlossyMaterial>, ray: &Ray) -> Option<Brdf<'a>> {
        Brdf::new(glossy, self.color, self.facet, self.normal, -ray.direction)
    }
}

/// The normal of the facet at a hit; its length is twice the triangle's area.
fn scaled_normal(scene: &Scene, pose: &Pose, hit: &Hit) -> DVec3 {
    let mesh = &scene.meshes[scene.objects[hit.object].mesh];
    mesh.at(hit.time).area_normal(hit.triangle, &pose.to_world)
}

/// The cosine between a ray and the normal of the facet that it meets, from 0 to 1.
pub(crate) fn incidence(scene: &Scene, pose: &Pose, ray: &Ray, hit: &Hit) -> f64 {
    let normal = scaled_normal(scene, pose, hit).normalize_or_zero();
    normal.dot(ray.direction).abs().min(1.0)
}

/// The material of a triangle.
pub(crate) fn find_material(scene: &Scene, object: usize, triangle: u32) -> &Material {
    &scene.materials[material_index(scene, object, triangle)]
}

fn material_index(scene: &Scene, object: usize, triangle: u32) -> usize {
    let object = &scene.objects[object];
    let slot = scene.meshes[object.mesh].slots[triangle as usize];
    object.materials[slot as usize]
}

/// Emitted radiance at a point of a triangle: zero where it has a hole, and in proportion to its
/// opacity where it is translucent.
pub(crate) fn emission(scene: &Scene, object: usize, triangle: u32, weights: [f64; 2]) -> Vec3 {
    let opacity = opacity(scene, object, triangle, weights);
    let material = find_material(scene, object, triangle);
    let is_translucent = material.translucency.is_some();
    if opacity < Material::HOLE && !is_translucent {
        return Vec3::ZERO;
    }
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let texcoord = interpolate_texcoord(mesh, triangle, weights);
    let emission = apply_texture(
        scene,
        material.emission,
        material.emission_texture,
        texcoord,
    );
    if is_translucent {
        opacity * emission
    } else {
        emission
    }
}

/// The opacity at a point of a triangle; in a texture it is the texels' alpha.
pub(crate) fn opacity(scene: &Scene, object: usize, triangle: u32, weights: [f64; 2]) -> f32 {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let material = find_material(scene, object, triangle);
    let texel = sample_texture(
        scene,
        material.opacity_texture,
        interpolate_texcoord(mesh, triangle, weights),
    );
    material.opacity * texel.w
}

fn apply_texture(scene: &Scene, factor: Vec3, texture: Option<usize>, texcoord: Vec2) -> Vec3 {
    if factor == Vec3::ZERO {
        return factor;
    }
    factor * sample_texture(scene, texture, texcoord).truncate()
}

fn sample_texture(scene: &Scene, texture: Option<usize>, texcoord: Vec2) -> Vec4 {
    texture.map_or(Vec4::ONE, |texture| {
        scene.textures[texture].sample(texcoord)
    })
}

fn interpolate_texcoord(mesh: &Mesh, triangle: u32, weights: [f64; 2]) -> Vec2 {
    if mesh.texcoords.is_empty() {
        return Vec2::ZERO;
    }
    let [a, b, c] = mesh.triangles[triangle as usize];
    let texcoord = |index: u32| mesh.texcoords[index as usize].as_dvec2();
    let [a, b, c] = [texcoord(a), texcoord(b), texcoord(c)];
    (a + weights[0] * (b - a) + weights[1] * (c - a)).as_vec2()
}

/// The interpolated normal; none if the mesh has no normals, or if they cancel.
fn shading_normal(mesh: &Mesh, pose: &Pose, hit: &Hit) -> Option<DVec3> {
    let shape = mesh.at(hit.time);
    let [a, b, c] = mesh.triangles[hit.triangle as usize];
    let [a, b, c] = [shape.normal(a)?, shape.normal(b)?, shape.normal(c)?];
    let normal = a + hit.weights[0] * (b - a) + hit.weights[1] * (c - a);
    // Normals transform by the transpose of the inverse.
    (pose.to_object.matrix3.transpose() * normal).try_normalize()
}

fn face_towards(normal: DVec3, side: DVec3) -> DVec3 {
    if normal.dot(side) < 0.0 {
        -normal
    } else {
        normal
    }
}
