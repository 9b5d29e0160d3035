//! Whole reports.

use super::{assert_passes, derive, read};

#[test]
fn the_seed_mechanisms_pass() {
    for folder in ["nao_leg_sagittal", "nao_arm_planar"] {
        let source = read(folder);
        let derivation = derive(&source);
        let report = assert_passes(&source, &derivation.program, 500);
        println!("{folder}: {}", report.summary());
        println!("{}", report.to_csv());
    }
}
