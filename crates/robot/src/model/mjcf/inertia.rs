//! Masses of an MJCF: `<inertial>`, and the masses of geoms.

use nalgebra::{Matrix3, Point3, Vector3};
use num_traits::ToPrimitive;

use super::compiler::Compiler;
use super::defaults::Styled;
use super::frame::{ORIENTATIONS, placement};
use crate::model::{Mass, Origin, Surface};
use crate::spatial::Inertia;
use crate::spatial::exact::Placement;
use crate::{ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// Reads an `<inertial>`. `outer` is the frame of its `<frame>` in the body.
///
/// # Errors
/// [`ErrorKind::MissingKey`] without a mass; [`ErrorKind::BadValue`] for two tensors; those of [`placement`].
pub fn read(styled: &Styled<'_>, outer: &Placement, compiler: &Compiler) -> Result<Mass> {
    styled.own.required("mass")?;
    let mass = styled.own.number("mass")?.unwrap_or_default();
    let zero = BigRational::default;
    let moments = match (styled.own.numbers("diaginertia")?, styled.own.numbers("fullinertia")?) {
        (Some(_), Some(_)) => {
            let text = "has both `diaginertia` and `fullinertia`; give one of them";
            return Err(styled.error(ErrorKind::BadValue, text));
        }
        (Some([xx, yy, zz]), None) => [xx, zero(), zero(), yy, zero(), zz],
        (None, Some([xx, yy, zz, xy, xz, yz])) => {
            if let Some(name) = ORIENTATIONS.into_iter().find(|name| styled.own.attribute(name).is_some()) {
                let text = format!("has both `fullinertia` and `{name}`; give one of them");
                return Err(styled.error(ErrorKind::BadValue, &text));
            }
            [xx, xy, xz, yy, yz, zz]
        }
        (None, None) => std::array::from_fn(|_| zero()),
    };
    let origin = outer.then(&placement(styled, compiler)?).into();
    Ok(Mass { mass, origin, moments })
}

/// The mass of a body from its geoms; `None` without mass.
pub fn of_geoms(geoms: &[Inertia]) -> Option<Mass> {
    let sum = geoms.iter().fold(Inertia::none(), |sum, geom| sum.with(geom));
    (sum.mass() > 0.0).then(|| described(&sum))
}

/// An inertia in doubles as exact numbers.
fn described(inertia: &Inertia) -> Mass {
    let exact = |number: f64| BigRational::from_float(number).unwrap_or_default();
    let centre = inertia.centre_of_mass();
    let origin = Placement { origin: [centre.x, centre.y, centre.z].map(exact), ..Placement::identity() };
    let tensor = inertia.rotational();
    let moments = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| exact(tensor[at]));
    Mass { mass: exact(inertia.mass()), origin: Origin::from(origin), moments }
}

/// Applies the smallest mass of the compiler, and to a diagonal tensor the smallest moment and the balance of moments.
/// Returns whether a number is changed.
pub fn raise(mass: &mut Mass, compiler: &Compiler) -> bool {
    let mut is_changed = false;
    let mut raise = |number: &mut BigRational, least: f64| {
        if number.to_f64().is_some_and(|number| number < least) {
            *number = BigRational::from_float(least).unwrap_or_default();
            is_changed = true;
        }
    };
    raise(&mut mass.mass, compiler.least_mass);
    let is_diagonal = [1, 2, 4].iter().all(|place| mass.moments[*place] == BigRational::default());
    if is_diagonal {
        [0, 3, 5].into_iter().for_each(|place| raise(&mut mass.moments[place], compiler.least_inertia));
    }
    let [xx, _, _, yy, _, zz] = mass.moments.each_ref().map(|moment| moment.to_f64().unwrap_or(f64::NAN));
    if is_diagonal && compiler.balances && (xx + yy < zz || xx + zz < yy || yy + zz < xx) {
        let mean = (&mass.moments[0] + &mass.moments[3] + &mass.moments[5]) / BigRational::from_integer(3.into());
        [0, 3, 5].into_iter().for_each(|place| mass.moments[place].clone_from(&mean));
        is_changed = true;
    }
    is_changed
}

/// Multiplies a mass and its moments by a factor.
pub fn scale(mass: &mut Mass, factor: &BigRational) {
    mass.mass *= factor;
    mass.moments.iter_mut().for_each(|moment| *moment *= factor);
}

/// A solid of uniform density, along its own axes, with its centre at the origin. The sizes are MuJoCo's: radii and half
/// lengths \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Uniform {
    Sphere(f64),
    /// Radius, and half the length of the cylinder.
    Capsule(f64, f64),
    /// Radius and half length.
    Cylinder(f64, f64),
    /// Three radii.
    Ellipsoid([f64; 3]),
    /// Three half sides.
    Box([f64; 3]),
}

