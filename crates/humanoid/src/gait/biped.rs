//! The model of a biped that a gait uses: joints, masses, soles. Main type: [`Biped`].

use nalgebra::{Point2, Point3, Vector3};

use super::contact::{Outline, touching};
use super::footprint::{Footprint, Side};
use super::limbs::sagittal;
use super::polygon::Polygon;
use crate::{Error, ErrorKind, Result};
use groebot_robot::dynamics::{Clearance, Model};
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::spatial::Pose;

/// A joint with the limits that a gait respects.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointRange {
    /// Its name in the robot's own documents.
    pub name: String,
    /// Its symbol in the source's formulas: `q3` there is `3` here; its name where it has none.
    pub symbol: String,
    /// Least and greatest value \[rad\].
    pub limits: (f64, f64),
    /// The greatest rate \[rad/s\]; infinite where none is given.
    pub speed: f64,
    /// The greatest torque or force of its motor \[N m or N\], where it is given.
    pub effort: Option<f64>,
}

/// A foot: the frame of its sole and its contact points.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Foot {
    /// The index in the robot of the link that the sole is fixed to.
    pub link: usize,
    /// The index of its body in the model.
    pub body: usize,
    /// The frame of the sole in the torso frame at the zero configuration: x forward, y left, z up; turned about y where
    /// the sole is not level there. Its origin is in the plane of the sole.
    pub torso_from_sole: Pose,
    /// The height of the ankle's last axis above the sole \[m\].
    pub ankle_height: f64,
    /// The corners of the contact area, in the frame of the sole \[m\].
    pub corners: Vec<Point2<f64>>,
    /// The joints from the torso to the sole, as indices into a configuration.
    pub joints: Vec<usize>,
}

/// A biped: its joints, masses and soles. The torso is the root link, with x forward, y left, z up; the feet are level
/// at the zero configuration, or pitched. [`Footing`](super::Footing) makes it from descriptions with other frames.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Biped {
    /// Its name.
    pub name: String,
    /// The joints in the order of a configuration and of the output.
    pub joints: Vec<JointRange>,
    /// Pairs of joints of the left and the right leg that one actuator moves by the same angle.
    pub shared: Vec<(usize, usize)>,
    /// The dynamic model; its base is the torso.
    pub model: Model,
    /// The feet, left and right.
    pub feet: [Foot; 2],
    /// The positions of the hips, left and right, in the torso frame \[m\]: on the first joint that swings the leg
    /// forward.
    pub hips: [Point3<f64>; 2],
    /// The pairs of links that may touch each other.
    pub clearance: Clearance,
    /// The root link of the description in the frame of the torso: the identity unless the link has other axes than x
    /// forward, y left, z up.
    pub torso_from_root: Pose,
    /// The names of the links, by their indices in the robot.
    pub links: Vec<String>,
    /// Whether the whole mass is a point at the torso's centre of mass, because the links' own masses are not given.
    pub is_point_mass: bool,
}

impl Biped {
    /// Makes the biped whose soles are the links `soles` of `robot`, left and right. The contact points are the lowest
    /// points of all collision shapes fixed to these links; triangles are read from `meshes`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for links that do not exist. [`ErrorKind::BadValue`] for legs that share a joint or
    /// have fewer than three, a sole without shape, a robot without mass or a joint without limits. Those of
    /// [`Meshes::points`].
    pub fn new(robot: &Robot, soles: [&str; 2], meshes: &Meshes) -> Result<Self> {
        let links = [robot.link(soles[0])?, robot.link(soles[1])?];
        let model = Model::new(robot)?;
        let outlines = [touching(robot, &model, links[0], meshes)?, touching(robot, &model, links[1], meshes)?];
        Biped::with_outlines(robot, model, links, outlines)
    }

    /// Same as [`Biped::new`], but with soles that cover the given points, in planes `height` above their links'
    /// origins \[m\].
    ///
    /// # Errors
    /// As [`Biped::new`], except those about shapes.
    pub fn on_outlines(robot: &Robot, soles: [&str; 2], height: f64, outlines: [Vec<Point2<f64>>; 2]) -> Result<Self> {
        let links = [robot.link(soles[0])?, robot.link(soles[1])?];
        Biped::with_outlines(
            robot,
            Model::new(robot)?,
            links,
            outlines.map(|corners| Outline::level((height, corners))),
        )
    }

    /// Same as [`Biped::new`], but with the links' indices, with soles by `outlines`, and with the frame of the torso.
    pub(super) fn on(robot: &Robot, links: [usize; 2], outlines: [Outline; 2], torso_from_root: Pose) -> Result<Self> {
        let biped = Biped::with_outlines(robot, Model::new(robot)?, links, outlines)?;
        Ok(Biped { torso_from_root, ..biped })
    }

