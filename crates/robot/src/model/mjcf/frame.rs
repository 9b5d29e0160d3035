//! Positions and orientations of an MJCF: [`placement`].

use num_traits::{One, Signed, ToPrimitive, Zero};

use super::compiler::Compiler;
use super::defaults::Styled;
use crate::model::urdf::xml::Element;
use crate::spatial::exact::{ExactRotation, ExactVector, Placement, Turn, vector};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigInt, BigRational};

/// The attributes that give an orientation. An element may have one of them.
pub const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// The frame of an element in its parent's frame, by `pos` and one of [`ORIENTATIONS`].
///
/// # Errors
/// [`ErrorKind::BadValue`] for several orientations, and directions of length zero; those of [`Element::numbers`].
pub fn placement(styled: &Styled<'_>, compiler: &Compiler) -> Result<Placement> {
    let origin = styled.numbers::<3>("pos")?.unwrap_or_else(vector::zero);
    let turned = orientation(styled, compiler)?;
    Ok(Placement { origin, ..turned })
}

fn orientation(styled: &Styled<'_>, compiler: &Compiler) -> Result<Placement> {
    let Some(element) = styled.holder_of(&ORIENTATIONS) else { return Ok(Placement::identity()) };
    let mut given = ORIENTATIONS.into_iter().filter(|name| element.attribute(name).is_some());
    match (given.next(), given.next()) {
        (Some(one), Some(other)) => {
            Err(element.error(ErrorKind::BadValue, &format!("has both `{one}` and `{other}`; give one of them")))
        }
        (Some("quat"), None) => quaternion(element),
        (Some("axisangle"), None) => axis_angle(element, compiler),
        (Some("euler"), None) => euler(element, compiler),
        (Some("xyaxes"), None) => axes(element),
        _ => z_axis(element),
    }
}

fn plain(rotation: ExactRotation) -> Placement {
    Placement { rotation, ..Placement::identity() }
}

fn zero(element: &Element, name: &str) -> Error {
    element.error(ErrorKind::BadValue, &format!("has a `{name}` without direction; give numbers that are not all zero"))
}

/// `quat`: w, x, y, z of any length.
fn quaternion(element: &Element) -> Result<Placement> {
    let Some([w, x, y, z]) = element.numbers("quat")? else { return Ok(Placement::identity()) };
    ExactRotation::from_quaternion(&[x, y, z, w]).map(plain).ok_or_else(|| zero(element, "quat"))
}

/// The angle of an elementary rotation in the model's unit.
fn turn(element: &Element, angle: &BigRational, degrees: bool) -> Result<Turn> {
    let turn = if degrees { Turn::from_degrees(angle) } else { Turn::from_radians(angle) };
    turn.map_err(|error| element.error(error.kind(), error.message()))
}

/// The rotation by `angle`, in degrees or radians, about an axis of any length. It is exact about a coordinate axis by a
/// multiple of 30 or 45 degrees.
///
/// # Errors
/// [`ErrorKind::BadValue`] for an angle above a million radians.
pub fn about(element: &Element, axis: &ExactVector, angle: &BigRational, degrees: bool) -> Result<Placement> {
    let mut along = (0..3).filter(|index| !axis[*index].is_zero());
    if let (Some(index), None) = (along.next(), along.next()) {
        let angle = if axis[index].is_negative() { -angle } else { angle.clone() };
        return Ok(elementary(index, turn(element, &angle, degrees)?, true));
    }
    turn(element, angle, degrees)?;
    let radians = angle.to_f64().unwrap_or(0.0);
    let radians = BigRational::from_float(if degrees { radians.to_radians() } else { radians }).unwrap_or_default();
    Ok(Placement::turned_about(axis, &radians))
}

/// The rotation by `turn` about a coordinate axis. A rotation that is not exact is rounded to a rational one.
fn elementary(axis: usize, turn: Turn, is_exact: bool) -> Placement {
    let of = |turn: Turn| {
        let rotation = ExactRotation::about(axis, turn);
        if is_exact && turn.is_exact() { rotation } else { rotation.made_rational() }
    };
    let meant = turn.meant();
    let meant = (meant != turn).then(|| ExactRotation::about(axis, meant));
    Placement { rotation: of(turn), meant, ..Placement::identity() }
}

/// `axisangle`: x, y, z and the angle.
fn axis_angle(element: &Element, compiler: &Compiler) -> Result<Placement> {
    let Some([x, y, z, angle]) = element.numbers("axisangle")? else { return Ok(Placement::identity()) };
    let axis = [x, y, z];
    if vector::is_zero(&axis) {
        return Err(zero(element, "axisangle"));
    }
    about(element, &axis, &angle, compiler.degrees)
}

