//! The soles of a described robot and the frame in which it walks. Main type: [`Footing`].

use std::sync::Arc;

use nalgebra::{Matrix3, Point2, Point3, Rotation3, UnitQuaternion, Vector3};

use super::biped::{Biped, Foot};
use super::contact::{self, Outline};
use super::legs::{LegSolver, pointing};
use super::limbs;
use super::mirrored::Mirrored;
use super::walker::{Walker, rest};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigInt, BigRational};
use groebot_robot::document::shown;
use groebot_robot::dynamics::Model;
use groebot_robot::kinematics::{Chain, Task};
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::spatial::Pose;
use groebot_robot::spatial::exact::{ExactRotation, ExactVector, Placement, Turn, normalized, numeric_rotation};

/// The greatest angle between an axis of the root and a direction of the robot: the cosine of 45 degrees.
const ALONG: f64 = 0.7;
/// The offset of a sole's middle from its ankle that tells front from back, as a fraction of the sole's length.
const AHEAD: f64 = 0.05;
/// The least difference between entries of a direction and the nearest unit vector that is not rounding.
const ROUNDING: f64 = 1e-6;
/// The height of the box that takes the place of a sole's shapes \[m\].
const THICK: f64 = 0.01;

/// The soles of a described robot, the frame of its torso, and what had to be assumed or changed to find them.
///
/// The torso is the root link with the axes x forward, y left, z up. A robot whose root has other axes gets a new root,
/// turned by quarter turns. Joints that move both legs are held at zero, or at the nearest limit.
#[derive(Clone, Debug)]
pub struct Footing {
    robot: Robot,
    torso_from_root: Pose,
    links: [usize; 2],
    outlines: [Outline; 2],
    /// Whether the outlines are those of the robot's own collision shapes.
    is_own: bool,
    notes: Vec<String>,
}

impl Footing {
    /// Finds the soles of `robot`. `links` are the given ones, left and right; the others are searched: the ends of the
    /// two mirrored limbs that are the lowest. `outline` is the height of the soles' plane above their links' origins
    /// and the corners of both soles, in the axes of the torso \[m\]. By default these are the lowest points of the
    /// collision shapes, else of the visual shapes, else a rectangle by the length of the leg.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for links that do not exist; [`ErrorKind::MissingKey`] when the soles are not found;
    /// [`ErrorKind::BadValue`] when the legs do not point along an axis of the root at zero; those of [`Model::new`].
    pub fn find(
        robot: &Robot,
        meshes: &Meshes,
        links: [Option<&str>; 2],
        outline: Option<(f64, [Vec<Point2<f64>>; 2])>,
    ) -> Result<Self> {
        let mut links = limbs::soles(robot, &Model::new(robot)?, links)?;
        let mut notes = Vec::new();
        let robot = held(robot, links, &mut notes)?;
        let mut turned = at_torso(&robot, links)?;
        let own = [0, 1].map(|side| Contact::of(&turned, links[side], meshes));
        let names = limbs::says(links.map(|link| robot.links()[link].name.as_str()));
        if is_exchanged(names, Contact::is_ahead(&own), &mut notes) {
            links.reverse();
            let name = |link: usize| shown(&robot.links()[link].name);
            let text = format!(
                "`{}` is the left sole and `{}` the right one, by their names and shapes",
                name(links[0]),
                name(links[1])
            );
            notes.push(text);
            turned = at_torso(&robot, links)?;
        }
        let own = [0, 1].map(|side| Contact::of(&turned, links[side], meshes));
        let is_own = outline.is_none() && own.iter().all(|contact| contact.outline.is_some() && contact.collides);
        let outlines = match outline {
            Some((height, corners)) => corners.map(|corners| Outline::level((height, corners))),
            None => own.map(|contact| contact.outline_or_assumed(&turned, &mut notes)),
        };
        if outlines[0].pitch != 0.0 {
            notes.push(format!(
                "the soles are not level at zero: they are pitched by {:.1} deg",
                outlines[0].pitch.to_degrees()
            ));
        }
        let Turned { robot, torso_from_root, .. } = turned;
        Ok(Footing { robot, torso_from_root, links, outlines, is_own, notes })
    }

