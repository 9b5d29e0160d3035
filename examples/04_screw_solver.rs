//! All joint values of a UR5 for one pose, by an order of Paden-Kahan subproblems that is found from its geometry and
//! described in text.
//!
//!     cargo run --release --example 04_screw_solver

use groebot::kinematics::Target;
use groebot::kinematics::screw::ScrewSolver;
use groebot::{Result, robots};

fn main() -> Result<()> {
    let arm = robots::ur5();
    let solver = ScrewSolver::new(&arm)?;
    println!("{}\n", solver.plan());

    let base_from_tip = arm.forward(&[0.1, -1.2, 1.4, -0.3, 0.8, 0.5])?;
    for solution in solver.solve(&Target::Pose(base_from_tip))? {
        let there = arm.forward(&solution.q)?;
        let error = (there.translation.vector - base_from_tip.translation.vector).norm();
        println!("q = {:7.4?} rad, off by {error:.1e} m", solution.q);
        assert!(error < 1e-12, "forward kinematics disagrees");
    }
    Ok(())
}
