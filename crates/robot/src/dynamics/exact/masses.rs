//! Exact inertial parameters of a chain's bodies, from a robot's description.

use num_traits::Zero;

use crate::kinematics::{Chain, LinkPath};
use crate::model::{Mass, Robot};
use crate::spatial::exact::{ExactMatrix, ExactVector, Placement};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// Computes ten inertial parameters for each joint of a chain along a path of a robot, in the frames of
/// [`ExactModel`](super::ExactModel). Links that the path's joints do not move are ignored. A body includes all links
/// that are fixed to it or connected by joints outside the path, which are at zero. Mimic joints with a multiplier of
/// zero have their constant value.
///
/// # Errors
/// Those of [`Robot::check`]; [`ErrorKind::Unsupported`] where the tip is not below the base, or several joints of the
/// path are one joint of the chain.
pub fn masses(robot: &Robot, path: &LinkPath, chain: &Chain) -> Result<Vec<[BigRational; 10]>> {
    robot.check()?;
    let robot = &robot.with_constants_fixed()?;
    let refused = |text: &str| Err(Error::new(ErrorKind::Unsupported, text.to_owned()));
    if path.joints.iter().any(|(_, upwards)| *upwards) {
        return refused("the tip is not below the base; choose links so that it is");
    }
    let moving: Vec<usize> =
        path.joints.iter().map(|(joint, _)| *joint).filter(|joint| robot.joints()[*joint].kind.is_single()).collect();
    if moving.len() != chain.joints().len() {
        return refused("joints of the path are coupled; choose links with independent joints between them");
    }
    let base = robot.link(&path.base)?;
    // For each link, its pose in the base frame and the joint of the path that moves it.
    let mut places: Vec<Option<(Placement, Option<usize>)>> = vec![None; robot.links().len()];
    places[base] = Some((Placement::identity(), None));
    let zeros = || std::array::from_fn::<BigRational, 10, _>(|_| BigRational::zero());
    let mut bodies = vec![zeros(); moving.len()];
    for &joint in robot.order() {
        let (parent, child) = robot.ends(joint);
        let Some((placement, mover)) = &places[parent] else { continue };
        let mover = moving.iter().position(|own| *own == joint).or(*mover);
        let placed = placement.then(&robot.joints()[joint].origin.placement);
        if let (Some(body), Some(mass)) = (mover, &robot.links()[child].mass) {
            let point = &chain.joints()[body].point;
            bodies[body].iter_mut().zip(numbers(mass, &placed, point)).for_each(|(sum, number)| *sum += number);
        }
        places[child] = Some((placed, mover));
    }
    Ok(bodies)
}

/// The inertial parameters of a link at a pose in the base frame, about a point, along the axes of the base.
fn numbers(mass: &Mass, placed: &Placement, point: &ExactVector) -> [BigRational; 10] {
    let at = placed.then(&mass.origin.placement);
    let centre: ExactVector = std::array::from_fn(|i| &at.origin[i] - &point[i]);
    let turn = at.meant().matrix();
    let [xx, xy, xz, yy, yz, zz] = mass.moments.clone();
    let tensor: ExactMatrix = [[xx, xy.clone(), xz.clone()], [xy, yy, yz.clone()], [xz, yz, zz]];
    let square: BigRational = centre.iter().map(|x| x * x).sum();
    let entry = |i: usize, j: usize| {
        let turned = (0..3).flat_map(|k| (0..3).map(move |l| (k, l)));
        let turned: BigRational = turned.map(|(k, l)| &turn[i][k] * &tensor[k][l] * &turn[j][l]).sum();
        let steiner = -(&centre[i] * &centre[j]) + if i == j { square.clone() } else { BigRational::zero() };
        turned + steiner * &mass.mass
    };
    let [x, y, z] = centre.each_ref().map(|x| x * &mass.mass);
    [mass.mass.clone(), x, y, z, entry(0, 0), entry(0, 1), entry(1, 1), entry(0, 2), entry(1, 2), entry(2, 2)]
}
