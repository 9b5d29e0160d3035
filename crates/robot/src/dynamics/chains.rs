//! A robot on two legs as chains that stand on its feet, RH0 3.2 and 3.4.3.
//!
//! The sagittal plane cuts it into halves, each with a leg, what hangs on that side, and half of what is common to both: `Model::halves`. A chain leads from a foot to the
//! trunk and on: `Model::rooted_at`.

use nalgebra::{Point3, Vector3};

use super::model::Model;
use crate::spatial::{Inertia, Pose};

/// As a share of the way from the middle to a foot: what stands nearer to the sagittal plane is common to both halves.
const COMMON: f64 = 0.1;

/// The half that a body belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Half {
    Common,
    Of(usize),
}

impl Model {
    /// The halves of a robot with these feet, by their links' places in the robot: the left one and the right one, of joints as the whole has them. What leads to a foot
    /// is of that half; a limb that hangs on the trunk is of the half where it hangs; what hangs in the middle is common, and weighs half as much in each.
    ///
    /// # Panics
    /// When there is no such link.
    pub fn halves(&self, feet: [usize; 2]) -> [Model; 2] {
        let places = feet.map(|foot| self.link(foot).1.translation.vector);
        let (middle, across) = ((places[0] + places[1]) / 2.0, (places[0] - places[1]) / 2.0);
        // Where it is of the way from the middle to the left foot.
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

    /// Where the first link of a body stands in the base frame at the zero configuration.
    fn place_of(&self, body: usize) -> Vector3<f64> {
        let link = self.links.iter().find(|(of, _)| *of == body);
        link.map_or_else(Vector3::zeros, |(_, base_from_link)| base_from_link.translation.vector)
    }

    /// The same, each body so many times as heavy.
    fn weighing(&self, shares: &[f64]) -> Model {
        let mut model = self.clone();
        for (body, share) in model.bodies.iter_mut().zip(shares) {
            *body = match share * body.mass() {
                0.0 => Inertia::told(0.0, Point3::origin(), body.rotational() * *share),
                mass => Inertia::told(mass, body.centre_of_mass(), body.rotational() * *share),
            };
        }
        model.mass = model.bodies.iter().map(Inertia::mass).sum();
        model
    }

    /// The same robot seen from another link: the base is the body of that link, in the link's frame, and joints between the two bases carry what carried them. Values of
    /// joints mean what they mean in the robot.
    ///
    /// # Panics
    /// When there is no such link.
    #[must_use]
    pub fn rooted_at(&self, link: usize) -> Model {
        let (target, base_from_link) = self.link(link);
        let link_from_base = base_from_link.inverse();
        let path = self.path(target);
        // By body of this model, what it is in the other one: behind a joint of the path is what was before it.
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
