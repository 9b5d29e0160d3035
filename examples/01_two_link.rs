//! A two-link arm from its description to all inverse solutions of a point, checked by forward kinematics.
//!
//!     cargo run --release --example 01_two_link

use groebot::derive::{Derivation, formulate};
use groebot::kinematics::Chain;
use groebot::{Result, Watch};

const ARM: &str = r#"
name = "two_link"
length_unit = "m"
task = { kind = "planar_position", plane = "xy" }
joint = [
    { name = "Shoulder", type = "revolute", axis = [0, 0, 1], point = [0, 0, 0] },
    { name = "Elbow", type = "revolute", axis = [0, 0, 1], point = [0.5, 0, 0] },
]
tip = { point = [0.8, 0, 0] }
"#;

fn main() -> Result<()> {
    let chain = Chain::from_toml(ARM)?;
    let derivation = Derivation::new(formulate(&chain)?, &Watch::none())?;
    if let Some(solved) = derivation.solving().solved() {
        println!("{}", solved.triangular);
    }

    let target = [0.4, 0.5];
    for solution in derivation.program.solve(&target)? {
        let tip = chain.forward(&solution.q)?.translation.vector;
        let error = (tip.x - target[0]).hypot(tip.y - target[1]);
        println!("q = {:.6?} rad puts the tip at ({:.6}, {:.6}) m, off by {error:.1e} m", solution.q, tip.x, tip.y);
        assert!(error < 1e-12, "forward kinematics disagrees");
    }
    Ok(())
}
