//! One robot, two formulations: product of exponentials and Denavit-Hartenberg parameters (RH0 2.7). Both give the same pose. The inverse by screw theory has
//! all four solutions; RH0 (2-66) has one.
//!
//!     cargo run --release --example 03_poe_and_dh

use groebot::Result;
use nalgebra::Point3;

#[path = "../benches/polar/denavit_hartenberg.rs"]
mod denavit_hartenberg;
#[path = "../benches/polar/exponentials.rs"]
mod exponentials;

fn main() -> Result<()> {
    let robot = exponentials::Polar::new();
    let q = [0.4, 0.7, 0.3];

    let pose = robot.forward(&q);
    let table = denavit_hartenberg::forward(&q);
    println!("the tool by exponentials:\n{:.6}", pose.to_homogeneous());
    for other in [table, denavit_hartenberg::forward_by_hand(&q)] {
        assert!((other - pose.to_homogeneous()).norm() < 1e-14, "the formulations disagree");
    }

    let target = Point3::from(pose.translation.vector);
    println!("yaw, pitch [rad] and slide [m] that bring the tool there, by screws:");
    for solution in robot.inverse(&target) {
        let error = (robot.forward(&solution).translation.vector - target.coords).norm();
        println!("    {solution:9.6?}, off by {error:.1e} m");
        assert!(error < 1e-14);
    }
    println!("by RH0 (2-66), its pitch counted as in its table:\n    {:9.6?}", denavit_hartenberg::inverse(&table));
    println!("and as printed:\n    {:9.6?}", denavit_hartenberg::inverse_as_printed(&table));

    println!("twists of the joints where they are now, RH0 (2-61):\n{:.6}", robot.jacobian(&q));
    println!("velocities of the tool by derivatives, RH0 (2-68):\n{:.6}", denavit_hartenberg::jacobian(&q));
    Ok(())
}