    /// The links of the soles, left and right.
    pub fn soles(&self) -> [&str; 2] {
        self.links.map(|link| self.robot.links()[link].name.as_str())
    }

    /// What was assumed or changed, one line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The robot that the walker plans with: its root is the torso, and joints that move both legs are fixed.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Makes the walker. `derive` makes the solver of a leg from its chain from the torso to the link of the sole. Its
    /// task is a pose for six joints. For five joints it is a ray: the rotation of the sole that the leg cannot hold is
    /// free.
    ///
    /// # Errors
    /// Those of [`Biped::new`], [`Walker::new`] and `derive`.
    pub fn walker(&self, derive: impl Fn(&Chain) -> Result<LegSolver>) -> Result<Walker> {
        let biped = Biped::on(&self.robot, self.links, self.outlines.clone(), self.torso_from_root)?;
        let solver = |side: usize| -> Result<LegSolver> {
            let foot = &biped.feet[side];
            let chain = self.robot.chain(None, Some(self.soles()[side]))?;
            if foot.joints.len() != 5 {
                return derive(&chain);
            }
            let (_, torso_from_link) = biped.model.link(foot.link);
            let in_torso = foot.torso_from_sole.rotation * held_direction(&biped, foot)?;
            let direction = exact(&(torso_from_link.rotation.inverse() * in_torso));
            let chain = chain.with_task(Task::Ray, direction.clone(), Vec::new())?;
            Ok(Arc::new(pointing(derive(&chain)?, normalized(&direction).into_inner())))
        };
        let left = solver(0)?;
        let is_whole = biped.feet.iter().all(|foot| foot.joints.len() == 6);
        let right: LegSolver = match Mirrored::right(&biped, &left).filter(|_| is_whole) {
            Some(right) => Arc::new(right),
            None => solver(1)?,
        };
        Walker::new(&self.robot, biped.clone(), [left, right])
    }

    /// `robot`, the one of [`Footing::find`], with a box as the collision shape of each foot where the soles are not
    /// those of its own collision shapes.
    ///
    /// # Errors
    /// Those of [`Robot::with_contact_box`].
    pub fn shod(&self, robot: &Robot) -> Result<Robot> {
        if self.is_own {
            return Ok(robot.clone());
        }
        let model = Model::new(&self.robot)?;
        let mut shod = robot.clone();
        for (link, outline) in self.links.into_iter().zip(&self.outlines) {
            let (low, high) = contact::bounds(&outline.corners);
            let link_from_sole = model.link(link).1.rotation.inverse() * outline.axes();
            let middle = Vector3::new((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, outline.height + THICK / 2.0);
            let link_from_box = Pose::from_parts((link_from_sole * middle).into(), link_from_sole);
            shod = shod.with_contact_box(link, &link_from_box, [high.x - low.x, high.y - low.y, THICK])?;
        }
        Ok(shod)
    }
}

/// A robot whose root link is its torso.
struct Turned {
    robot: Robot,
    model: Model,
    torso_from_root: Pose,
}

/// The contact area of a foot by its shapes.
struct Contact {
    link: usize,
    /// Its ankle, the origin of the link that its last joint moves, from the link's origin in the torso's axes.
    ankle: Point3<f64>,
    outline: Option<Outline>,
    /// Whether the shapes are collision shapes.
    collides: bool,
    /// Why a shape could not be read.
    reason: Option<Error>,
}

impl Contact {
    fn of(turned: &Turned, link: usize, meshes: &Meshes) -> Self {
        let Turned { robot, model, .. } = turned;
        let (points, errors) = contact::points(robot, model, link, meshes);
        let (body, torso_from_link) = model.link(link);
        let joint = robot.moving()[body.saturating_sub(1)];
        let ankle = model.link(robot.ends(joint).1).1.translation.vector - torso_from_link.translation.vector;
        let outline = Some(contact::lowest(&points)).filter(|outline| outline.corners.len() >= 3);
        let own = (0..robot.links().len()).filter(|place| model.link(*place).0 == body);
        let collides = own.into_iter().any(|place| !robot.links()[place].collisions.is_empty());
        Contact { link, ankle: ankle.into(), outline, collides, reason: errors.into_iter().next() }
    }

