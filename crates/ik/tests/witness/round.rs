//! Round targets for all kinds of solvers. `cargo test --release --test main -- --ignored round_targets_of_all_robots --nocapture` prints the rows of
//! `benches/record/DATE-round.csv`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use groebot_ik::derive::{AnyView, Derivation, Ends, InputFile, Source};
use groebot_ik::witness::{Fault, Report, Row, Verdict, check_round};
use groebot_ik::{Result, Watch};
use groebot_robot::kinematics::Chain;

use crate::eigenvalue::Random;

/// The number of targets of each robot, unless `GROEBOT_TARGETS` is set. A third each has angles in multiples of 15 degrees, angles in multiples of 30 degrees,
/// and axis-aligned poses on a grid.
const TARGETS: usize = 2001;
/// The number of random arms.
const ARMS: usize = 20;
/// Arms with an offset in the wrist, with dimensions of their makers: shoulder height, upper arm, forearm, wrist offset, flange (m).
const OFFSET_WRISTS: [(&str, [f64; 5]); 6] = [
    ("FANUC CRX-5iA", [0.185, 0.41, 0.43, -0.13, 0.145]),
    ("FANUC CRX-10iA", [0.245, 0.54, 0.54, -0.15, 0.16]),
    ("FANUC CRX-10iA/L", [0.245, 0.71, 0.54, -0.15, 0.16]),
    ("FANUC CRX-30iA", [0.37, 0.95, 0.75, -0.185, 0.18]),
    ("Yaskawa HC10", [0.275, 0.70, 0.50, -0.162, 0.17]),
    ("Yaskawa HC10DT", [0.275, 0.70, 0.50, -0.162, 0.13]),
];

/// A revolute joint: its position in the previous link (m), and its axis.
type Joint = ([f64; 3], [i8; 3]);

/// A description of a serial chain of links.
fn urdf(joints: &[Joint], tip: [f64; 3]) -> String {
    let mut text = "<robot name=\"arm\">\n<link name=\"link0\"/>\n".to_owned();
    let origin = |[x, y, z]: [f64; 3]| format!("<origin xyz=\"{x} {y} {z}\"/>");
    for (number, (place, [x, y, z])) in joints.iter().enumerate() {
        let next = number + 1;
        let _ = writeln!(
            text,
            "<link name=\"link{next}\"/>\n<joint name=\"joint{next}\" type=\"continuous\"><parent link=\"link{number}\"/><child link=\"link{next}\"/>\
             {}<axis xyz=\"{x} {y} {z}\"/></joint>",
            origin(*place)
        );
    }
    let _ = writeln!(
        text,
        "<link name=\"tip\"/>\n<joint name=\"flange\" type=\"fixed\"><parent link=\"link{}\"/><child link=\"tip\"/>{}</joint>\n</robot>",
        joints.len(),
        origin(tip)
    );
    text
}

fn offset_wrist([height, upper, fore, offset, flange]: [f64; 5]) -> String {
    let joints = [
        ([0.0, 0.0, height], [0, 0, 1]),
        ([0.0; 3], [0, 1, 0]),
        ([0.0, 0.0, upper], [0, -1, 0]),
        ([0.0; 3], [-1, 0, 0]),
        ([fore, 0.0, 0.0], [0, -1, 0]),
        ([0.0, offset, 0.0], [-1, 0, 0]),
    ];
    urdf(&joints, [flange, 0.0, 0.0])
}

/// An arm whose axes are along x, y or z. Half of its links have offsets in multiples of 5 cm.
fn random_arm(random: &mut Random) -> String {
    let mut place = |most: i64| match random.integer(0, 1) {
        0 => [0.0; 3],
        _ => [(); 3].map(|()| random.integer(-most, most) as f64 * 0.05),
    };
    let places: Vec<[f64; 3]> = (0..6).map(|_| place(6)).collect();
    let tip = place(3);
    let axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    let joints: Vec<Joint> = places.into_iter().map(|at| (at, axes[random.integer(0, 2) as usize])).collect();
    urdf(&joints, tip)
}

