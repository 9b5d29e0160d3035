//! Files of derivations: programs, certificates, equations of motion, reach maps, and the check of a folder.

use std::path::PathBuf;
use std::sync::LazyLock;

use groebot::Watch;
use groebot::cli::readers;
use groebot::codegen::{c99::Pair, rust};
use groebot::derive::Derivation;
use groebot::dynamics::exact::Certificate;
use groebot::folder::{self, DYNAMICS, DYNAMICS_TEXT, Finding, Stored, Verdict};
use groebot::reach::ReachMap;
use groebot::solver::Program;
use groebot::witness::{self, Report};

use super::given::{CHAIN, PLANAR_2R_CERTIFICATE, PLANAR_2R_DYNAMICS, PLANAR_2R_EQUATIONS, SOURCES};
use super::{Target, read, text};

pub(super) const TARGETS: [Target; 6] = [
    Target {
        name: "program_json",
        about: "derived solvers, `solver::Program`, and their generated code",
        run: program_json,
        damaged: 100,
    },
    Target {
        name: "certificate",
        about: "certificates, `derive::Derivation::prove_source`",
        run: certificate,
        damaged: 60,
    },
    Target { name: "dynamics_json", about: "certificates of equations of motion", run: dynamics_json, damaged: 100 },
    Target {
        name: "dynamics_text",
        about: "equations of motion that a certificate proves",
        run: dynamics_text,
        damaged: 100,
    },
    Target {
        name: "folder",
        about: "a folder with one modified file, `folder::check`; the first line is the file's name",
        run: folder,
        damaged: 20,
    },
    Target { name: "reach_json", about: "reach maps of solvers, `reach::ReachMap`", run: reach_json, damaged: 200 },
];

/// Maps with more points are read but not drawn.
const PLACES: usize = 100_000;

/// The text of a program is read as the same program. It is generated as code, reads a table of targets, and solves
/// one.
fn program_json(bytes: &[u8]) {
    let Some(program) = read(Program::from_json(&text(bytes))) else { return };
    assert_eq!(Program::from_json(&program.to_json()).map(|again| again.to_json()), Ok(program.to_json()));
    let _ = (Pair::new(&program, "solver"), rust::emit(&program));
    let row = vec!["0.5"; program.inputs.len()].join(",");
    for target in read(readers::solver_targets(&program, row.as_bytes(), false)).unwrap_or_default() {
        let _ = read(program.solver().solve_numbers(&target));
    }
}

/// A certificate that proves a derivation is written again as one with the same claims.
fn certificate(bytes: &[u8]) {
    for source in &*SOURCES {
        let Some(proved) = read(Derivation::prove_source(source, &text(bytes))) else { continue };
        let printed = proved.certificate().expect("what is proved is printed");
        assert_eq!(Derivation::prove_source(source, &printed).as_ref(), Ok(&proved));
    }
}

/// The text of a certificate is read as the same one. It proves no equations other than the committed ones.
fn dynamics_json(bytes: &[u8]) {
    let name = CHAIN.name();
    let Some(certificate) = read(Certificate::from_json(&text(bytes), name)) else { return };
    assert_eq!(Certificate::from_json(&certificate.to_json(), name).as_ref(), Ok(&certificate));
    if read(certificate.prove(&CHAIN, PLANAR_2R_EQUATIONS)).is_some() {
        assert_eq!(certificate.to_json(), PLANAR_2R_DYNAMICS);
    }
}

/// Proved equations are equal to the committed ones.
fn dynamics_text(bytes: &[u8]) {
    let certificate = Certificate::from_json(PLANAR_2R_DYNAMICS, CHAIN.name()).expect("is committed");
    if read(certificate.prove(&CHAIN, &text(bytes))).is_some() {
        assert_eq!(text(bytes), PLANAR_2R_EQUATIONS);
    }
}

/// The derivation of a chain with two joints, its numeric checks, and the files of its folder.
static HONEST: LazyLock<(Derivation, Report, Stored)> = LazyLock::new(|| {
    let source = &SOURCES[1];
    let proved = Derivation::prove_source(source, PLANAR_2R_CERTIFICATE).expect("is committed").about(source);
    let checked = witness::check(source, &proved, &Watch::none()).expect("is committed");
    let written = folder::derived(source, &proved, &checked).expect("is committed");
    let motion = [(DYNAMICS, PLANAR_2R_DYNAMICS), (DYNAMICS_TEXT, PLANAR_2R_EQUATIONS)];
    let motion = motion.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    let files = written.into_iter().map(|file| (file.name, file.bytes)).chain(motion).collect();
    (proved, checked, Stored { folder: PathBuf::from("planar_2r"), files, others: Default::default() })
});

/// The findings of a check of a folder. The slow numeric checks of the unmodified derivation run once.
fn findings(stored: &Stored) -> Vec<Finding> {
    let (source, (honest, report, _)) = (&SOURCES[1], &*HONEST);
    let measure = |proved: &Derivation| {
        if proved == honest { Ok(report.clone()) } else { witness::check(source, proved, &Watch::none()) }
    };
    let checked = read(folder::check_by(source, stored, &Watch::none(), measure));
    checked.map(|checked| checked.findings).unwrap_or_default()
}

/// A modified file fails, is foreign, or is equal up to rounding of measured values.
fn folder(bytes: &[u8]) {
    let end = bytes.iter().position(|byte| *byte == b'\n').unwrap_or(bytes.len());
    let (name, content) = (text(&bytes[..end]).into_owned(), bytes.get(end + 1..).unwrap_or_default());
    let mut stored = HONEST.2.clone();
    let old = stored.files.insert(name.clone(), content.to_vec());
    let is_forged = old.is_some_and(|old| old != content);
    for Finding { what, verdict, .. } in findings(&stored) {
        match verdict {
            Verdict::Holds(words) => {
                assert!(!(what == name && is_forged) || words.contains("rounding"), "{name}: {words}");
            }
            Verdict::Fails(error) => super::check_refusal(&error),
            Verdict::NotChecked(_) => {}
        }
    }
}

/// The text of a map is read as the same map, and drawn.
fn reach_json(bytes: &[u8]) {
    let Some(map) = read(ReachMap::from_json(&text(bytes))) else { return };
    assert_eq!(ReachMap::from_json(&map.to_json()).map(|again| again.to_json()), Ok(map.to_json()));
    let _ = map.to_csv();
    if map.grid.places() < PLACES {
        let _ = map.to_svg(None);
    }
}