    /// Whether the soles extend further forward of the ankles than backward; `None` if they have no shape or are
    /// symmetric.
    fn is_ahead(feet: &[Contact; 2]) -> Option<bool> {
        let ahead = |contact: &Contact| {
            let (low, high) = contact::bounds(&contact.outline.as_ref()?.corners);
            Some(((low.x + high.x) / 2.0 - contact.ankle.x) / (high.x - low.x))
        };
        let share = (ahead(&feet[0])? + ahead(&feet[1])?) / 2.0;
        (share.abs() > AHEAD).then_some(share > 0.0)
    }

    /// The contact area of the shapes, else a rectangle by the length of the leg.
    fn outline_or_assumed(self, turned: &Turned, notes: &mut Vec<String>) -> Outline {
        let name = shown(&turned.robot.links()[self.link].name);
        if let Some(outline) = self.outline {
            return outline;
        }
        let joints = turned.model.path(turned.model.link(self.link).0);
        let outline = contact::assumed(limbs::leg_length(&turned.model, &joints), &self.ankle);
        let (low, high) = contact::bounds(&outline.corners);
        let reason = self.reason.map(|error| format!(" ({error})")).unwrap_or_default();
        notes.push(format!(
            "link `{name}` has no shape that groebot reads{reason}; its sole is assumed to be {:.0} x {:.0} mm; give --outline {:.3},{:.3},{:.3},{:.3},{:.3} or better numbers",
            1e3 * (high.x - low.x),
            1e3 * (high.y - low.y),
            low.x,
            high.x,
            low.y,
            high.y,
            outline.height
        ));
        outline
    }
}

/// Whether left and right have to be exchanged, by the names of the links and by the shapes of the soles, each true if
/// it agrees with the sides.
fn is_exchanged(names: Option<bool>, shapes: Option<bool>, notes: &mut Vec<String>) -> bool {
    match (names, shapes) {
        (Some(true), Some(false)) => {
            let text = "the soles extend further back than forward of the ankles; if the robot faces backward, exchange --left and --right";
            notes.push(text.to_owned());
            false
        }
        (Some(names), Some(shapes)) => !names && !shapes,
        (Some(agrees), None) | (None, Some(agrees)) => !agrees,
        (None, None) => false,
    }
}

/// Fixes the joints that move both feet.
///
/// # Errors
/// [`ErrorKind::BadValue`] for soles whose legs have no three joints of their own.
fn held(robot: &Robot, links: [usize; 2], notes: &mut Vec<String>) -> Result<Robot> {
    let joints = |link: usize| {
        let single = robot.ancestry(link).into_iter().filter(|joint| robot.joints()[*joint].kind.is_single());
        single.collect::<Vec<usize>>()
    };
    let [left, right] = links.map(joints);
    let shared: Vec<usize> = right.iter().copied().filter(|joint| left.contains(joint)).collect();
    for (link, leg) in links.into_iter().zip([&left, &right]) {
        let (own, name) = (leg.len() - shared.len(), shown(&robot.links()[link].name));
        if own < limbs::LEAST_JOINTS {
            let text = match shared.first() {
                Some(joint) => format!(
                    "joint `{}` moves both feet; give the soles of two legs by --left and --right",
                    shown(&robot.joints()[*joint].name)
                ),
                None => format!(
                    "there are {own} joints between the root and `{name}`; a leg needs at least 3 (--left, --right)"
                ),
            };
            return Err(Error::new(ErrorKind::BadValue, format!("{}: {text}", robot.name())));
        }
    }
    let held: Vec<(usize, f64)> =
        shared.into_iter().map(|joint| (joint, rest(robot.joints()[joint].limits.unwrap_or_default()))).collect();
    for (joint, value) in &held {
        let name = shown(&robot.joints()[*joint].name);
        notes.push(format!("joint `{name}` is between the root and both legs; it is held at {value}"));
    }
    if held.is_empty() { Ok(robot.clone()) } else { robot.with_held(&held) }
}

/// The robot with the root at its torso: z from the feet to the hips, y from the right to the left sole.
fn at_torso(robot: &Robot, links: [usize; 2]) -> Result<Turned> {
    let model = Model::new(robot)?;
    let torso_from_root = upright(robot, &model, links)?;
    if torso_from_root.angle() == 0.0 {
        return Ok(Turned { robot: robot.clone(), model, torso_from_root: Pose::identity() });
    }
    let turn = quarter_turns(&torso_from_root)?;
    let placement = Placement { rotation: turn, ..Placement::identity() };
    let torso_from_root = placement.pose();
    let robot = robot.with_root("torso", placement)?;
    let model = Model::new(&robot)?;
    Ok(Turned { robot, model, torso_from_root })
}

/// The rotation from the root to axes forward, to the left and up, along axes of the root.
fn upright(robot: &Robot, model: &Model, links: [usize; 2]) -> Result<UnitQuaternion<f64>> {
    let moving = robot.moving();
    let origin = |joint: usize| model.link(robot.ends(moving[joint]).1).1.translation.vector;
    let legs = links.map(|link| model.path(model.link(link).0));
    let [[hip, ankle], [other, end]] = legs.each_ref().map(|leg| [origin(leg[0]), origin(leg[leg.len() - 1])]);
    let up = nearest_axis(&((hip + other) - (ankle + end)));
    let left = up.and_then(|up| {
        let apart = ankle - end;
        nearest_axis(&(apart - up * up.dot(&apart)))
    });
    let (Some(up), Some(left)) = (up, left) else {
        let name = shown(robot.name());
        let text = format!(
            "{name}: the legs do not point along an axis of the root link at zero; turn the root link, or give other links by --left and --right"
        );
        return Err(Error::new(ErrorKind::BadValue, text));
    };
    let rows = Matrix3::from_rows(&[left.cross(&up).transpose(), left.transpose(), up.transpose()]);
    Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rows)))
}

