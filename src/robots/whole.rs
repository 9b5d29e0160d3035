//! A whole robot as data: its chains on one base, what the links weigh, how fast the joints turn, its soles. Main type: [`Whole`].

mod read;

use nalgebra::{Matrix3, Point3, Vector3};

use crate::spatial::{Pose, Screw};
use crate::{Error, ErrorKind, Result};

/// Mass, centre of mass and inertia as a data file states them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// The mass \[kg\].
    pub mass: f64,
    /// The centre of mass in the link's frame \[m\].
    pub centre: Point3<f64>,
    /// The inertia tensor about the centre of mass, along the axes of the link's frame \[kg m^2\].
    pub inertia: Matrix3<f64>,
}

/// A link and the joint that moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeLink {
    /// The name of the link.
    pub name: String,
    /// The name of the joint, unique in the robot.
    pub joint: String,
    /// The joint's symbol in its chain or source: `q3` there is `3` here.
    pub symbol: String,
    /// The link before it, by its place in [`Whole::links`]; `None` for the base.
    pub parent: Option<usize>,
    /// The joint in the base frame at the zero configuration.
    pub screw: Screw,
    /// The frame of the link at the zero configuration; its origin is on the joint's axis.
    pub base_from_link: Pose,
    /// Least and greatest value of the joint \[rad\].
    pub limits: (f64, f64),
    /// The greatest rate of the joint without load \[rad/s\].
    pub speed: f64,
    /// What the link weighs; `None` where its mass is counted with the base.
    pub weight: Option<Weight>,
}

/// Where the links of a chain are in a whole robot.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeLimb {
    /// The name of the chain, or of the limb where the file states its joints itself.
    pub chain: String,
    /// The place in [`Whole::links`] of each joint, in the chain's own order.
    pub joints: Vec<usize>,
    /// Whether the chain leads from the foot to the base: its root moves with the last link, its tip is the base.
    pub reversed: bool,
    /// Whether the limb is the chain's mirror image in the plane y = 0.
    pub mirrored: bool,
    /// The chain's root frame in the base frame at the zero configuration.
    pub base_from_root: Pose,
    /// The chain's tip frame in the base frame at the zero configuration.
    pub base_from_tip: Pose,
}

impl WholeLimb {
    /// The value of a joint of this limb whose screw is `screw`, for the value 1 of the chain's own joint: -1 where the mirror image of a
    /// turn goes the other way.
    pub fn sense(&self, screw: &Screw) -> f64 {
        let direction = screw.twist().w;
        let mirrored = Vector3::new(direction.x, -direction.y, direction.z);
        if self.mirrored { -direction.dot(&mirrored).signum() } else { 1.0 }
    }
}

/// A sole, as rectangles in its frame: x ahead, y left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// The link that it is fixed to, by its place in [`Whole::links`].
    pub link: usize,
    /// The frame of the sole in the base frame at the zero configuration.
    pub base_from_sole: Pose,
    /// Least and greatest x and y of what touches the floor, as measured \[m\].
    pub measured: [(f64, f64); 2],
    /// The same as the source document has it.
    pub seed: [(f64, f64); 2],
}

/// A whole robot: a base, and the links of all chains behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// Its name.
    pub name: String,
    /// What the base weighs.
    pub base: Weight,
    /// The links, chain by chain from the base; link `i` is moved by joint `i`.
    pub links: Vec<WholeLink>,
    /// The limbs.
    pub limbs: Vec<WholeLimb>,
    /// Whether the base carries the whole mass as a point, for want of the links' own.
    pub is_point_mass: bool,
    /// Pairs of joints that one motor turns by the same angle.
    pub shared: Vec<(usize, usize)>,
    /// Pairs of joints of which the first takes the value of the second: the arms' sagittal coordination, RH0 (3-23), (3-38).
    pub coordinated: Vec<(usize, usize)>,
    /// The soles, left and right.
    pub soles: [Sole; 2],
}

impl Whole {
    /// The place of the joint `name` in [`Whole::links`].
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when no joint has that name.
    pub fn joint(&self, name: &str) -> Result<usize> {
        place_of(name, self.links.iter().map(|link| link.joint.as_str()), &self.name)
    }
}

/// The place of the joint `name` among the `joints` of `robot`.
///
/// # Errors
/// [`ErrorKind::UnknownName`] when no joint has that name.
pub fn place_of<'n>(name: &str, mut joints: impl Iterator<Item = &'n str>, robot: &str) -> Result<usize> {
    let unknown = || Error::new(ErrorKind::UnknownName, format!("{robot} has no joint `{name}`"));
    joints.position(|joint| joint == name).ok_or_else(unknown)
}
