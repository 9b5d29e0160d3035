//! Forged equations of motion, and their certificates.

use super::honest::{self, Honest};
use groebot_ik::folder::motion::check;
use groebot_ik::folder::{DYNAMICS, DYNAMICS_TEXT, Finding, Stored, Verdict};

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
    let whole = honest::text("planar_2r", DYNAMICS);
    let masses = |list: &str| format!("\"masses\": [{list}],\n    \"terms\"");
    let ten = "[\n        \"1\"".to_owned() + &",\n        \"0\"".repeat(9) + "\n      ]";
    let both = format!("\n      {ten},\n      {ten}\n    ");
    for (from, to) in [
        ("-981/100", "-981/200"),
        ("-981/100", "981/100"),
        ("-981/100", "-9.81"),
        ("-981/100", "0"),
        ("\"0\"", "\"1\""),
        ("\"0\",", ""),
        ("\"terms\": 28", "\"terms\": 27"),
        ("\"terms\": 28", "\"terms\": \"28\""),
        ("\"terms\"", &masses("")),
        ("\"terms\"", &masses(&both)),
        ("planar_2r", "planar_3r"),
        ("\"dynamics\"", "\"chain\""),
        ("\"format\": 7", "\"format\": 1"),
        ("\"format\"", "\"more\": 1,\n  \"format\""),
        ("\n", " \n"),
    ] {
        let forged = whole.replacen(from, to, 1);
        assert_ne!(forged, whole, "{from}");
        assert!(fails(&with(&honest, DYNAMICS, Some(&forged))), "{from}: {to}");
    }
    for text in [honest::text("scara", DYNAMICS), honest::text("planar_2r", "certificate.json"), String::new()] {
        assert!(fails(&with(&honest, DYNAMICS, Some(&text))), "{text}");
    }
}
