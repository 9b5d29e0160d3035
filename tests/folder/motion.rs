//! Forged equations of motion, and their certificates.

use groebot::folder::motion::check;
use groebot::folder::{DYNAMICS, DYNAMICS_TEXT, Finding, Stored, Verdict};
use serde_json::{Value, json};

use super::honest::{self, Honest};

fn fails(findings: &[Finding]) -> bool {
    findings.iter().any(|finding| matches!(finding.verdict, Verdict::Fails(_)))
}

fn with(honest: &Honest, name: &str, text: Option<&str>) -> Vec<Finding> {
    let mut stored: Stored = honest.stored.clone();
    match text {
        Some(text) => drop(stored.files.insert(name.to_owned(), text.as_bytes().to_vec())),
        None => drop(stored.files.remove(name)),
    }
    check(&honest.source, &stored)
}

#[test]
fn forged_polynomials_and_legends_are_refused() {
    let honest = Honest::new("planar_2r");
    assert!(!fails(&check(&honest.source, &honest.stored)), "{:?}", check(&honest.source, &honest.stored));
    let text = honest::text("planar_2r", DYNAMICS_TEXT);
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let mut count = 0;
    let mut refuse = |what: &str, lines: &[&str]| {
        let changed = lines.concat();
        if changed != text {
            assert!(fails(&with(&honest, DYNAMICS_TEXT, Some(&changed))), "{what}:\n{changed}");
            count += 1;
        }
    };
    for at in 0..lines.len() {
        let mut removed = lines.clone();
        let line = removed.remove(at);
        refuse("removed", &removed);
        let mut doubled = lines.clone();
        doubled.insert(at, line);
        refuse("doubled", &doubled);
        let mut exchanged = lines.clone();
        exchanged.swap(at, (at + 1) % lines.len());
        refuse("exchanged", &exchanged);
        for (from, to) in [("1", "2"), ("2", "3"), (" - ", " + "), (" = ", " = 2*"), ("\n", " \n"), ("0", "1")] {
            let changed = line.replacen(from, to, 1);
            let mut all = lines.clone();
            all[at] = &changed;
            refuse("changed", &all);
        }
    }
    refuse("another robot's", &[&honest::text("scara", DYNAMICS_TEXT)]);
    refuse("emptied", &[]);
    assert!(count > 120, "{count}");
    assert!(fails(&with(&honest, DYNAMICS_TEXT, None)) && fails(&with(&honest, DYNAMICS, None)));
}

#[test]
fn forged_certificates_of_motion_are_refused() {
    let honest = Honest::new("planar_2r");
    let whole: Value = serde_json::from_str(&honest::text("planar_2r", DYNAMICS)).unwrap();
    let gravity = whole["claims"]["gravity"].clone();
    let [x, y, z]: [String; 3] = serde_json::from_value(gravity.clone()).unwrap();
    let half = |word: &str| if word == "0" { "0".to_owned() } else { format!("{word}/2").replace("/100/2", "/200") };
    let turned = json!([y, z, x]);
    let changes: [(&str, Value); 12] = [
        ("/claims/gravity", json!([half(&x), half(&y), half(&z)])),
        ("/claims/gravity", turned),
        ("/claims/gravity", json!(["0", "0", "0"])),
        ("/claims/gravity", json!(["0", "0"])),
        ("/claims/terms", json!(27)),
        ("/claims/terms", json!("28")),
        ("/claims/masses", json!([])),
        ("/claims/masses", json!([["1", "0", "0", "0", "0", "0", "0", "0", "0", "0"]])),
        ("/name", json!("planar_3r")),
        ("/proves", json!("chain")),
        ("/format", json!(1)),
        ("/more", json!(1)),
    ];
    for (place, value) in changes {
        let mut forged = whole.clone();
        let (parent, key) = place.rsplit_once('/').unwrap();
        forged.pointer_mut(parent).unwrap()[key] = value.clone();
        assert_ne!(forged, whole);
        let text = serde_json::to_string_pretty(&forged).unwrap() + "\n";
        assert!(fails(&with(&honest, DYNAMICS, Some(&text))), "{place}: {value}");
    }
    for text in [honest::text("scara", DYNAMICS), honest::text("planar_2r", "certificate.json"), whole.to_string()] {
        assert!(fails(&with(&honest, DYNAMICS, Some(&text))), "{text}");
    }
}