fn source_of(text: &str) -> Source {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("arm.urdf");
    std::fs::write(&file, text).unwrap();
    let chain = InputFile::read(&file).unwrap().chain(&Ends::default()).unwrap().unwrap();
    Source::of_chain(chain, &Ends::default()).unwrap()
}

/// Whether every target has infinitely many solutions.
fn is_degenerate(chain: &Chain) -> bool {
    let mut random = Random::new(1);
    (0..5).all(|_| chain.body_jacobian(&random.angles()).unwrap().singular_values().min() < 1e-9)
}

fn kind(proved: &Derivation) -> &'static str {
    match proved.view() {
        AnyView::Equations(_) => "equations",
        AnyView::Sequential(derived) if derived.problem.truth.is_some() => "joint by joint, described",
        AnyView::Sequential(_) => "joint by joint",
        AnyView::Eigenvalue(_) => "six joints together",
        AnyView::Coupled(_) => "shared actuators",
    }
}

fn count(report: &Report, holds: impl Fn(&Row) -> bool) -> usize {
    report.rows.iter().filter(|row| holds(row)).count()
}

/// Derives and checks a robot and prints its row. Returns whether all ordinary solutions were found.
fn is_complete(name: &str, source: &Source) -> Result<bool> {
    let proved = Derivation::of(source, &Watch::none())?;
    let targets = std::env::var("GROEBOT_TARGETS").map_or(TARGETS, |number| number.parse().unwrap());
    let report = check_round(source, &proved, targets, &Watch::none())?;
    let has = |row: &Row, fault: Fault| matches!(&row.verdict, Verdict::Fail(faults) if faults.contains(&fault));
    let mut faults: BTreeMap<String, usize> = BTreeMap::new();
    for fault in report.failures().flat_map(|row| row.verdict.faults()) {
        *faults.entry(fault.to_string()).or_default() += 1;
    }
    let is_missed = |row: &Row| {
        has(row, Fault::Oracle)
            || has(row, Fault::Moved)
            || (!row.is_singular && matches!(row.verdict, Verdict::Fail(_)))
    };
    let missed = count(&report, is_missed);
    let faults: Vec<String> = faults.iter().map(|(fault, rows)| format!("{fault} {rows}")).collect();
    println!(
        "{name},{},{},{},{},{},{},{missed},{}",
        kind(&proved),
        report.rows.len(),
        count(&report, |row| row.solutions > 0),
        report.rows.iter().map(|row| row.solutions).sum::<usize>(),
        count(&report, |row| row.oracle.is_some()),
        count(&report, |row| row.screw.is_some()),
        faults.join("; "),
    );
    for row in report.failures().filter(|row| is_missed(row)).take(4) {
        println!("# {row}; from {:?}", row.joints);
    }
    Ok(missed == 0)
}

/// Whether the name contains `GROEBOT_ROBOTS`, or that variable is not set.
fn is_requested(name: &str) -> bool {
    std::env::var("GROEBOT_ROBOTS").is_ok_and(|part| !name.contains(&part)).then_some(()).is_none()
}

#[test]
#[ignore = "an hour: 2,001 targets of each of 70 robots, each searched numerically"]
fn round_targets_of_all_robots() {
    println!(
        "robot,solver,targets,with answers,answers,searched,by screws,targets that miss an ordinary answer,faults of targets"
    );
    let mut wrong = Vec::new();
    let mut run = |name: &str, source: &Source| match is_complete(name, source) {
        Ok(true) => {}
        Ok(false) => wrong.push(name.to_owned()),
        Err(error) => println!("# {name}: {error}"),
    };
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    let mut folders: Vec<_> = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    for folder in folders {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        if is_requested(&name) {
            run(&name, &Source::read(&folder).unwrap());
        }
    }
    for (name, lengths) in OFFSET_WRISTS.into_iter().filter(|(name, _)| is_requested(name)) {
        run(name, &source_of(&offset_wrist(lengths)));
    }
    let mut random = Random::new(47);
    let mut arms = 0;
    while arms < ARMS {
        let source = source_of(&random_arm(&mut random));
        if source.chain.as_ref().is_some_and(is_degenerate) {
            continue;
        }
        arms += 1;
        let name = format!("random arm {arms}");
        if is_requested(&name) {
            run(&name, &source);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
