//! The legs of a described robot: two mirrored limbs that are the lowest, and the side that their names say.

use nalgebra::Point3;

use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;
use groebot_robot::dynamics::Model;
use groebot_robot::model::Robot;

/// The least number of joints of a leg.
pub(super) const LEAST_JOINTS: usize = 3;
/// The least cosine of the angle between the lateral direction and an axis that swings a leg forward. NAO's axis for
/// yaw and pitch is at 45 degrees.
const ACROSS: f64 = 0.8;
/// The greatest deviation of two legs from a mirror image, as a fraction of their size.
const MIRRORED: f64 = 0.05;
/// Frames of a sole whose heights differ by less are at one height \[m\]: iCub's frames of its skin are 3.5 mm below that
/// of its sole.
const LEVEL: f64 = 0.01;

/// A limb: its last link, its joints from the root, and the origins of the links that they move, at the zero
/// configuration \[m\].
struct Limb {
    link: usize,
    joints: Vec<usize>,
    places: Vec<Point3<f64>>,
}

/// The links of the soles, left and right: the given ones; otherwise the ends of the two mirrored limbs that are the
/// lowest along the root's z axis. Of the frames fixed to a limb's end it is the lowest.
///
/// # Errors
/// [`ErrorKind::UnknownName`] for a link that does not exist; [`ErrorKind::MissingKey`] when no two limbs are mirrored.
pub(super) fn soles(robot: &Robot, model: &Model, given: [Option<&str>; 2]) -> Result<[usize; 2]> {
    if let [Some(left), Some(right)] = given {
        return Ok([robot.link(left)?, robot.link(right)?]);
    }
    let known = |name: Option<&str>| name.map(|name| robot.link(name)).transpose();
    let (left, right) = (known(given[0])?, known(given[1])?);
    let limb = |tip: &str| Ok(Limb::new(robot, model, robot.link(tip)?));
    let limbs: Vec<Limb> = robot.tips().into_iter().map(limb).collect::<Result<_>>()?;
    let is_at =
        |limb: &Limb, link: &Option<usize>| link.is_none_or(|link| model.link(link).0 == model.link(limb.link).0);
    let mut best: Option<(f64, [usize; 2])> = None;
    for (place, one) in limbs.iter().enumerate() {
        for other in &limbs[place + 1..] {
            let Some(axis) = one.mirrored(other).filter(|axis| *axis != 2) else { continue };
            let Some(pair) = ordered(robot, [one, other], axis, |pair| is_at(pair[0], &left) && is_at(pair[1], &right))
            else {
                continue;
            };
            let height = one.end().z.min(other.end().z);
            if best.is_none_or(|(lowest, _)| height < lowest) {
                let [a, b] = lowest(robot, model, pair);
                best = Some((height, [left.unwrap_or(a), right.unwrap_or(b)]));
            }
        }
    }
    best.map(|(_, links)| links).ok_or_else(|| unknown(robot))
}

/// The links of a pair of limbs, left and right by their names, else with the left one at greater y, or less x where
/// the limbs are apart along x. `fits` says whether an order agrees with the given links.
fn ordered(robot: &Robot, pair: [&Limb; 2], axis: usize, fits: impl Fn([&Limb; 2]) -> bool) -> Option<[usize; 2]> {
    let [one, other] = pair;
    let sign = if axis == 1 { 1.0 } else { -1.0 };
    let names = pair.map(|limb| robot.links()[limb.link].name.as_str());
    let by_place = sign * (one.end()[axis] - other.end()[axis]) > 0.0;
    let straight = says(names).unwrap_or(by_place);
    let order = if straight { [one, other] } else { [other, one] };
    let back = [order[1], order[0]];
    let order = if fits(order) { order } else { Some(back).filter(|order| fits(*order))? };
    Some(order.map(|limb| limb.link))
}

impl Limb {
    fn new(robot: &Robot, model: &Model, link: usize) -> Self {
        let joints = model.path(model.link(link).0);
        let moving = robot.moving();
        let origin = |joint: &usize| model.link(robot.ends(moving[*joint]).1).1.translation.vector.into();
        Limb { link, places: joints.iter().map(origin).collect(), joints }
    }

    fn end(&self) -> Point3<f64> {
        self.places.last().copied().unwrap_or_default()
    }

