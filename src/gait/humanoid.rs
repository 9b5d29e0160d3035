//! What a gait needs to know of a robot on two legs. Main type: [`Humanoid`].

use nalgebra::{Point2, Point3};

use super::footprint::{Footprint, Side};
use super::polygon::Polygon;
use crate::Result;
use crate::dynamics::{Body, Limb, LinkInertia, Multibody};
use crate::robots::{Sole, Weight, Whole, place_of};
use crate::spatial::Pose;

/// Which outline the soles have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outline {
    /// As it was measured on the robot.
    #[default]
    Measured,
    /// As the source document states it: 160 x 90 mm for NAO.
    Seed,
}

/// A joint as a gait sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRange {
    /// Its name in the robot's own documents.
    pub name: String,
    /// Its symbol in the source's formulas: `q3` there is `3` here.
    pub symbol: String,
    /// Least and greatest value \[rad\].
    pub limits: (f64, f64),
    /// The greatest rate \[rad/s\].
    pub speed: f64,
}

/// A foot: where its sole is and what of it touches the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Foot {
    /// The link that the sole is fixed to.
    pub link: usize,
    /// The frame of the sole in the torso frame at the zero configuration: x ahead, y left, z up.
    pub torso_from_sole: Pose,
    /// The height of the ankle's last axis over the sole \[m\].
    pub ankle_height: f64,
    /// The corners of what touches the floor, in the frame of the sole \[m\].
    pub corners: Vec<Point2<f64>>,
}

/// A robot on two legs: its joints, masses and soles. Link `i` of the body is moved by joint `i`.
#[derive(Clone, Debug, PartialEq)]
pub struct Humanoid {
    /// Its name.
    pub name: String,
    /// The joints in the order of the output.
    pub joints: Vec<JointRange>,
    /// Pairs of joints that one motor turns by the same angle.
    pub shared: Vec<(usize, usize)>,
    /// Masses and joints; its base is the torso.
    pub body: Multibody,
    /// The feet, left and right.
    pub feet: [Foot; 2],
    /// Where the first joints of the legs are, left and right, in the torso frame \[m\].
    pub hips: [Point3<f64>; 2],
    /// Whether the torso carries the whole mass as a point at its centre of mass, for want of the links' own masses.
    pub is_point_mass: bool,
}

impl Humanoid {
    /// The humanoid of a whole robot, with soles of the given outline.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for masses that no body has.
    pub fn new(whole: &Whole, outline: Outline) -> Result<Self> {
        let base = Body { base_from_link: Pose::identity(), inertia: inertia(&whole.base)? };
        let limb = |link: &crate::robots::WholeLink| {
            let inertia = link.weight.as_ref().map_or(Ok(LinkInertia::none()), inertia);
            let inertia = inertia.map_err(|error| error.with_context(&link.name))?;
            let body = Body { base_from_link: link.base_from_link, inertia };
            Ok(Limb { parent: link.parent, screw: link.screw, body })
        };
        let limbs = whole.links.iter().map(limb).collect::<Result<_>>()?;
        let range = |link: &crate::robots::WholeLink| JointRange {
            name: link.joint.clone(),
            symbol: link.symbol.clone(),
            limits: link.limits,
            speed: link.speed,
        };
        let hip = |sole: &Sole| {
            let limb = whole.limbs.iter().find(|limb| limb.joints.contains(&sole.link));
            let first = limb.and_then(|limb| limb.joints.iter().min());
            first.map_or(Point3::origin(), |first| whole.links[*first].base_from_link.translation.vector.into())
        };
        Ok(Humanoid {
            name: whole.name.clone(),
            hips: whole.soles.each_ref().map(hip),
            is_point_mass: whole.is_point_mass,
            joints: whole.links.iter().map(range).collect(),
            shared: whole.shared.clone(),
            body: Multibody::new(base, limbs)?,
            feet: whole.soles.each_ref().map(|sole| foot(whole, sole, outline)),
        })
    }

    /// The place of the joint `name`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::UnknownName`] when no joint has that name.
    pub fn joint(&self, name: &str) -> Result<usize> {
        place_of(name, self.joints.iter().map(|joint| joint.name.as_str()), &self.name)
    }

    /// Half of the way from foot to foot, sideways, when the legs hang straight \[m\]: `W_p` of RH0, HipOffsetY of NAO Table 6.1.
    pub fn half_width(&self) -> f64 {
        self.feet[0].torso_from_sole.translation.y
    }

    /// From the axes of the hip up to the origin of the torso \[m\]: HipOffsetZ of NAO Table 6.1.
    pub fn hip_to_torso(&self) -> f64 {
        -self.hips[0].z
    }

    /// What the foot of `side` covers when its sole stands flat on `print`.
    pub fn sole_at(&self, side: Side, print: &Footprint) -> Polygon {
        let corners = &self.feet[side as usize].corners;
        Polygon::hull(&corners.iter().map(|corner| print.carry(corner)).collect::<Vec<_>>())
    }

    /// The support polygon: the hull of the contact points of the feet that stand, each at the pose world_from_sole \[m\]; the floor is
    /// flat, and a sole at any pose touches it with those of its corners that are lowest, within `depth` \[m\].
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

fn inertia(weight: &Weight) -> Result<LinkInertia> {
    LinkInertia::new(weight.mass, weight.centre, weight.inertia)
}

fn foot(whole: &Whole, sole: &Sole, outline: Outline) -> Foot {
    let [(back, front), (right, left)] = match outline {
        Outline::Measured => sole.measured,
        Outline::Seed => sole.seed,
    };
    let corners = [(back, right), (front, right), (front, left), (back, left)].map(|(x, y)| Point2::new(x, y));
    let ankle_height = whole.links[sole.link].base_from_link.translation.z - sole.base_from_sole.translation.z;
    Foot { link: sole.link, torso_from_sole: sole.base_from_sole, ankle_height, corners: corners.to_vec() }
}
