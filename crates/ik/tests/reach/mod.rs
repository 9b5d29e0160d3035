//! Reachability maps, compared with plane geometry, with the screw solver, and with other methods of counting.

mod arms;
mod grids;
mod redundant;
mod stored;

use std::path::PathBuf;

use groebot_ik::derive::{Ends, InputFile};
use groebot_ik::folder;
use groebot_ik::reach::{Axis, Grid, ReachMap, Request, Survey};
use groebot_ik::solver::Program;
use groebot_ik::{Result, Watch};
use groebot_robot::kinematics::Chain;

/// The chain and the program of a committed derivation.
fn derivation(name: &str) -> (Chain, Program) {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../derivations")).join(name);
    let chain = InputFile::read(&folder).unwrap().chain(&Ends::default()).unwrap().unwrap();
    let program = folder::program(&folder).unwrap();
    (chain, program)
}

fn grid(axes: [(f64, f64, usize); 3]) -> Grid {
    Grid::new(axes.map(|(from, to, count)| Axis::new(from, to, count).unwrap())).unwrap()
}

fn map(name: &str, request: &Request) -> Result<ReachMap> {
    let (chain, program) = derivation(name);
    Survey::new(&program.solver(), &program, Some(&chain), request)?.map(&Watch::none())
}