    /// The coordinate axis along which the two limbs are mirrored; `None` if they are not.
    fn mirrored(&self, other: &Limb) -> Option<usize> {
        let shared = self.joints.iter().zip(&other.joints).take_while(|(a, b)| a == b).count();
        if self.joints.len() != other.joints.len() || self.joints.len() < shared + LEAST_JOINTS {
            return None;
        }
        let size = self.places.iter().map(|place| (place - self.end()).norm()).fold(0.0, f64::max);
        let apart = (self.end() - other.end()).abs();
        let axis = apart.iamax();
        let middle = (self.end()[axis] + other.end()[axis]) / 2.0;
        let is_image = |(one, image): (&Point3<f64>, &Point3<f64>)| {
            let mut image = *image;
            image[axis] = 2.0 * middle - image[axis];
            (one - image).norm() <= MIRRORED * size
        };
        let mirrored = self.places.iter().zip(&other.places).all(is_image);
        (mirrored && apart[axis] > MIRRORED * size).then_some(axis)
    }
}

/// The lowest frames, links without shapes, of those that are fixed to the two links and below them at the zero
/// configuration; of frames at one height the nearest to the vertical through the ankle. Their names say the same sides
/// as those of the links. Without such frames they are the links.
fn lowest(robot: &Robot, model: &Model, links: [usize; 2]) -> [usize; 2] {
    let at = |place: usize| model.link(place).1.translation.vector;
    let name = |place: usize| robot.links()[place].name.as_str();
    let [lefts, rights] = links.map(|link| {
        let body = model.link(link).0;
        let is_frame = |place: &usize| {
            let other = &robot.links()[*place];
            let is_fixed = model.link(*place).0 == body && at(*place).z < at(link).z;
            is_fixed && other.collisions.is_empty() && other.visuals.is_empty()
        };
        let frames: Vec<usize> = (0..robot.links().len()).filter(is_frame).collect();
        let lowest = frames.iter().map(|place| at(*place).z).fold(f64::INFINITY, f64::min);
        let ankle = at(robot.ends(robot.moving()[body.saturating_sub(1)]).1);
        let away = |place: &usize| (at(*place) - ankle).xy().norm();
        let mut frames: Vec<usize> = frames.into_iter().filter(|place| at(*place).z <= lowest + LEVEL).collect();
        frames.sort_by(|a, b| away(a).total_cmp(&away(b)));
        frames
    });
    let sides = says(links.map(name));
    let mut pairs = lefts.iter().flat_map(|left| rights.iter().map(move |right| [*left, *right]));
    pairs.find(|pair| says(pair.map(name)) == sides).unwrap_or(links)
}

/// Whether the first of two names is that of the left side and the second that of the right side, by the letters in
/// which they differ; `None` if these are neither.
pub(super) fn says(names: [&str; 2]) -> Option<bool> {
    let [one, other] = names.map(|name| name.to_lowercase().chars().collect::<Vec<char>>());
    let start = one.iter().zip(&other).take_while(|(a, b)| a == b).count();
    match (one.get(start), other.get(start)) {
        (Some('l'), Some('r')) => Some(true),
        (Some('r'), Some('l')) => Some(false),
        _ => None,
    }
}

fn unknown(robot: &Robot) -> Error {
    let ends = robot.suggested_tips(robot.root_place()).into_iter().take(20);
    let ends: Vec<String> = ends.map(|link| format!("`{}`", shown(link))).collect();
    let text = format!(
        "which links are the soles? no two limbs are mirrored to the left and the right; give --left and --right; the limbs end in {}",
        ends.join(", ")
    );
    Error::new(ErrorKind::MissingKey, text)
}

/// The joints of a leg that swing it forward, at the hip, the knee and the ankle: the first two and the last one whose
/// axes point to the left, as indices into a configuration. Without three of these, the third, the fourth and the last
/// joint.
pub(super) fn sagittal(model: &Model, joints: &[usize]) -> [usize; 3] {
    let to_the_left =
        |joint: &&usize| model.joints()[**joint].screw.axis().is_some_and(|axis| axis.direction().y.abs() > ACROSS);
    let across: Vec<usize> = joints.iter().filter(to_the_left).copied().collect();
    match across[..] {
        [hip, knee, .., ankle] => [hip, knee, ankle],
        _ => [2, 3, joints.len()].map(|place| joints[place.min(joints.len() - 1)]),
    }
}

/// The length of the stretched leg with these joints, seen from the side: from the hip through the knee to the ankle
/// \[m\].
pub(super) fn leg_length(model: &Model, joints: &[usize]) -> f64 {
    let at = |joint: usize| model.joints()[joint].screw.axis().map(|axis| axis.point().xz());
    let [hip, knee, ankle] = sagittal(model, joints).map(at);
    match (hip, knee, ankle) {
        (Some(hip), Some(knee), Some(ankle)) => (knee - hip).norm() + (ankle - knee).norm(),
        _ => 0.0,
    }
}