/// The coordinate axis that is nearest to a direction, with its sign; `None` if the direction is between axes.
fn nearest_axis(direction: &Vector3<f64>) -> Option<Vector3<f64>> {
    let axis = direction.iamax();
    let share = direction[axis] / direction.norm();
    (share.abs() > ALONG).then(|| Vector3::ith(axis, share.signum()))
}

/// The exact rotation by quarter turns that is `rotation` up to rounding.
fn quarter_turns(rotation: &UnitQuaternion<f64>) -> Result<ExactRotation> {
    let quarter = |count: i32| Turn::from_degrees(&BigRational::from_integer(BigInt::from(90 * count)));
    for count in 0..64 {
        let turns = [quarter(count % 4)?, quarter(count / 4 % 4)?, quarter(count / 16)?];
        let exact = ExactRotation::from_rpy(turns);
        if numeric_rotation(&exact.matrix()).angle_to(rotation) < ROUNDING {
            return Ok(exact);
        }
    }
    Err(Error::new(ErrorKind::BadValue, "the frame of the root is not a rotation by quarter turns"))
}

/// The direction of the sole, in its own axes, that a leg of five joints holds; the rotation about it is free.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a leg that cannot turn its sole about the vertical.
fn held_direction(biped: &Biped, foot: &Foot) -> Result<Vector3<f64>> {
    let along =
        |joint: &usize| biped.model.joints()[*joint].screw.axis().map_or(Vector3::x(), |axis| *axis.direction());
    let turns = foot.joints.iter().any(|joint| along(joint).z.abs() > ALONG);
    if !turns {
        let text = format!(
            "{}: a leg has 5 joints, none of which turns the sole about the vertical; such legs are not supported",
            biped.name
        );
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let rolls = foot.joints.last().is_some_and(|joint| along(joint).x.abs() > ALONG);
    Ok(if rolls { Vector3::y() } else { Vector3::x() })
}

/// A direction with exact entries: those of a unit vector along an axis up to rounding.
fn exact(direction: &Vector3<f64>) -> ExactVector {
    direction.data.0[0].map(|entry| {
        let whole = entry.round();
        let entry = if (entry - whole).abs() < ROUNDING { whole } else { entry };
        BigRational::from_float(entry).unwrap_or_default()
    })
}
