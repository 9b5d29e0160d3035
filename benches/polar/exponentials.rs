//! The polar robot by its product of exponentials, as in RH0 2.7.1.

use groebot::kinematics::Chain;
use groebot::kinematics::screw::one_joint::translate_to_distance;
use groebot::kinematics::screw::two_joints::two_screws_to_point;
use groebot::kinematics::screw::values::Reach;
use groebot::robots;
use groebot::spatial::{Pose, Screw};
use nalgebra::{Matrix6x3, Point3, Unit, Vector3};

/// The robot, and the constants of its inverse.
pub struct Polar {
    chain: Chain,
    /// v3 of RH0 (2-51): the direction of the prismatic joint at the zero configuration.
    slide: Unit<Vector3<f64>>,
    /// The intersection of the first two axes: k of RH0 Fig. 2-6.
    crossing: Point3<f64>,
    /// The tool's origin at the zero configuration: H of RH0 Fig. 2-6.
    tool: Point3<f64>,
}

impl Polar {
    /// The robot of [`robots::polar`].
    pub fn new() -> Self {
        let chain = robots::polar();
        let (slide, crossing) = (chain.joints()[2].direction(), chain.joints()[0].location());
        let tool = Point3::from(chain.base_from_tip().translation.vector);
        Polar { chain, slide, crossing, tool }
    }

    /// base_from_tool, RH0 (2-54).
    pub fn forward(&self, q: &[f64; 3]) -> Pose {
        let [first, second, third] = self.screws();
        first.exp(q[0]) * second.exp(q[1]) * third.exp(q[2]) * self.chain.base_from_tip()
    }

    /// All joint values that move the tool to `target` \[m\]: RH0 (2-55)-(2-59). A free joint is zero.
    pub fn inverse(&self, target: &Point3<f64>) -> Vec<[f64; 3]> {
        let mut found = Vec::with_capacity(4);
        let distance = (target - self.crossing).norm();
        let [first, second, third] = self.screws();
        for slide in translate_to_distance(&self.slide, &self.tool, &self.crossing, distance, Reach::EXACT).iter() {
            let moved = third.exp(slide) * self.tool;
            for turns in &two_screws_to_point(first, second, &moved, target, Reach::EXACT) {
                let [yaw, pitch] = turns.map(Option::unwrap_or_default);
                found.push([yaw, pitch, slide]);
            }
        }
        found
    }

    /// The spatial Jacobian, RH0 (2-61): each column is a joint's twist, moved by the joints before it.
    pub fn jacobian(&self, q: &[f64; 3]) -> Matrix6x3<f64> {
        let (mut moved, mut columns) = (Pose::identity(), Matrix6x3::zeros());
        for (j, screw) in self.chain.screws().iter().enumerate() {
            let twist = screw.twist();
            let w = moved.rotation * twist.w;
            let v = moved.rotation * twist.v + moved.translation.vector.cross(&w);
            columns.fixed_view_mut::<3, 1>(0, j).copy_from(&v);
            columns.fixed_view_mut::<3, 1>(3, j).copy_from(&w);
            moved *= screw.exp(q[j]);
        }
        columns
    }

    fn screws(&self) -> [&Screw; 3] {
        let screws = self.chain.screws();
        [&screws[0], &screws[1], &screws[2]]
    }
}
