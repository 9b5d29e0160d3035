//! The hashes of a thin folder: how they are read, and the findings of a check.

use groebot_ik::ErrorKind;
use groebot_ik::derive::report::stages::PAGE;
use groebot_ik::folder::{CERTIFICATE, CHECKS, OUTPUTS, Outputs, Stored, Verdict, Written, compare, thin};

use super::honest::Honest;

/// The SHA-256 of `abc`: FIPS 180-4, appendix B.1.
const ABC: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

fn file(name: &str, text: &str) -> Written {
    Written { name: name.to_owned(), bytes: text.as_bytes().to_vec(), proved: text.len() }
}

#[test]
fn each_output_has_its_hash() {
    let written = [file("2_plan.txt", "abc"), file(PAGE, "a page"), file(CERTIFICATE, "{}")];
    let outputs = Outputs::of(&written);
    assert_eq!(outputs.names().collect::<Vec<_>>(), ["2_plan.txt"]);
    assert_eq!(outputs.get("2_plan.txt"), Some(ABC));
    assert!(outputs.to_text().ends_with(&format!("\n{ABC}  2_plan.txt\n")));
    assert_eq!(Outputs::read(&outputs.to_text()), Ok(outputs.clone()));
    let kept = thin(written.to_vec());
    let names: Vec<&str> = kept.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, [PAGE, CERTIFICATE, OUTPUTS]);
    assert_eq!(kept[2].bytes, outputs.to_text().into_bytes());
}

/// The hash of a table of checks covers its words and counts: computed with `sha256sum` of `kind,px,solutions\nround,*,8\n`.
#[test]
fn the_hash_of_a_table_has_no_measured_numbers() {
    let hash = |table: &str| Outputs::of(&[file(CHECKS, table)]).get(CHECKS).unwrap().to_owned();
    let one = hash("kind,px,solutions\nround,1.5e-1,8\n");
    assert_eq!(one, "18997582dc404b94c70dc5d6b5fe0fe360643500625e17e5703c6e6af181ccd9");
    assert_eq!(hash("kind,px,solutions\nround,1.500000001e-1,8\n"), one);
    assert_ne!(hash("kind,px,solutions\nround,1.5e-1,7\n"), one);
    assert_ne!(hash("kind,px,solutions\nsingular,1.5e-1,8\n"), one);
    assert_ne!(hash("kind,px,solutions\nround,none,8\n"), one);
}

#[test]
fn lines_that_are_no_hashes_are_refused() {
    let line = format!("{ABC}  a.txt");
    for (text, number) in [
        (format!("# a comment\n{}  a.txt\n", &ABC[1..]), 2),
        (format!("{}  a.txt", ABC.to_uppercase()), 1),
        (format!("{ABC} a.txt"), 1),
        (format!("{ABC}  "), 1),
        (format!("{line}\n\n"), 2),
        (format!("{line}\n{line}\n"), 2),
    ] {
        let error = Outputs::read(&text).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::Syntax, Some(number)), "{text}");
    }
    assert_eq!(Outputs::read("").unwrap().names().count(), 0);
}

/// Every hash of a derivation that is changed, removed, duplicated or exchanged is rejected with the name of its file.
#[test]
fn forged_hashes_are_refused() {
    let honest = Honest::new("planar_2r");
    let (written, checked) = honest.written();
    let mut stored = Stored { files: Default::default(), others: Default::default(), ..honest.stored.clone() };
    stored.files.extend(thin(written.clone()).into_iter().map(|file| (file.name, file.bytes)));
    let text = String::from_utf8(stored.files[OUTPUTS].clone()).unwrap();
    let mut failed = |text: &str| -> Vec<String> {
        stored.files.insert(OUTPUTS.to_owned(), text.as_bytes().to_vec());
        let findings = compare(&stored, &written, "proof", &checked);
        assert_eq!(findings.len(), written.len() + 1);
        let fails = findings.into_iter().filter(|finding| matches!(finding.verdict, Verdict::Fails(_)));
        fails.map(|finding| finding.what).collect()
    };
    assert!(failed(&text).is_empty());
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    assert!(lines.len() >= 9);
    for (at, line) in lines.iter().enumerate() {
        let name = line.split_once("  ").unwrap().1;
        let last = if line.as_bytes()[63] == b'0' { "1" } else { "0" };
        assert_eq!(failed(&text.replace(line, &format!("{}{last}{}", &line[..63], &line[64..]))), [name, OUTPUTS]);
        assert_eq!(failed(&text.replace(&format!("{line}\n"), "")), [name, OUTPUTS]);
        let other = lines[(at + 1) % lines.len()];
        let exchanged = failed(&text.replace(line, &format!("{}{}", &other[..64], &line[64..])));
        assert_eq!(exchanged, [name, OUTPUTS]);
        assert_eq!(failed(&format!("{text}{line}\n")).last().unwrap(), OUTPUTS);
    }
    assert_eq!(failed(&format!("{text}{ABC}  8_more.txt\n")), [OUTPUTS]);
    assert_eq!(failed(&format!("{text}# a remark\n")), [OUTPUTS]);
    assert_eq!(failed(&text.replacen("SHA-256", "SHA-512", 1)), [OUTPUTS]);
    assert_eq!(failed("").len(), lines.len() + 1);
}
