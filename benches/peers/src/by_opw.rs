//! rs-opw-kinematics: arms with a parallel base and a spherical wrist, given by seven lengths. Its frame has z up.

use std::f64::consts::FRAC_PI_2;

use groebot::kinematics::Chain;
use groebot::spatial::Pose;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

use crate::Joints;

/// A robot in the format of rs-opw-kinematics.
pub struct Opw {
    robot: OPWKinematics,
    opw_from_base: UnitQuaternion<f64>,
    tip_from_flange: UnitQuaternion<f64>,
}

impl Opw {
    /// Converts `chain`, if it is one of those below.
    pub fn new(chain: &Chain) -> Option<Self> {
        let (parameters, opw_from_base) = parameters_of(chain.name())?;
        let robot = OPWKinematics::new(parameters);
        let turn = robot.forward(&[0.0; 6]).rotation;
        let base_from_flange = opw_from_base.inverse() * quaternion(&turn);
        let tip_from_flange = chain.base_from_tip().rotation.inverse() * base_from_flange;
        Some(Opw { robot, opw_from_base, tip_from_flange })
    }

    /// Converts `pose`, that of the tip in the base frame, to the format of rs-opw-kinematics.
    pub fn target(&self, pose: &Pose) -> OpwPose {
        let position = self.opw_from_base * pose.translation.vector;
        let rotation = self.opw_from_base * pose.rotation * self.tip_from_flange;
        let [x, y, z, w] = rotation.coords.into();
        OpwPose::from_parts(DVec3::new(position.x, position.y, position.z), DQuat::from_xyzw(x, y, z, w))
    }

    /// Forward kinematics of all joint vectors with groebot's chain.
    pub fn forward(&self, all: &[Joints]) {
        for q in all {
            std::hint::black_box(self.robot.forward(std::hint::black_box(q)));
        }
    }

    /// The solutions of rs-opw-kinematics. Its offsets are set so that they are joint values of groebot's chain.
    pub fn solutions(&self, target: &OpwPose) -> Vec<Joints> {
        self.robot.inverse(target)
    }
}

fn quaternion(q: &DQuat) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(nalgebra::Quaternion::new(q.w, q.x, q.y, q.z))
}

/// Lengths \[m\], the angles of its zero configuration in our joint values, and the orientation of its frame in ours.
fn parameters_of(name: &str) -> Option<(Parameters, UnitQuaternion<f64>)> {
    let lengths = Parameters {
        a1: 0.0,
        a2: 0.0,
        b: 0.0,
        c1: 0.0,
        c2: 0.0,
        c3: 0.0,
        c4: 0.0,
        offsets: [0.0; 6],
        sign_corrections: [1; 6],
        dof: 6,
    };
    let quarter = -FRAC_PI_2;
    match name {
        // At our zero configuration the forearm is along x and the tool points down. At its own zero configuration all
        // links are upright.
        "irb120" => {
            let offsets = [0.0, 0.0, quarter, 0.0, quarter, 0.0];
            let parameters = Parameters { a2: -0.07, c1: 0.29, c2: 0.27, c3: 0.302, c4: 0.16, offsets, ..lengths };
            Some((parameters, UnitQuaternion::identity()))
        }
        // y is up and z is forward; the tool points forward.
        "puma" => {
            let offsets = [0.0, 0.0, 0.0, 0.0, quarter, 0.0];
            let parameters = Parameters { c1: 0.66, c2: 0.432, c3: 0.432, c4: 0.15, offsets, ..lengths };
            let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
            let turn = Rotation3::from_basis_unchecked(&[y, z, x]);
            Some((parameters, UnitQuaternion::from_rotation_matrix(&turn)))
        }
        _ => None,
    }
}
