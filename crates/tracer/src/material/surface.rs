//! What a hit says about light: place, orientation, colour, emission.

use glam::{DVec3, Vec2, Vec3, Vec4};

use crate::geometry::ray::Ray;
use crate::geometry::triangle::Crossing;
use crate::material::brdf::Brdf;
use crate::material::glossy_material::Gloss;
use crate::motion::poses::Pose;
use crate::scene::{Material, Mesh, Scene};
use crate::stage::Hit;

/// Surfaces whose opacity falls below this have a hole.
const HOLE: f32 = 0.5;

/// A point of a surface at one time, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub position: DVec3,
    /// Unit, of the facet, on the ray's side.
    pub facet: DVec3,
    /// Unit, interpolated where the mesh has normals, on the facet's side.
    pub normal: DVec3,
    /// Albedo, or a metal's reflectance at normal incidence.
    pub color: Vec3,
    /// Index into the scene's materials.
    pub material: usize,
    pub emission: Vec3,
    /// Area of the whole triangle, square metres.
    pub area: f64,
}

/// Which of an object's slots may have holes.
pub(crate) struct Opacity {
    object: usize,
    solid: bool,
}

impl Opacity {
    pub fn of_objects(scene: &Scene) -> Vec<Opacity> {
        let solid = |&material: &usize| {
            let material = &scene.materials[material];
            material.opacity >= HOLE && material.opacity_texture.is_none()
        };
        scene
            .objects
            .iter()
            .enumerate()
            .map(|(index, object)| Opacity {
                object: index,
                solid: object.materials.iter().all(solid),
            })
            .collect()
    }

    /// Whether the surface is there at the crossing.
    #[inline]
    pub fn opaque(&self, scene: &Scene, triangle: u32, crossing: &Crossing) -> bool {
        self.solid || opacity(scene, self.object, triangle, [crossing.u, crossing.v]) >= HOLE
    }
}

impl Surface {
    /// The surface that `ray` meets at `hit`, the object being at `pose`.
    pub fn at(scene: &Scene, pose: &Pose, ray: &Ray, hit: &Hit) -> Surface {
        let mesh = &scene.meshes[scene.objects[hit.object].mesh];
        let [a, b, c] = corners(mesh, hit.triangle, hit.time);
        let edge = |to: DVec3| pose.to_world.transform_vector3(to - a);
        let scaled = edge(b).cross(edge(c));
        let facet = towards(scaled.normalize_or_zero(), -ray.direction);
        let texcoord = texcoord(mesh, hit.triangle, hit.weights);
        let index = material_index(scene, hit.object, hit.triangle);
        let material = &scene.materials[index];
        Surface {
            position: ray.at(hit.t),
            facet,
            normal: shading_normal(mesh, pose, hit).map_or(facet, |normal| towards(normal, facet)),
            color: textured(scene, material.diffuse, material.diffuse_texture, texcoord),
            material: index,
            emission: textured(
                scene,
                material.emission,
                material.emission_texture,
                texcoord,
            ),
            area: 0.5 * scaled.length(),
        }
    }

    /// How it scatters towards the ray that met it; none where it scatters nothing.
    pub fn brdf<'a>(&self, gloss: Option<&'a Gloss>, ray: &Ray) -> Option<Brdf<'a>> {
        Brdf::new(gloss, self.color, self.facet, self.normal, -ray.direction)
    }
}

/// Vertices of a triangle in object space, at `time` (frames).
pub(crate) fn corners(mesh: &Mesh, triangle: u32, time: f64) -> [DVec3; 3] {
    mesh.at(time).corners(triangle)
}

/// The normal by which a triangle is wound, in the world; not of unit length.
pub(crate) fn winding(scene: &Scene, pose: &Pose, hit: &Hit, time: f64) -> DVec3 {
    let mesh = &scene.meshes[scene.objects[hit.object].mesh];
    let [a, b, c] = corners(mesh, hit.triangle, time);
    let edge = |to: DVec3| pose.to_world.transform_vector3(to - a);
    edge(b).cross(edge(c))
}

/// The material of a triangle.
pub(crate) fn material(scene: &Scene, object: usize, triangle: u32) -> &Material {
    &scene.materials[material_index(scene, object, triangle)]
}

fn material_index(scene: &Scene, object: usize, triangle: u32) -> usize {
    let object = &scene.objects[object];
    let slot = scene.meshes[object.mesh].slots[triangle as usize];
    object.materials[slot as usize]
}

/// Emitted radiance at a point of a triangle; nothing where it has a hole.
pub(crate) fn emission(scene: &Scene, object: usize, triangle: u32, weights: [f64; 2]) -> Vec3 {
    if opacity(scene, object, triangle, weights) < HOLE {
        return Vec3::ZERO;
    }
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let material = material(scene, object, triangle);
    let texcoord = texcoord(mesh, triangle, weights);
    textured(
        scene,
        material.emission,
        material.emission_texture,
        texcoord,
    )
}

/// Opacity lies in the texels' alpha.
fn opacity(scene: &Scene, object: usize, triangle: u32, weights: [f64; 2]) -> f32 {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let material = material(scene, object, triangle);
    let texel = lookup(
        scene,
        material.opacity_texture,
        texcoord(mesh, triangle, weights),
    );
    material.opacity * texel.w
}

fn textured(scene: &Scene, factor: Vec3, texture: Option<usize>, texcoord: Vec2) -> Vec3 {
    if factor == Vec3::ZERO {
        return factor;
    }
    factor * lookup(scene, texture, texcoord).truncate()
}

fn lookup(scene: &Scene, texture: Option<usize>, texcoord: Vec2) -> Vec4 {
    texture.map_or(Vec4::ONE, |texture| {
        scene.textures[texture].sample(texcoord)
    })
}

fn texcoord(mesh: &Mesh, triangle: u32, weights: [f64; 2]) -> Vec2 {
    if mesh.texcoords.is_empty() {
        return Vec2::ZERO;
    }
    let [a, b, c] =
        mesh.triangles[triangle as usize].map(|index| mesh.texcoords[index as usize].as_dvec2());
    (a + weights[0] * (b - a) + weights[1] * (c - a)).as_vec2()
}

/// None where the mesh has no normals, or where they cancel.
fn shading_normal(mesh: &Mesh, pose: &Pose, hit: &Hit) -> Option<DVec3> {
    let shape = mesh.at(hit.time);
    let [a, b, c] = mesh.triangles[hit.triangle as usize].map(|vertex| shape.normal(vertex));
    let [a, b, c] = [a?, b?, c?];
    let normal = a + hit.weights[0] * (b - a) + hit.weights[1] * (c - a);
    // Normals move by the transpose of the way back.
    (pose.to_object.matrix3.transpose() * normal).try_normalize()
}

fn towards(normal: DVec3, side: DVec3) -> DVec3 {
    if normal.dot(side) < 0.0 {
        -normal
    } else {
        normal
    }
}
