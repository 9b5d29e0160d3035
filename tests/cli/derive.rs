//! `groebot derive`: the report equals the NAO document, and files are written to the expected folders.

use std::fs;

use groebot::number::{Rationals, Ring};
use groebot::poly::{Order, PolynomialRing, parse_equation};
use tempfile::tempdir;

use super::{Derived, content, folder_with, leg, refused, root, run, succeed, text};

/// The lines of a report under the heading that starts with `title`, without their names. Wrapped lines are joined.
fn section(report: &str, title: &str) -> Vec<String> {
    let mut entries: Vec<String> = Vec::new();
    let lines = report.lines().skip_while(|line| !line.starts_with(title)).skip(1);
    for line in lines.take_while(|line| !line.is_empty()) {
        match entries.last_mut() {
            Some(last) if line.starts_with("     ") => {
                last.push(' ');
                last.push_str(line.trim());
            }
            _ => entries.push(line.trim().split_once("  ").map_or(line.trim(), |(_, rest)| rest.trim()).to_owned()),
        }
    }
    entries
}

/// Checks that both lists have the same polynomials, in any order and up to sign.
fn assert_same_polynomials(names: &[&str], printed: &[String], expected: &[&str]) {
    let ring = PolynomialRing::new(Rationals, names, Order::Lex).unwrap();
    let read = |text: &str| parse_equation(text).unwrap().evaluate(&ring).unwrap();
    let mut left: Vec<_> = printed.iter().map(|text| read(text)).collect();
    assert_eq!(left.len(), expected.len(), "{printed:?}");
    for text in expected {
        let f = read(text);
        let found = left.iter().position(|g| *g == f || *g == ring.neg(&f));
        left.remove(found.unwrap_or_else(|| panic!("{text} is not among {printed:?}")));
    }
}

#[test]
fn the_report_prints_the_documents_own_polynomials_of_the_leg() {
    let printed = section(&leg().report, "Groebner basis");
    let expected = [
        // NAO (6.7.16) with its a, b and c; 346226.3281 is printed as 346226.3.
        "40000*(px^2 + pz^2)*s3^2 + (-400*(px^3 + px*pz^2) + 235364*px)*s3 \
         + 346226.3281 - 1176.82*px^2 - 41176.82*pz^2 + px^4 + 2*px^2*pz^2 + pz^4 = 0",
        // NAO (6.7.17), (6.7.18), (6.7.19)
        "200*(px^2 + pz^2)*s3 + 20580*pz*s4 + 588.41*px - px^3 - px*pz^2 = 0",
        "-px^2 - pz^2 + 20580*c4 + 20588.41 = 0",
        "200*pz*c3 - px^2 + 200*px*s3 - pz^2 + 588.41 = 0",
    ];
    assert_same_polynomials(&["c4", "c3", "s4", "s3", "px", "pz"], &printed, &expected);
}

#[test]
fn the_report_prints_the_equations_with_their_labels() {
    let arm = Derived::new("nao_arm_planar", "0_system.toml");
    let printed = section(&arm.report, "Equations");
    let expected = [
        "105*c2 + (55.95 + 57.75)*s4 - pz = 0",
        "105*s2 + (55.95 + 57.75)*c4 - py = 0",
        "c2^2 + s2^2 - 1 = 0",
        "c4^2 + s4^2 - 1 = 0",
    ];
    assert_same_polynomials(&["c4", "c2", "s4", "s2", "py", "pz"], &printed, &expected);
    assert!(arm.report.contains("(6.7.1) "), "{}", arm.report);
}

#[test]
fn the_report_is_complete() {
    let report = &leg().report;
    let requested = [
        "2 complex solutions",
        "divides by pz",
        "divides by px^2 + pz^2",
        "c4 > c3 > s3 > s4  1 smaller  <- used",
        "separate formulas, up to 2 solutions",
        "atan2(s3, c3)",
        "S-polynomials reduce to zero",
        "certificate.json",
        "Time",
    ];
    for part in requested {
        assert!(report.contains(part), "`{part}` is missing in\n{report}");
    }
    let origin = report.lines().find(|line| line.contains("px = 0") && line.contains("pz = 0")).unwrap();
    assert!(origin.contains("no solution"), "{origin}");
    assert!(!report.contains('\x1b'), "colour is for terminals");
    let paths = leg().path();
    let long = report.lines().find(|line| line.chars().count() > 100 && !line.contains(paths));
    assert_eq!(long, None);
}

#[test]
fn equal_links_free_the_hip_at_the_origin() {
    let folder = tempdir().unwrap();
    let leg = fs::read_to_string(root("derivations/nao_leg_sagittal/0_chain.toml")).unwrap();
    fs::write(folder.path().join("0_chain.toml"), leg.replace("202.9", "200")).unwrap();
    let report = succeed(&["derive", text(folder.path())]);
    assert!(report.contains("HipPitch is free"), "{report}");
    let solved = succeed(&["solve", text(folder.path()), "--target", "0,0"]);
    assert!(solved.contains("HipPitch is free") && solved.contains("any value"), "{solved}");
    assert!(solved.contains("180.000000 deg"), "the knee is folded: {solved}");
}

#[test]
fn files_are_next_to_the_input_and_reproducible() {
    let folder = folder_with("nao_leg_sagittal", "0_chain.toml");
    let file = folder.path().join("0_chain.toml");
    assert_eq!(succeed(&["derive", text(&file), "--quiet"]), "");
    assert_eq!(content(folder.path()), content(leg().folder.path()));
}

#[test]
fn another_file_gets_a_folder_with_a_copy_of_it() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("my_leg.toml");
    fs::copy(root("derivations/nao_leg_sagittal/0_chain.toml"), &file).unwrap();
    succeed(&["derive", text(&file), "--quiet"]);
    assert_eq!(content(&folder.path().join("my_leg")), content(leg().folder.path()));
    let elsewhere = folder.path().join("a/b");
    succeed(&["derive", text(&file), "--quiet", "--out", text(&elsewhere)]);
    assert_eq!(content(&elsewhere), content(leg().folder.path()));
}

#[test]
fn a_folder_of_another_mechanism_is_left_alone() {
    let folder = folder_with("nao_leg_sagittal", "0_chain.toml");
    let before = content(folder.path());
    let arm = root("derivations/nao_arm_planar");
    let ran = run(&["derive", text(&arm), "--out", text(folder.path())]);
    assert_eq!((ran.code, content(folder.path())), (1, before));
    assert!(ran.err.contains("0_chain.toml") && ran.err.contains("--out"), "{}", ran.err);
}

/// A user's description, from which nothing has been derived, is not replaced by that of another robot.
#[test]
fn a_description_that_somebody_wrote_stays() {
    let folder = folder_with("polar", "0_chain.toml");
    let before = content(folder.path());
    let input = root("derivations/planar_2r/0_chain.toml");
    let error = refused(&["derive", text(&input), "--quiet", "--out", text(folder.path())]);
    assert!(error.contains("this folder has another `0_chain.toml`, which nothing has been derived from"), "{error}");
    assert_eq!(content(folder.path()), before);
    // An equal description is accepted, and one from which a solver was derived may be replaced.
    let same = root("derivations/polar/0_chain.toml");
    succeed(&["derive", text(&same), "--quiet", "--out", text(folder.path())]);
    succeed(&["derive", text(&input), "--quiet", "--out", text(folder.path())]);
}
