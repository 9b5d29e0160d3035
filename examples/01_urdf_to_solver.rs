//! From a URDF to a proved solver, all its answers, and its source code.
//!
//!     cargo run --release --example 01_urdf_to_solver

use std::path::Path;

use groebot::derive::Proved;
use groebot::kinematics::Target;
use groebot::model::Robot;
use groebot::{Result, Watch, codegen};

fn main() -> Result<()> {
    let robot = Robot::read_urdf(Path::new("tests/corpus/urdf/ur5.urdf"))?;
    let chain = robot.chain(Some("base"), None)?;
    let derived = Proved::of_chain(&chain, &Watch::none())?;

    let target = Target::Pose(chain.forward(&[0.1, -1.2, 1.4, -0.3, 0.8, 0.5])?);
    for solution in derived.program().solve(&target, &[])? {
        let [distance, angle] = target.missed(&chain, &solution.q);
        println!("q = {:.6?} rad, off by {distance:.1e} m, {angle:.1e} rad", solution.q);
    }
    println!("{} lines of Rust", codegen::rust::emit(derived.program()).lines().count());
    Ok(())
}
