//! Polygons without crossings, drawn and random, and planes in space that they lie in.

use glam::{DVec2, DVec3, Vec3};
use tests::random::{Numbers, Random};

/// Arrowhead of 1 square metre, its notch last.
pub const ARROW: [[f64; 2]; 4] = [[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0], [0.0, 0.0]];

/// A wall of 4 m by 3 m with a door at its foot, as one face.
pub const DOOR: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [1.0, 0.0],
    [1.0, 2.0],
    [2.0, 2.0],
    [2.0, 0.0],
    [4.0, 0.0],
    [4.0, 3.0],
    [0.0, 3.0],
];

/// The wall with a door and a window: a side leads to the window and back.
pub const WINDOW: [[f64; 2]; 14] = [
    [0.0, 0.0],
    [1.0, 0.0],
    [1.0, 2.0],
    [2.0, 2.0],
    [2.0, 0.0],
    [4.0, 0.0],
    [2.5, 1.0],
    [2.5, 2.0],
    [3.5, 2.0],
    [3.5, 1.0],
    [2.5, 1.0],
    [4.0, 0.0],
    [4.0, 3.0],
    [0.0, 3.0],
];

/// Square with corners in the middle of its sides, and a square hole: no three of its corners make
/// a fan.
pub const FRAME: [[f64; 2]; 14] = [
    [0.0, 0.0],
    [1.5, 0.0],
    [3.0, 0.0],
    [3.0, 1.5],
    [3.0, 3.0],
    [1.0, 3.0],
    [0.0, 3.0],
    [0.0, 0.0],
    [1.0, 1.0],
    [1.0, 2.0],
    [2.0, 2.0],
    [2.0, 1.5],
    [2.0, 1.0],
    [1.0, 1.0],
];

pub type Polygon = Vec<DVec2>;

/// Plane in space.
#[derive(Clone, Copy)]
pub struct Plane {
    origin: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Plane {
    pub const XY: Self = Self {
        origin: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Y,
    };

    pub fn random(numbers: &mut Numbers) -> Self {
        let right = numbers.vector().normalize();
        Self {
            origin: 5.0 * numbers.vector(),
            right,
            up: numbers.vector().cross(right).normalize(),
        }
    }

    pub fn place(&self, polygon: &Polygon) -> Vec<Vec3> {
        let place = |point: &DVec2| self.origin + point.x * self.right + point.y * self.up;
        polygon.iter().map(|point| place(point).as_vec3()).collect()
    }

    pub fn flatten(&self, point: Vec3) -> DVec2 {
        let offset = point.as_dvec3() - self.origin;
        DVec2::new(offset.dot(self.right), offset.dot(self.up))
    }
}

pub fn polygon(points: &[[f64; 2]]) -> Polygon {
    points.iter().copied().map(DVec2::from).collect()
}

/// Lists a face from every corner on, in both directions.
pub fn turn_and_reverse<T: Copy>(face: &[T]) -> Vec<Vec<T>> {
    let from = |start: usize| [&face[start..], &face[..start]].concat();
    let turned = (0..face.len()).map(from);
    let both = turned.flat_map(|face| [face.clone(), face.into_iter().rev().collect()]);
    both.collect()
}

/// Draws a polygon around the origin, with a random radius in each direction.
pub fn draw_star(random: &mut Random) -> Polygon {
    let count = random.real(4.0, 24.0) as usize;
    let corner = |index: usize, random: &mut Random| {
        let angle = (index as f64 + f64::from(random.real(-0.4, 0.4))) / count as f64;
        let radius = f64::from(random.real(0.1, 1.0));
        radius * DVec2::from_angle(angle * std::f64::consts::TAU)
    };
    (0..count).map(|index| corner(index, random)).collect()
}

/// Grows a polygon from a triangle: a side bends to a random point if it then keeps clear of all
/// others.
pub fn grow(random: &mut Random) -> Polygon {
    let mut grown = polygon(&[[-0.5, -0.4], [0.5, -0.4], [0.0, 0.5]]);
    let count = random.real(4.0, 40.0) as usize;
    for _ in 0..20 * count {
        let side = random.real(0.0, grown.len() as f32) as usize;
        let point = DVec2::new(random.real(-1.0, 1.0).into(), random.real(-1.0, 1.0).into());
        let mut bent = grown.clone();
        bent.insert(side + 1, point);
        if is_clear(&bent, side + 1) {
            grown = bent;
        }
        if grown.len() == count {
            break;
        }
    }
    grown
}

/// Returns whether the two sides at a corner keep clear of all other sides.
fn is_clear(polygon: &Polygon, corner: usize) -> bool {
    let count = polygon.len();
    let side = |index: usize| [polygon[index % count], polygon[(index + 1) % count]];
    let mut sides = (0..count).map(|other| (other, side(other)));
    let [before, after] = [corner + count - 1, corner].map(|index| index % count);
    sides.all(|(other, ends)| {
        [before, after].into_iter().all(|edge| {
            let [near, far] = [(edge + 1) % count, (edge + count - 1) % count];
            if other == edge {
                ends[0].distance(ends[1]) > 0.02
            } else if other == near || other == far {
                // Neighbours meet in a corner; they must not fold back.
                let [a, b] = side(edge);
                let [c, d] = ends;
                let turn = (b - a).normalize().perp_dot((d - c).normalize());
                turn.abs() > 0.02
            } else {
                gap(side(edge), ends) > 0.01
            }
        })
    })
}

/// Returns the distance between two segments; 0 if they cross.
fn gap([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
    let crosses = turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
    let ends = [(c, [a, b]), (d, [a, b]), (a, [c, d]), (b, [c, d])];
    let distances = ends.map(|(point, segment)| distance(point, segment));
    let nearest = distances.into_iter().fold(f64::INFINITY, f64::min);
    if crosses { 0.0 } else { nearest }
}

pub fn distance(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = (point - a).dot(b - a) / (b - a).length_squared();
    point.distance(a + along.clamp(0.0, 1.0) * (b - a))
}

/// Returns whether a polygon surrounds a point, by the even-odd rule.
pub fn surrounds(polygon: &Polygon, point: DVec2) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(next).filter(|(a, b)| {
        let along = (point.y - a.y) / (b.y - a.y);
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + along * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}
