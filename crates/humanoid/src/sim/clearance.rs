//! Distances between the links of a robot and the objects around it, by the crate parry3d. Main type: [`Clearance`].

use nalgebra::Point3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query::{PointQuery, distance};
use parry3d_f64::shape::{ConvexPolyhedron, HalfSpace, SharedShape};

use super::prism::{Prism, Thing, prisms};
use crate::gait::{Biped, Posture};
use crate::nav::Room;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::model::{Meshes, Robot, Solid};
use groebot_robot::spatial::Pose;

/// The least distance between a link and an object.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Clearance {
    /// The name of the link.
    pub link: String,
    /// The object.
    pub thing: Thing,
    /// The least distance \[m\], to 1e-7; zero where they touch.
    pub distance: f64,
    /// The sample at which it occurs first.
    pub sample: usize,
}

/// A shape of a link.
struct Part {
    link: usize,
    link_from_shape: Pose,
    shape: SharedShape,
    /// The bounding sphere: its centre in the shape's frame, its radius.
    middle: Point3<f64>,
    radius: f64,
}

/// An object as convex parts in the world.
struct Solids {
    thing: Thing,
    parts: Vec<(SharedShape, Aabb)>,
}

/// The shapes of a robot's links, from which distances are measured.
pub struct Links {
    names: Vec<String>,
    parts: Vec<Part>,
    /// Links that are fixed to a sole.
    feet: Vec<bool>,
}

