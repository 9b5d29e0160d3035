//! `groebot identify`: its reports on good and bad logs, and its exit status.

use std::fs;

use tempfile::tempdir;

use super::{refused, root, run, text};

fn corpus(name: &str) -> String {
    text(&root("tests/corpus/dynamics/faults").join(name)).to_owned()
}

#[test]
fn a_heavy_hinge_is_a_body() {
    let folder = tempdir().unwrap();
    let table = folder.path().join("found.csv");
    let ran = run(&["identify", &corpus("hinge.urdf"), &corpus("hinge_of_100_kg.csv"), "-o", text(&table)]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{}", ran.out);
    assert!(ran.out.contains("physically possible within the noise") && !ran.out.contains("bad data"), "{}", ran.out);
    let reported = fs::read_to_string(&table).unwrap();
    assert!(reported.starts_with("name,value,confidence_95,described,of_bodies\n\"l1.mx\",0.25,"), "{reported}");
}

/// Three torques for three parameters: the noise cannot be estimated.
#[test]
fn without_a_degree_of_freedom_there_is_no_interval() {
    let files = [corpus("hinge.urdf"), corpus("hinge_three_rows.csv")];
    let ran = run(&["identify", &files[0], &files[1]]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("0 degrees of freedom left") && ran.out.contains("no interval:"), "{}", ran.out);
    let ran = run(&["identify", &files[0], &files[1], "--json"]);
    let report: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(report["format"], 2);
    let rows = report["parameters"].as_array().unwrap();
    assert!(rows.len() == 3 && rows.iter().all(|row| row["confidence_95"].is_null()), "{}", ran.out);
}

#[test]
fn a_cell_out_of_range_is_refused_with_its_line_and_column() {
    let robot = root("tests/corpus/dynamics/rrp.urdf");
    let reported = refused(&["identify", text(&robot), &corpus("rrp_out_of_range.csv")]);
    assert!(reported.contains("line 5: column `v0`: `1e160` is too large"), "{reported}");
}

/// A hinge with torques of the opposite sign, and one with torques in mN m; columns by joint name.
#[test]
fn bad_data_has_the_exit_status_three() {
    let folder = tempdir().unwrap();
    let log = folder.path().join("log.csv");
    // By hand: tau = I a - m c g cos q, with I = 0.0825 and m c = 0.25. A rotation about y maps x downwards.
    let row = |number: usize, factor: f64| {
        let (q, a) = (0.37 * number as f64, f64::from((number * 7 % 11) as u8) - 5.0);
        let torque = factor * (0.0825 * a - 0.25 * 9.81 * q.cos());
        format!("{torque},{q},0,{a}\n")
    };
    for (factor, code, words) in
        [(1.0, 0, ""), (-1.0, 3, "opposite to those of the description"), (1000.0, 3, "times those of the description")]
    {
        let rows: String = (0..40).map(|number| row(number, factor)).collect();
        fs::write(&log, format!("tau:j1,q:j1,v:j1,a:j1\n{rows}")).unwrap();
        let ran = run(&["identify", &corpus("hinge.urdf"), text(&log)]);
        assert_eq!((ran.code, ran.err.as_str()), (code, ""), "{factor}: {}", ran.out);
        assert!(ran.out.contains(words) && ran.out.contains("bad data") == (code == 3), "{factor}: {}", ran.out);
    }
}