    /// `outlines` are the height of each sole's plane above its link's origin, and the contact points in that plane.
    fn with_outlines(robot: &Robot, model: Model, links: [usize; 2], outlines: [Outline; 2]) -> Result<Self> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, format!("{}: {text}", robot.name())));
        if model.mass().is_nan() || model.mass() <= 0.0 {
            return bad("it has no mass; a walk needs the masses of its links".to_owned());
        }
        let [left, right] = [0, 1].map(|side| foot(&model, links[side], &outlines[side]));
        for (foot, link) in [&left, &right].into_iter().zip(links) {
            let name = &robot.links()[link].name;
            if foot.joints.len() < 3 {
                return bad(format!(
                    "there are {} joints between the root and `{name}`; a leg needs at least 3",
                    foot.joints.len()
                ));
            }
            if foot.corners.len() < 3 {
                return bad(format!(
                    "`{name}` has no collision shape that could touch the floor; give the outline of the soles (--outline)"
                ));
            }
        }
        if let Some(joint) = left.joints.iter().find(|joint| right.joints.contains(joint)) {
            let name = &model.joints()[*joint].name;
            return bad(format!(
                "joint `{name}` moves both feet; the root link must be the torso that carries both legs"
            ));
        }
        let hip = |foot: &Foot| {
            let [hip, ..] = sagittal(&model, &foot.joints);
            model.joints()[hip].screw.axis().map_or(Point3::origin(), |axis| axis.point())
        };
        let shared = |actuator: &groebot_robot::model::Actuator| {
            let places: Vec<usize> = actuator.joints.iter().filter_map(|(name, _)| model.joint(name).ok()).collect();
            let of = |foot: &Foot| places.iter().copied().find(|joint| foot.joints.contains(joint));
            Some((of(&left)?, of(&right)?))
        };
        let moving = robot.moving();
        let law = |joint: usize| robot.law(&robot.joints()[moving[joint]]);
        let pairs = left.joints.iter().flat_map(|&one| right.joints.iter().map(move |&other| (one, other)));
        let follow = |(one, other): &(usize, usize)| law(*one) == law(*other);
        Ok(Biped {
            name: robot.name().to_owned(),
            joints: ranges(robot, &model)?,
            shared: robot.actuators().iter().filter_map(shared).chain(pairs.filter(follow)).collect(),
            hips: [hip(&left), hip(&right)],
            is_point_mass: (1..=model.joints().len()).all(|body| model.inertia_of(body).mass() == 0.0),
            feet: [left, right],
            clearance: Clearance::new(robot, &model),
            torso_from_root: Pose::identity(),
            links: robot.links().iter().map(|link| link.name.clone()).collect(),
            model,
        })
    }

    /// The index of the joint `name` in a configuration.
    ///
    /// # Errors
    /// [`crate::ErrorKind::UnknownName`] when no joint has that name.
    pub fn joint(&self, name: &str) -> Result<usize> {
        self.model.joint(name)
    }

    /// The unit of a joint's torque or force.
    pub(super) fn torque_unit(&self, joint: usize) -> &'static str {
        if self.model.joints()[joint].screw.axis().is_none() { "N" } else { "N m" }
    }

    /// Half of the lateral distance between the feet when the legs are straight \[m\]: `W_p` of RH0, HipOffsetY of NAO
    /// Table 6.1.
    pub fn half_width(&self) -> f64 {
        self.feet[0].torso_from_sole.translation.y
    }

    /// The height of the torso's origin above the axes of the hip \[m\]: HipOffsetZ of NAO Table 6.1.
    pub fn hip_to_torso(&self) -> f64 {
        -self.hips[0].z
    }

    /// The area that the foot of `side` covers when its sole is flat on `print`.
    pub fn sole_at(&self, side: Side, print: &Footprint) -> Polygon {
        Polygon::hull(&print.carry_all(&self.feet[side as usize].corners))
    }

    /// The support polygon: the convex hull of the contact points of the supporting feet, each at the pose
    /// world_from_sole \[m\]. The floor is flat. A sole at any pose touches it with its lowest corners, those within
    /// `depth` \[m\].
    pub fn support(&self, soles: &[(Side, Pose)], depth: f64) -> Polygon {
        let points = |(side, pose): &(Side, Pose)| {
            let at = |corner: &Point2<f64>| pose * Point3::new(corner.x, corner.y, 0.0);
            self.feet[*side as usize].corners.iter().map(at).collect::<Vec<_>>()
        };
        let points: Vec<Point3<f64>> = soles.iter().flat_map(points).collect();
        let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
        let touching = points.iter().filter(|point| point.z <= lowest + depth);
        Polygon::hull(&touching.map(Point3::xy).collect::<Vec<_>>())
    }
}

/// Limits and greatest rates of all revolute and prismatic joints.
fn ranges(robot: &Robot, model: &Model) -> Result<Vec<JointRange>> {
    let range = |(place, name): (usize, &String)| {
        let joint = &robot.joints()[place];
        let missing =
            |what: &str| Error::new(ErrorKind::BadValue, format!("joint `{name}` has no {what}; a walk needs it"));
        let turns_freely =
            (joint.kind == groebot_robot::model::JointType::Continuous).then_some((f64::NEG_INFINITY, f64::INFINITY));
        Ok(JointRange {
            name: name.clone(),
            symbol: joint.symbol.clone().unwrap_or_else(|| name.clone()),
            limits: joint.limits.or(turns_freely).ok_or_else(|| missing("limits"))?,
            speed: joint.speed.filter(|speed| *speed > 0.0).unwrap_or(f64::INFINITY),
            effort: joint.effort.filter(|effort| *effort > 0.0),
        })
    };
    robot.moving().into_iter().zip(model.joints().iter().map(|joint| &joint.name)).map(range).collect()
}

fn foot(model: &Model, link: usize, outline: &Outline) -> Foot {
    let (body, torso_from_link) = model.link(link);
    let joints = model.path(body);
    let at = torso_from_link.translation.vector;
    let axes = outline.axes();
    let torso_from_sole = Pose::from_parts((at + axes * Vector3::new(0.0, 0.0, outline.height)).into(), axes);
    let ankle =
        joints.last().and_then(|joint| model.joints()[*joint].screw.axis()).map_or(at, |axis| axis.point().coords);
    let ankle_height = above(&torso_from_sole, &ankle);
    Foot { link, body, torso_from_sole, ankle_height, corners: outline.corners.clone(), joints }
}

/// The distance of a point of the torso frame from the plane of a sole at `torso_from_sole` \[m\].
pub(super) fn above(torso_from_sole: &Pose, point: &Vector3<f64>) -> f64 {
    (torso_from_sole.rotation * Vector3::z()).dot(&(point - torso_from_sole.translation.vector))
}
