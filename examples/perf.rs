//! perf
use groebot::Watch;
use groebot::derive::*;
use groebot::kinematics::Chain;
use std::path::Path;
use std::time::Instant;
fn main() {
    let leg = formulate(&Chain::read(Path::new("derivations/nao_leg_sagittal/0_chain.toml")).unwrap()).unwrap();
    println!("{leg}");
    let arm = System::read_toml(Path::new("derivations/nao_arm_planar/0_system.toml")).unwrap();
    for s in [leg, arm] {
        let t = Instant::now();
        let d = Derivation::new(s, &Watch::none()).unwrap();
        println!("{:?}", t.elapsed());
        println!("{}", d.requested.solved().unwrap().triangular);
        println!("{}", d.solving().solved().unwrap().triangular);
        println!("{}", d.program.to_json());
        for t in [
            [60.0, 150.0],
            [150.0, 0.0],
            [0.0, 150.0],
            [202.9, 0.0],
            [0.0, 202.9],
            [0.0, 0.0],
            [300.0, 0.0],
            [1e-9, 150.0],
            [150.0, 1e-9],
            [-60.0, -150.0],
            [218.7, 0.0],
        ] {
            println!("{t:?}");
            for s in d.program.solve(&t).unwrap() {
                println!("   {s:?}");
            }
        }
    }
}
