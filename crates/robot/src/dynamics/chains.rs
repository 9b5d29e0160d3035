//! A biped as two chains from its feet, RH0 3.2 and 3.4.3.
//!
//! The sagittal plane divides the robot into two halves ([`Model::halves`]): each has a leg, the limbs of that side,
//! and half of the parts common to both. A chain starts at a foot and leads to the trunk and further
//! ([`Model::rooted_at`]).

use nalgebra::{Point3, Vector3};

use super::model::Model;
use crate::spatial::{Inertia, Pose};

/// Threshold as a fraction of the distance from the middle to a foot. Bodies closer to the sagittal plane are common to
/// both halves.
const COMMON: f64 = 0.1;

/// The half of a body.
#[derive(Clone, Copy, PartialEq)]
enum Half {
    Common,
    Of(usize),
}

impl Model {
    /// Divides a robot into its left and right half. `feet` are the indices of the feet's links in the robot. Each half
    /// keeps all joints. The path to a foot belongs to that half, and a limb to the side where it is attached to the
    /// trunk. Bodies in the middle are common, with half of their mass in each half.
    ///
    /// # Panics
    /// When there is no such link.
    #[doc(hidden)]
    pub fn halves(&self, feet: [usize; 2]) -> [Model; 2] {
        let places = feet.map(|foot| self.link(foot).1.translation.vector);
        let (middle, across) = ((places[0] + places[1]) / 2.0, (places[0] - places[1]) / 2.0);
        // Position as a fraction of the distance from the middle to the left foot.
        let side = |place: &Vector3<f64>| (place - middle).dot(&across) / across.norm_squared();
        let legs = feet.map(|foot| self.path(self.link(foot).0));
        let mut halves = vec![Half::Common; self.bodies.len()];
        for &joint in &self.order {
            let parent = halves[self.joints()[joint].parent];
            halves[joint + 1] = match (parent, legs.each_ref().map(|leg| leg.contains(&joint))) {
                (Half::Of(half), _) => Half::Of(half),
                (Half::Common, [true, false]) => Half::Of(0),
                (Half::Common, [false, true]) => Half::Of(1),
                (Half::Common, [true, true]) => Half::Common,
                (Half::Common, [false, false]) => match side(&self.place_of(joint + 1)) {
                    side if side > COMMON => Half::Of(0),
                    side if side < -COMMON => Half::Of(1),
                    _ => Half::Common,
                },
            };
        }
        [0, 1].map(|own| {
            let share = |half: &Half| match half {
                Half::Common => 0.5,
                Half::Of(half) => f64::from(u8::from(*half == own)),
            };
            self.weighing(&halves.iter().map(share).collect::<Vec<_>>())
        })
    }

    /// Position of the first link of a body in the base frame at the zero configuration.
    fn place_of(&self, body: usize) -> Vector3<f64> {
        let link = self.links.iter().find(|(of, _)| *of == body);
        link.map_or_else(Vector3::zeros, |(_, base_from_link)| base_from_link.translation.vector)
    }

    /// Same model, but with each body's mass multiplied by its factor.
    fn weighing(&self, shares: &[f64]) -> Model {
        let mut model = self.clone();
        for (body, share) in model.bodies.iter_mut().zip(shares) {
            *body = match share * body.mass() {
                0.0 => Inertia::unchecked(0.0, Point3::origin(), body.rotational() * *share),
                mass => Inertia::unchecked(mass, body.centre_of_mass(), body.rotational() * *share),
            };
        }
        model.mass = model.bodies.iter().map(Inertia::mass).sum();
        model
    }

    /// Same robot, but rooted at another link: the base is the body of that link, in the link's frame. The joints
    /// between the two bases are reversed. Joint values keep their meaning.
    ///
    /// # Panics
    /// When there is no such link.
    #[must_use]
    #[doc(hidden)]
    pub fn rooted_at(&self, link: usize) -> Model {
        let (target, base_from_link) = self.link(link);
        let link_from_base = base_from_link.inverse();
        let path = self.path(target);
        // For each body of this model, its index in the new one. The body after a joint of the path is the one that was
        // before it.
        let mut named: Vec<usize> = (0..self.bodies.len()).collect();
        for &joint in &path {
            named[self.joints()[joint].parent] = joint + 1;
        }
        named[target] = 0;
        let mut model = self.clone();
        for (joint, own) in model.joints.iter_mut().enumerate() {
            let carrier = if path.contains(&joint) { joint + 1 } else { own.parent };
            own.parent = named[carrier];
            own.screw = own.screw.moved(&link_from_base);
            if path.contains(&joint) {
                own.screw = own.screw.reversed();
            }
        }
        for (body, inertia) in self.bodies.iter().enumerate() {
            model.bodies[named[body]] = inertia.placed(&link_from_base);
        }
        for (body, base_from_link) in &mut model.links {
            (*body, *base_from_link) = (named[*body], link_from_base * *base_from_link);
        }
        model.links[link].1 = Pose::identity();
        let on_path = path.iter().rev().chain(self.order.iter().filter(|joint| !path.contains(joint)));
        model.order = on_path.copied().collect();
        model
    }
}
