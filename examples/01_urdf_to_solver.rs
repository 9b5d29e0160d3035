//! From a URDF to a proved solver, all its solutions, and its source code.
//!
//!     cargo run --release --example 01_urdf_to_solver

use groebot::kinematics::Target;
use groebot::model::Robot;
use groebot::{Result, codegen};

fn main() -> Result<()> {
    let chain = Robot::read("tests/corpus/urdf/ur5.urdf")?.chain(Some("base"), None)?;
    let derivation = groebot::derive(&chain)?;

    let solver = derivation.solver();
    let pose = chain.forward(&[0.1, -1.2, 1.4, -0.3, 0.8, 0.5])?;
    for solution in solver.solve(pose)? {
        let [distance, angle] = Target::Pose(pose).missed(&chain, &solution.q);
        println!("q = {:.6?} rad, off by {distance:.1e} m, {angle:.1e} rad", solution.q);
    }
    println!("{} lines of Rust", codegen::rust::emit(derivation.program()).lines().count());
    Ok(())
}
