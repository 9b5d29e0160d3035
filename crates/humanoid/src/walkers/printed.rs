//! The generated solvers of the humanoids' legs, from `derivations/`. Their results equal those of `Program::solve` to
//! the last bit. Main type: [`Printed`].

use groebot_runtime::Solve;

use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{InverseKinematics, Solution, Target, Task};
use groebot_robot::spatial::Pose;

#[rustfmt::skip]
#[path = "legs/nao_left_leg.rs"]
mod nao_left_leg;
#[rustfmt::skip]
#[path = "legs/nao_right_leg.rs"]
mod nao_right_leg;
#[rustfmt::skip]
#[path = "legs/rh0_left_leg.rs"]
mod rh0_left_leg;
#[rustfmt::skip]
#[path = "legs/rh0_right_leg.rs"]
mod rh0_right_leg;
#[rustfmt::skip]
#[path = "legs/teo_leg.rs"]
mod teo_leg;

/// A generated solver of a leg with six joints, for the pose of its tip in its base.
#[derive(Clone, Copy, Debug)]
pub struct Printed {
    /// Replaces the content of the vector by all solutions; `None` when a number is not finite.
    solve: fn(&[f64; 12], &mut Vec<Solution>) -> Option<()>,
}

macro_rules! printed {
    ($($name:ident: $solver:ident;)+) => {
        $(pub const $name: Printed = Printed {
            solve: |target, out| {
                let mut answers = [$solver::EMPTY; $solver::CAPACITY];
                let count = $solver::Solver.solve(target, &mut answers).ok()?;
                out.resize(count, Solution::default());
                for (out, answer) in out.iter_mut().zip(&answers) {
                    out.q.clear();
                    out.q.extend_from_slice(&answer.q);
                    (out.residual, out.branch) = (answer.residual, answer.branch);
                    (out.chosen, out.settled) = (answer.chosen, answer.settled);
                    out.free.clear();
                    out.free.extend((0..$solver::JOINTS).filter(|joint| answer.is_free(*joint)));
                }
                Some(())
            },
        };)+
    };
}

printed! {
    NAO_LEFT_LEG: nao_left_leg;
    NAO_RIGHT_LEG: nao_right_leg;
    RH0_LEFT_LEG: rh0_left_leg;
    RH0_RIGHT_LEG: rh0_right_leg;
    TEO_LEFT_LEG: teo_leg;
}

impl InverseKinematics for Printed {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        let numbers = Task::Pose.layout().values(target).ok().filter(|_| given.is_empty());
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        let wrong = || Error::new(ErrorKind::BadValue, "the pose of a leg's tip is not finite; give finite numbers");
        numbers.and_then(|numbers| (self.solve)(&numbers, out)).ok_or_else(wrong)
    }
}

/// A leg that is solved from the foot up: its solver's base moves with the sole, its tip is fixed to the torso.
#[derive(Clone, Copy, Debug)]
pub struct FromTheFoot {
    /// The solver of the chain from the foot to the torso.
    pub upwards: Printed,
    /// The frame of the solver's base in the frame of the sole.
    pub sole_from_base: Pose,
    /// The frame of the solver's tip in the frame of the torso.
    pub torso_from_tip: Pose,
}

impl InverseKinematics for FromTheFoot {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        let target = match target {
            Target::Pose(torso_from_sole) => {
                Target::Pose((torso_from_sole * self.sole_from_base).inv_mul(&self.torso_from_tip))
            }
            other => *other,
        };
        self.upwards.solve(&target, given, out)?;
        out.iter_mut().for_each(|answer| answer.q.reverse());
        Ok(())
    }
}
