//! Links of a robot: inertia and shapes. Main type: [`Link`].

use std::fmt;

use nalgebra::{Matrix3, Point3, Translation3, UnitQuaternion};
use num_traits::ToPrimitive;

use super::Origin;
use crate::spatial::{Inertia, Pose};
use groebot_algebra::number::BigRational;

/// Number of points that approximate a circle.
const ROUND: usize = 16;

/// One rigid body. Its frame is the frame of its parent joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Link {
    /// Its name, unique in the robot.
    pub name: String,
    /// Its inertia; a link without mass is a frame.
    pub mass: Option<Mass>,
    /// Visual shapes.
    pub visuals: Vec<Shape>,
    /// Collision shapes.
    pub collisions: Vec<Shape>,
    /// Notes: shapes that the reader ignored, with the reason.
    pub notes: Vec<String>,
    /// Its line in the file.
    pub line: Option<usize>,
}

impl Link {
    /// A link without mass and shapes.
    pub fn new(name: &str) -> Self {
        Link { name: name.to_owned(), ..Link::default() }
    }

    /// The visual shapes that `show` supports, else the collision shapes that it supports. Also returns whether there
    /// are shapes but none is supported.
    pub fn drawn<T>(&self, mut show: impl FnMut(&Shape) -> Option<T>) -> (Vec<T>, bool) {
        let mut all = |shapes: &[Shape]| -> Vec<T> { shapes.iter().filter_map(&mut show).collect() };
        let visuals = all(&self.visuals);
        let drawn = if visuals.is_empty() { all(&self.collisions) } else { visuals };
        let hidden = drawn.is_empty() && !(self.visuals.is_empty() && self.collisions.is_empty());
        (drawn, hidden)
    }

    /// Its inertia in doubles, in its own frame.
    pub fn inertia(&self) -> Inertia {
        self.mass.as_ref().map_or(Inertia::none(), Mass::inertia)
    }
}

/// Mass, centre of mass and inertia tensor of a link, exactly as described.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// The mass \[kg\].
    pub mass: BigRational,
    /// The frame at the centre of mass, in the link's frame \[m\].
    pub origin: Origin,
    /// The inertia tensor about the centre of mass, along the axes of that frame: xx, xy, xz, yy, yz, zz \[kg m^2\].
    pub moments: [BigRational; 6],
}

impl Mass {
    /// The inertia in doubles, in the link's frame. It is not checked for physical consistency: [`Inertia::new`] does
    /// that.
    pub fn inertia(&self) -> Inertia {
        let double = |exact: &BigRational| exact.to_f64().unwrap_or(f64::NAN);
        let [xx, xy, xz, yy, yz, zz] = self.moments.each_ref().map(double);
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        Inertia::unchecked(double(&self.mass), Point3::origin(), tensor).placed(&self.origin.pose())
    }
}

/// A visual or a collision shape. Metres and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its name, if there is one.
    pub name: Option<String>,
    /// The origin of its frame in the link's frame.
    pub xyz: [f64; 3],
    /// Roll, pitch and yaw of its frame in the link's frame, as in a URDF.
    pub rpy: [f64; 3],
    /// The solid, in its frame.
    pub solid: Solid,
    /// Red, green, blue and opacity, from 0 to 1.
    pub colour: Option<[f64; 4]>,
}

impl Shape {
    /// A shape without name and colour, with the link's frame.
    pub fn new(solid: Solid) -> Self {
        Shape { name: None, xyz: [0.0; 3], rpy: [0.0; 3], solid, colour: None }
    }

    /// Its frame in the link's frame.
    pub fn pose(&self) -> Pose {
        let [roll, pitch, yaw] = self.rpy;
        Pose::from_parts(Translation3::from(self.xyz), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
    }
}

/// A solid. Metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// A box centred at the origin.
    Box {
        /// Its side lengths along x, y and z.
        size: [f64; 3],
    },
    /// A cylinder along the z axis, centred at the origin.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its height.
        length: f64,
    },
    /// A sphere centred at the origin.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A capsule along the z axis, centred at the origin: a cylinder with half spheres at both ends.
    Capsule {
        /// Its radius.
        radius: f64,
        /// The length of the cylinder, without the half spheres.
        length: f64,
    },
    /// A triangle mesh in a file.
    Mesh {
        /// The file as named in the description: a path, or `package://name/path`.
        path: String,
        /// Scale factors along x, y and z.
        scale: [f64; 3],
    },
}

impl Solid {
    /// The name of its type: `box`, `cylinder`, `sphere`, `capsule` or `mesh`.
    pub fn name(&self) -> &'static str {
        match self {
            Solid::Box { .. } => "box",
            Solid::Cylinder { .. } => "cylinder",
            Solid::Sphere { .. } => "sphere",
            Solid::Capsule { .. } => "capsule",
            Solid::Mesh { .. } => "mesh",
        }
    }

    /// Points whose convex hull is approximately the solid, in its frame \[m\]. Empty for a mesh, whose points are in a
    /// file: see [`Meshes::points`](super::Meshes::points).
    #[doc(hidden)]
    pub fn points(&self) -> Vec<Point3<f64>> {
        let signs = [-0.5, 0.5];
        let circle = |radius: f64, z: f64| {
            let angle = |step: usize| std::f64::consts::TAU * step as f64 / ROUND as f64;
            (0..ROUND).map(move |step| Point3::new(radius * angle(step).cos(), radius * angle(step).sin(), z))
        };
        match *self {
            Solid::Box { size: [x, y, z] } => {
                let xy = signs.into_iter().flat_map(|a| signs.map(|b| (a, b)));
                xy.flat_map(|(a, b)| signs.map(|c| Point3::new(a * x, b * y, c * z))).collect()
            }
            Solid::Cylinder { radius, length } => {
                signs.into_iter().flat_map(|end| circle(radius, end * length)).collect()
            }
            Solid::Sphere { radius } | Solid::Capsule { radius, .. } => {
                let half = if let Solid::Capsule { length, .. } = *self { length / 2.0 } else { 0.0 };
                let rings = (0..=ROUND / 2).map(|ring| std::f64::consts::PI * (ring as f64 / (ROUND / 2) as f64 - 0.5));
                let ring =
                    |latitude: f64| circle(radius * latitude.cos(), radius * latitude.sin() + half * latitude.signum());
                rings.flat_map(ring).collect()
            }
            Solid::Mesh { .. } => Vec::new(),
        }
    }
}

/// `box 0.1 x 0.2 x 0.3 m`, `mesh package://nao/foot.stl`.
impl fmt::Display for Solid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Solid::Box { size: [x, y, z] } => write!(f, "box {x} x {y} x {z} m"),
            Solid::Cylinder { radius, length } => write!(f, "cylinder of radius {radius} m, {length} m long"),
            Solid::Sphere { radius } => write!(f, "sphere of radius {radius} m"),
            Solid::Capsule { radius, length } => write!(f, "capsule of radius {radius} m, {length} m long"),
            Solid::Mesh { path, .. } => write!(f, "mesh {path}"),
        }
    }
}
