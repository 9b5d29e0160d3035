//! The solvers of chains that share actuators: printed from their programs, compiled, and answering like them.

use std::fs;
use std::path::Path;

use groebot_ik::solver::Program;

use super::harness::compare;

/// The targets of the ordinary rows of a folder's checks.
fn targets(folder: &Path, program: &Program, most: usize) -> Vec<Vec<f64>> {
    let rows = fs::read_to_string(folder.join("6_check.csv")).unwrap();
    let ordinary = rows.lines().filter(|row| row.starts_with("random,") || row.starts_with("rational,"));
    let numbers =
        |row: &str| row.split(',').skip(1).take(program.inputs.len()).map(|cell| cell.parse().unwrap()).collect();
    ordinary.take(most).map(numbers).collect()
}

#[test]
fn committed_solvers_of_coupled_chains_answer_like_their_programs() {
    for (name, least) in [("nao_legs_poses", 16), ("nao_legs_yaw", 16)] {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name);
        let program = Program::from_json(&fs::read_to_string(folder.join("5_program.json")).unwrap()).unwrap();
        let mut targets = targets(&folder, &program, 1);
        targets.push(vec![9.0; program.inputs.len()]);
        if let Some(report) = compare(&program, &targets) {
            assert!(report.answers >= least && report.refused == 1, "{name}: {report:?}");
        }
    }
}
