//! The polar robot by its product of exponentials, as RH0 2.7.1 writes it.

use groebot::kinematics::Chain;
use groebot::kinematics::screw::paden_kahan::{rotate_to_distance, rotate_to_point};
use groebot::robots;
use groebot::spatial::{Axis, Pose, Screw};
use nalgebra::{Matrix6x3, Point3, Unit, Vector3};

/// The robot, and what its inverse reads from it.
pub struct Polar {
    chain: Chain,
    yaw: Axis,
    pitch: Axis,
    /// v3 of RH0 (2-51): where the arm slides at zero.
    slide: Unit<Vector3<f64>>,
    /// The crossing of the first two axes: k of RH0 Fig. 2-6.
    crossing: Point3<f64>,
    /// The tool's origin at zero: H of RH0 Fig. 2-6.
    tool: Point3<f64>,
}

impl Polar {
    /// The robot of [`robots::polar`].
    pub fn new() -> Self {
        let chain = robots::polar();
        let (slide, crossing) = (chain.joints()[2].direction(), chain.joints()[0].location());
        let tool = Point3::from(chain.base_from_tip().translation.vector);
        let axis = |joint: usize| match chain.screws()[joint] {
            Screw::Revolute(axis) => axis,
            Screw::Prismatic(_) => panic!("joint {joint} of the polar robot turns"),
        };
        Polar { yaw: axis(0), pitch: axis(1), slide, crossing, tool, chain }
    }

    /// base_from_tool, RH0 (2-54).
    pub fn forward(&self, q: &[f64; 3]) -> Pose {
        let [first, second, third] = self.screws();
        first.exp(q[0]) * second.exp(q[1]) * third.exp(q[2]) * self.chain.base_from_tip()
    }

    /// All joint values that bring the tool to `target` \[m\]: RH0 (2-55)-(2-59). With the target on an axis, where a joint is
    /// free, none.
    pub fn inverse(&self, target: &Point3<f64>) -> Vec<[f64; 3]> {
        let mut found = Vec::with_capacity(4);
        let distance = (target - self.crossing).norm();
        for slide in self.slides_to(distance) {
            let moved = self.tool + self.slide.scale(slide);
            self.turns_to(&moved, target, |yaw, pitch| found.push([yaw, pitch, slide]));
        }
        found
    }

    /// Pardos-One for RH0 (2-56): the slides that bring the tool to `distance` from the crossing.
    fn slides_to(&self, distance: f64) -> impl Iterator<Item = f64> {
        let apart = self.crossing - self.tool;
        let foot = self.slide.dot(&apart);
        let chord = distance * distance - (apart - self.slide.scale(foot)).norm_squared();
        [foot + chord.sqrt(), foot - chord.sqrt()].into_iter().filter(|slide| slide.is_finite())
    }

    /// Paden-Kahan-Two for RH0 (2-58): the pitch that gives `moved` the target's distance from a point of the yaw's axis
    /// (Paden-Kahan-Three), then the yaw that takes it there (Paden-Kahan-One).
    fn turns_to(&self, moved: &Point3<f64>, target: &Point3<f64>, mut found: impl FnMut(f64, f64)) {
        let beside = self.crossing + self.yaw.direction().into_inner();
        for pitch in rotate_to_distance(&self.pitch, moved, &beside, (target - beside).norm()).iter() {
            let pitched = self.pitch.rotate(pitch, moved);
            for yaw in rotate_to_point(&self.yaw, &pitched, target).iter() {
                found(yaw, pitch);
            }
        }
    }

    /// The spatial Jacobian, RH0 (2-61): each column is a joint's twist, carried along by the joints before it.
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