impl Links {
    /// Collects the shapes of `robot`: the collision shapes of each link, else its visual shapes. A mesh counts as its
    /// convex hull.
    ///
    /// # Errors
    /// Those of [`Meshes::points`]; [`ErrorKind::BadValue`] for a robot without a shape.
    pub fn of(robot: &Robot, biped: &Biped, meshes: &Meshes) -> Result<Self> {
        let mut parts = Vec::new();
        for (link, own) in robot.links().iter().enumerate() {
            let shapes = if own.collisions.is_empty() { &own.visuals } else { &own.collisions };
            for described in shapes {
                let (shape, turned) = shared(&described.solid, meshes)?;
                let sphere = shape.compute_local_bounding_sphere();
                let middle = Point3::new(sphere.center.x, sphere.center.y, sphere.center.z);
                let link_from_shape = described.pose() * turned;
                parts.push(Part { link, link_from_shape, shape, middle, radius: sphere.radius });
            }
        }
        if parts.is_empty() {
            let text = format!("{}: no link has a shape; give the robot collisions or visuals", robot.name());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let soles = [biped.feet[0].body, biped.feet[1].body];
        let feet = (0..robot.links().len()).map(|link| soles.contains(&biped.model.link(link).0)).collect();
        Ok(Links { names: robot.links().iter().map(|link| link.name.clone()).collect(), parts, feet })
    }

    /// The least distance of each link from each object of a room and from the floor over postures, nearest first. Samples are numbered from `first`.
    ///
    /// # Errors
    /// Same as [`groebot_robot::dynamics::Model::place`]; [`Watch::check`].
    pub fn clearances<'w>(
        &self,
        biped: &Biped,
        postures: &[Posture],
        first: usize,
        room: &Room,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Vec<Clearance>> {
        let watch = Watch::or_none(watch);
        let things = things(room);
        let mut least = vec![vec![(f64::INFINITY, 0); things.len()]; self.names.len()];
        for (sample, posture) in postures.iter().enumerate() {
            watch.check()?;
            let placed = biped.model.place(&posture.world_from_torso, &posture.q)?;
            for part in &self.parts {
                let world_from_shape = placed.world_from_link(part.link) * part.link_from_shape;
                for (thing, known) in things.iter().zip(&mut least[part.link]) {
                    if self.feet[part.link] && thing.thing == Thing::Floor {
                        continue;
                    }
                    let found = part.distance(&world_from_shape, thing, known.0);
                    if found < known.0 {
                        *known = (found, first + sample);
                    }
                }
            }
        }
        let mut all: Vec<Clearance> = Vec::new();
        for (link, least) in self.names.iter().zip(least) {
            let known = things.iter().zip(least).filter(|(_, (distance, _))| distance.is_finite());
            all.extend(known.map(|(thing, (distance, sample))| Clearance {
                link: link.clone(),
                thing: thing.thing.clone(),
                distance,
                sample,
            }));
        }
        all.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Ok(all)
    }
}

impl Part {
    /// The distance from an object, if it is less than `known`.
    fn distance(&self, world_from_shape: &Pose, thing: &Solids, known: f64) -> f64 {
        let middle = vector(&(world_from_shape * self.middle));
        let near = |bounds: &Aabb| bounds.distance_to_local_point(middle, true) - self.radius < known;
        let own = parry(world_from_shape);
        let parts = thing.parts.iter().filter(|(_, bounds)| near(bounds));
        parts
            .map(|(shape, _)| {
                // Every pair of these shapes is supported.
                distance(&own, &*self.shape, &ParryPose::IDENTITY, &**shape).map_or(0.0, |found| found.distance)
            })
            .fold(f64::INFINITY, f64::min)
    }
}

fn things(room: &Room) -> Vec<Solids> {
    let part = |prism: &Prism| {
        let shape = prism.shape();
        let bounds = shape.compute_aabb(&ParryPose::IDENTITY);
        (shape, bounds)
    };
    let solids =
        prisms(room).into_iter().map(|(thing, parts)| Solids { thing, parts: parts.iter().map(part).collect() });
    let half_space = SharedShape::new(HalfSpace::new(Vector::new(0.0, 0.0, 1.0)));
    let far = Vector::new(f64::MAX, f64::MAX, f64::MAX);
    let below = Aabb::new(-far, Vector::new(f64::MAX, f64::MAX, 0.0));
    let floor = Solids { thing: Thing::Floor, parts: vec![(half_space, below)] };
    solids.chain([floor]).collect()
}

impl Prism {
    fn shape(&self) -> SharedShape {
        let ends = [0.0, self.height].map(|z| self.corners.iter().map(move |at| Vector::new(at.x, at.y, z)));
        hull(&ends.into_iter().flatten().collect::<Vec<_>>())
    }
}

/// The convex hull of points; where it has no volume, their bounding box.
fn hull(points: &[Vector]) -> SharedShape {
    let boxed = || {
        let around = Aabb::from_points(points.iter().copied());
        let half = around.half_extents();
        let at = ParryPose::from_translation(around.center());
        SharedShape::compound(vec![(at, SharedShape::cuboid(half.x, half.y, half.z))])
    };
    ConvexPolyhedron::from_convex_hull(points).map_or_else(boxed, SharedShape::new)
}

/// A solid, with its frame relative to parry's: there the axis of a cylinder is y.
fn shared(solid: &Solid, meshes: &Meshes) -> Result<(SharedShape, Pose)> {
    let plain = |shape: SharedShape| Ok((shape, Pose::identity()));
    match solid {
        Solid::Sphere { radius } => plain(SharedShape::ball(*radius)),
        Solid::Capsule { radius, length } => plain(SharedShape::capsule_z(length / 2.0, *radius)),
        Solid::Box { size: [x, y, z] } => plain(SharedShape::cuboid(x / 2.0, y / 2.0, z / 2.0)),
        Solid::Cylinder { radius, length } => {
            let upright = Pose::rotation(nalgebra::Vector3::x() * std::f64::consts::FRAC_PI_2);
            Ok((SharedShape::cylinder(length / 2.0, *radius), upright))
        }
        mesh @ Solid::Mesh { .. } => plain(hull(&meshes.points(mesh)?.iter().map(vector).collect::<Vec<_>>())),
    }
}

fn vector(point: &Point3<f64>) -> Vector {
    Vector::new(point.x, point.y, point.z)
}

fn parry(pose: &Pose) -> ParryPose {
    let (at, turn) = (pose.translation.vector, pose.rotation.coords);
    ParryPose::from_parts(Vector::new(at.x, at.y, at.z), Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w))
}
