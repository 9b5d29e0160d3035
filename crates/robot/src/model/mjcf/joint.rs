//! Joints of an MJCF: hinges, slides and balls.

use num_traits::ToPrimitive;

use super::compiler::{Compiler, double};
use super::defaults::Styled;
use super::frame::about;
use crate::model::JointType;
use crate::spatial::exact::{ExactVector, Placement, vector};
use crate::{ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The half range of a slide without limits \[m\]. A robot's prismatic joint has finite limits.
pub const UNLIMITED: f64 = 1000.0;
/// The names of the three hinges of a ball joint.
const BALL: [&str; 3] = ["x", "y", "z"];

/// A joint with one degree of freedom, in the frame of its body.
pub struct Axis {
    /// What is added to the joint's name: `_x`, `_y` or `_z` for a ball joint.
    pub suffix: String,
    pub kind: JointType,
    /// The direction of the axis.
    pub axis: ExactVector,
    /// The point of the axis \[m\].
    pub anchor: ExactVector,
    /// The frame of the joint at the value zero, relative to the frame at the value `ref`.
    pub zero: Placement,
    /// Minimum and maximum \[rad or m\].
    pub limits: Option<(f64, f64)>,
    /// The largest torque or force of all actuators together \[N m or N\].
    pub effort: Option<f64>,
    pub damping: f64,
    pub friction: f64,
    pub armature: f64,
    /// The value in the model's initial position \[rad or m\].
    pub reference: BigRational,
    pub notes: Vec<String>,
}

/// Reads a `<joint>` that is not free: one hinge or slide, or the three hinges of a ball.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a type or a number that is not allowed, and for a zero axis.
pub fn read(styled: &Styled<'_>, compiler: &Compiler) -> Result<Vec<Axis>> {
    let anchor = styled.numbers::<3>("pos")?.unwrap_or_else(vector::zero);
    let kind = styled.choice("type", &["hinge", "slide", "ball", "free"])?.unwrap_or("hinge");
    let mut notes = stiffness(styled)?;
    if kind == "ball" {
        notes.push("it is read as three hinges about x, y and z: a ball joint".to_owned());
        if styled.holder("range").is_some() {
            notes.push("the range of a ball joint is ignored".to_owned());
        }
        let hinge = |index: usize| {
            let notes = if index == 0 { notes.clone() } else { Vec::new() };
            let axis =
                Axis { suffix: format!("_{}", BALL[index]), ..blank(vector::unit(index), anchor.clone(), notes) };
            with_dynamics(axis, styled)
        };
        return (0..3).map(hinge).collect();
    }
    let axis = styled.numbers::<3>("axis")?.unwrap_or_else(|| vector::unit(2));
    if vector::is_zero(&axis) {
        return Err(styled.error(ErrorKind::BadValue, "has `axis` = 0 0 0; give a direction"));
    }
    let slides = kind == "slide";
    let range = range(styled, compiler, slides)?;
    let given = styled.numbers::<1>("ref")?.map(|[value]| value).unwrap_or_default();
    let zero = match styled.holder("ref") {
        Some(holder) if !slides => about(holder, &axis, &-&given, compiler.degrees)?,
        _ => Placement::shifted_along(&axis, &-&given),
    };
    let turns = !slides && compiler.degrees;
    let reference = if turns { exact(double(&given).to_radians()) } else { given };
    let mut read = Axis { zero, reference, ..blank(axis, anchor, notes) };
    (read.kind, read.limits) = match (slides, range) {
        (false, None) => (JointType::Continuous, None),
        (false, limits) => (JointType::Revolute, limits),
        (true, None) => {
            read.notes.push(format!("it has no range; {UNLIMITED} m in both directions are taken"));
            (JointType::Prismatic, Some((-UNLIMITED, UNLIMITED)))
        }
        (true, limits) => (JointType::Prismatic, limits),
    };
    Ok(vec![with_dynamics(read, styled)?])
}

fn exact(number: f64) -> BigRational {
    BigRational::from_float(number).unwrap_or_default()
}

fn blank(axis: ExactVector, anchor: ExactVector, notes: Vec<String>) -> Axis {
    Axis {
        suffix: String::new(),
        kind: JointType::Continuous,
        axis,
        anchor,
        zero: Placement::identity(),
        limits: None,
        effort: None,
        damping: 0.0,
        friction: 0.0,
        armature: 0.0,
        reference: BigRational::default(),
        notes,
    }
}

fn with_dynamics(mut axis: Axis, styled: &Styled<'_>) -> Result<Axis> {
    // A damping may be a polynomial in the velocity; its first number is the viscous one.
    let damping = styled.list("damping", 1..=8)?.unwrap_or_default();
    if damping.len() > 1 {
        axis.notes.push("the nonlinear part of its damping is ignored".to_owned());
    }
    axis.damping = damping.first().and_then(ToPrimitive::to_f64).unwrap_or(0.0);
    axis.friction = styled.float("frictionloss")?.unwrap_or(0.0);
    axis.armature = styled.float("armature")?.unwrap_or(0.0);
    if styled.holder("springdamper").is_some() {
        axis.notes.push("its `springdamper` is ignored, with the damping that follows from it".to_owned());
    }
    if let Some([low, high]) = styled.floats("actuatorfrcrange")?
        && is_limited(styled, "actuatorfrclimited", [low, high], true)?
    {
        axis.effort = Some(low.abs().max(high.abs()));
    }
    Ok(axis)
}

fn stiffness(styled: &Styled<'_>) -> Result<Vec<String>> {
    let springs = styled.list("stiffness", 1..=8)?.is_some_and(|all| all.iter().any(|x| *x != BigRational::default()));
    Ok(if springs { vec!["its spring (stiffness) is ignored".to_owned()] } else { Vec::new() })
}

/// The range in radians or metres, if it limits the joint.
fn range(styled: &Styled<'_>, compiler: &Compiler, slides: bool) -> Result<Option<(f64, f64)>> {
    let given = styled.floats("range")?;
    if !is_limited(styled, "limited", given.unwrap_or_default(), compiler.auto_limits)? {
        return Ok(None);
    }
    let Some([low, high]) = given else {
        return Err(styled.error(ErrorKind::MissingKey, "is limited and has no `range`; give one"));
    };
    if low >= high {
        let text = format!("has `range` = {low} {high}; give the lower limit first");
        return Err(styled.error(ErrorKind::BadValue, &text));
    }
    let unit = |value: f64| if slides { value } else { compiler.radians(value) };
    Ok(Some((unit(low), unit(high))))
}

/// Whether `switch` (true, false or auto) makes a range a limit. By `auto` a range limits if it is not empty.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another word.
pub fn is_limited(styled: &Styled<'_>, switch: &str, [low, high]: [f64; 2], is_auto: bool) -> Result<bool> {
    let word = styled.choice(switch, &["true", "false", "auto"])?.unwrap_or("auto");
    Ok(word == "true" || (word == "auto" && is_auto && low < high))
}