impl Uniform {
    /// The volume \[m^3\].
    pub fn volume(self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Uniform::Sphere(radius) => 4.0 / 3.0 * PI * radius.powi(3),
            Uniform::Capsule(radius, half) => PI * radius * radius * (2.0 * half + 4.0 / 3.0 * radius),
            Uniform::Cylinder(radius, half) => PI * radius * radius * 2.0 * half,
            Uniform::Ellipsoid([a, b, c]) => 4.0 / 3.0 * PI * a * b * c,
            Uniform::Box([a, b, c]) => 8.0 * a * b * c,
        }
    }

    /// The principal moments for a mass of one \[m^2\].
    fn moments(self) -> [f64; 3] {
        let round = |radius: f64, half: f64| {
            let across = radius * radius / 4.0 + half * half / 3.0;
            [across, across, radius * radius / 2.0]
        };
        let of_squares =
            |[a, b, c]: [f64; 3], share: f64| [b * b + c * c, a * a + c * c, a * a + b * b].map(|x| x * share);
        match self {
            Uniform::Sphere(radius) => [0.4 * radius * radius; 3],
            Uniform::Cylinder(radius, half) => round(radius, half),
            Uniform::Ellipsoid(radii) => of_squares(radii, 0.2),
            Uniform::Box(halves) => of_squares(halves, 1.0 / 3.0),
            Uniform::Capsule(radius, half) => {
                let length = 2.0 * half;
                let ball = 4.0 * radius / (4.0 * radius + 3.0 * length);
                let [across, _, along] = round(radius, half).map(|moment| moment * (1.0 - ball));
                // The two half spheres are at the ends; 3/8 of the radius is the distance of their centres of mass.
                let own = 0.4 * ball * radius * radius;
                let apart = ball * length * (3.0 * radius + 2.0 * length) / 8.0;
                [across + own + apart, across + own + apart, along + own]
            }
        }
    }

    /// The inertia for a mass \[kg\].
    pub fn inertia(self, mass: f64) -> Inertia {
        let [xx, yy, zz] = self.moments().map(|moment| moment * mass);
        Inertia::unchecked(mass, Point3::origin(), Matrix3::from_diagonal(&Vector3::new(xx, yy, zz)))
    }
}

/// How MuJoCo computes the volume of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshVolume {
    /// By the signed volumes of the pyramids over the triangles.
    Exact,
    /// By their absolute values, from the centroid of the surface: MuJoCo's default, `legacy`.
    Absolute,
}

/// The volume of a closed mesh \[m^3\], and its inertia for a density of one: the sum over the pyramids of its
/// triangles, first from the centroid of the surface and then from the centre of mass, as in MuJoCo.
pub fn of_mesh(surface: &Surface, rule: MeshVolume) -> (f64, Inertia) {
    let corners = |from: Vector3<f64>| {
        let corner = move |place: u32| surface.points[place as usize].coords - from;
        surface.triangles.iter().map(move |triangle| triangle.map(corner))
    };
    let part = |[a, b, c]: &[Vector3<f64>; 3]| {
        let signed = a.dot(&b.cross(c)) / 6.0;
        if rule == MeshVolume::Absolute { signed.abs() } else { signed }
    };
    let (mut area, mut centroid) = (0.0, Vector3::zeros());
    for [a, b, c] in corners(Vector3::zeros()) {
        let own = (b - a).cross(&(c - a)).norm();
        area += own;
        centroid += (a + b + c) * (own / 3.0);
    }
    if area <= 0.0 {
        return (0.0, Inertia::none());
    }
    centroid /= area;
    let (mut first_volume, mut first) = (0.0, Vector3::zeros());
    for triangle in corners(centroid) {
        let own = part(&triangle);
        first_volume += own;
        first += triangle.iter().sum::<Vector3<f64>>() * (own / 4.0);
    }
    if first_volume == 0.0 || !first_volume.is_finite() {
        return (0.0, Inertia::none());
    }
    let centre = centroid + first / first_volume;
    let (mut volume, mut second) = (0.0, Matrix3::zeros());
    for triangle in corners(centre) {
        volume += part(&triangle);
        let sum = triangle.iter().sum::<Vector3<f64>>();
        let squares: Matrix3<f64> = triangle.iter().map(|corner| corner * corner.transpose()).sum();
        second += (squares + sum * sum.transpose()) * (part(&triangle) / 20.0);
    }
    // A mesh with its triangles inside out has a negative volume.
    let (volume, second) = (volume.abs(), second * volume.signum());
    let tensor = Matrix3::from_diagonal_element(second.trace()) - second;
    (volume, Inertia::unchecked(volume, centre.into(), tensor))
}