/// `euler`: angles about the axes of `eulerseq`.
fn euler(element: &Element, compiler: &Compiler) -> Result<Placement> {
    let Some(angles) = element.numbers::<3>("euler")? else { return Ok(Placement::identity()) };
    let turns: Vec<Turn> = angles.iter().map(|angle| turn(element, angle, compiler.degrees)).collect::<Result<_>>()?;
    let is_exact = turns.iter().all(|turn| turn.is_exact());
    let one = |(turn, (axis, moves)): (&Turn, (usize, bool))| (elementary(axis, *turn, is_exact), moves);
    let all = turns.iter().zip(compiler.euler).map(one);
    Ok(all.fold(
        Placement::identity(),
        |so_far, (next, moves)| {
            if moves { so_far.then(&next) } else { next.then(&so_far) }
        },
    ))
}

/// `xyaxes`: the x axis, and a vector whose part perpendicular to it is the y axis.
fn axes(element: &Element) -> Result<Placement> {
    let Some([a, b, c, d, e, f]) = element.numbers("xyaxes")? else { return Ok(Placement::identity()) };
    let (x, given) = ([a, b, c], [d, e, f]);
    let square = vector::dot(&x, &x);
    if square.is_zero() {
        return Err(zero(element, "xyaxes"));
    }
    let along = vector::dot(&x, &given) / square;
    let y = vector::sub(&given, &vector::scale(&x, &along));
    if vector::is_zero(&y) {
        return Err(element.error(ErrorKind::BadValue, "has parallel axes in `xyaxes`; give two directions"));
    }
    let (x, y) = (unit(&x), unit(&y));
    let z = vector::cross(&x, &y);
    from_columns(&[x, y, z]).map(plain).ok_or_else(|| zero(element, "xyaxes"))
}

/// `zaxis`: the z axis, by the smallest rotation of the parent's z axis.
fn z_axis(element: &Element) -> Result<Placement> {
    let Some(axis) = element.numbers::<3>("zaxis")? else { return Ok(Placement::identity()) };
    from_z(&axis).ok_or_else(|| zero(element, "zaxis"))
}

/// The smallest rotation that gives the z axis this direction; about x for the opposite direction. `None` for zero.
pub fn from_z(axis: &ExactVector) -> Option<Placement> {
    if vector::is_zero(axis) {
        return None;
    }
    let [x, y, z] = axis;
    // The quaternion of the rotation from z to the axis is (1 + cos, z cross axis), up to scale.
    let w = length(axis) + z;
    if w.is_zero() || (x.is_zero() && y.is_zero() && z.is_negative()) {
        return Some(plain(ExactRotation::about(0, Turn::from_degrees(&BigRational::from_integer(180.into())).ok()?)));
    }
    ExactRotation::from_quaternion(&[-y, x.clone(), BigRational::zero(), w]).map(plain)
}

/// The length of a vector: exact when it is rational, else within 2^-80 of the larger of one and the length.
fn length(a: &ExactVector) -> BigRational {
    let square = vector::dot(a, a);
    let [numerator, denominator] = [square.numer(), square.denom()].map(BigInt::sqrt);
    if &(&numerator * &numerator) == square.numer() && &(&denominator * &denominator) == square.denom() {
        return BigRational::new(numerator, denominator);
    }
    // Very short vectors keep their digits.
    let excess = square.denom().bits().saturating_sub(square.numer().bits());
    let shift = 160 + 2 * (excess / 2);
    let scaled = (&square * BigRational::from_integer(BigInt::one() << shift)).to_integer();
    BigRational::new(scaled.sqrt(), BigInt::one() << (shift / 2))
}

fn unit(a: &ExactVector) -> ExactVector {
    let length = length(a);
    if length.is_zero() { a.clone() } else { a.each_ref().map(|entry| entry / &length) }
}

/// The rotation whose matrix has these orthonormal columns, from the largest of four quaternions that are equal up to
/// scale.
fn from_columns([x, y, z]: &[ExactVector; 3]) -> Option<ExactRotation> {
    let one = BigRational::one();
    let [xx, yy, zz] = [&x[0], &y[1], &z[2]];
    // Off-diagonal sums and differences of the matrix m, with m[row][column] = column[row].
    let (w_x, w_y, w_z) = (&y[2] - &z[1], &z[0] - &x[2], &x[1] - &y[0]);
    let (x_y, x_z, y_z) = (&y[0] + &x[1], &z[0] + &x[2], &z[1] + &y[2]);
    // x, y, z, w.
    let candidates = [
        [w_x.clone(), w_y.clone(), w_z.clone(), &one + xx + yy + zz],
        [&one + xx - yy - zz, x_y.clone(), x_z.clone(), w_x],
        [x_y, &one - xx + yy - zz, y_z.clone(), w_y],
        [x_z, y_z, &one - xx - yy + zz, w_z],
    ];
    let size = |quaternion: &[BigRational; 4]| -> BigRational { quaternion.iter().map(|part| part * part).sum() };
    let largest = candidates.into_iter().max_by(|a, b| size(a).cmp(&size(b)))?;
    ExactRotation::from_quaternion(&largest)
}
