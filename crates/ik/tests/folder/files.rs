//! Forged files: removed, emptied, truncated, changed, with lines removed, duplicated and exchanged, or taken from another robot.

use groebot_ik::derive::report::stages::PAGE;
use groebot_ik::folder::{
    CERTIFICATE, CHECKS, Finding, Stored, Verdict, Written, compare, is_printed_solver, is_written_name,
};

use super::honest::{self, Honest};

/// Number of places in a file that are changed.
const PLACES: usize = 12;

/// `text` with its lines changed, if the result differs.
fn with_lines(text: &str, change: impl Fn(&mut Vec<&str>)) -> Option<String> {
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    change(&mut lines);
    let changed = lines.concat();
    (changed != text).then_some(changed)
}

/// A text with another digit, or with another letter if there is no digit after `place`.
fn with_another(text: &str, place: usize) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let digit = (place..bytes.len()).find(|&at| bytes[at].is_ascii_digit());
    let at = digit.or_else(|| (place..bytes.len()).find(|&at| bytes[at].is_ascii_alphabetic()))?;
    bytes[at] = if bytes[at] == b'1' { b'2' } else { b'1' };
    String::from_utf8(bytes).ok()
}

/// Forgeries of a text, each with a description.
fn forgeries(text: &str, proved: usize, other: &str) -> Vec<(String, String)> {
    let count = text.lines().count();
    let mut forged = vec![
        ("emptied".to_owned(), String::new()),
        ("cut".to_owned(), text.chars().take(text.chars().count() / 2).collect()),
        ("a line more".to_owned(), format!("{text}and more\n")),
        ("without its end".to_owned(), text.trim_end().to_owned()),
        ("with other ends of lines".to_owned(), text.replace('\n', "\r\n")),
        ("another robot's".to_owned(), other.to_owned()),
    ];
    for part in 0..PLACES {
        let line = part * count / PLACES;
        let mut add = |what: &str, changed: Option<String>| {
            forged.extend(changed.map(|changed| (format!("{what} at line {}", line + 1), changed)));
        };
        add("a line removed", with_lines(text, |lines| _ = lines.remove(line)));
        add("a line doubled", with_lines(text, |lines| lines.insert(line, lines[line])));
        add("two lines exchanged", with_lines(text, |lines| lines.swap(line, (line + 1) % count)));
        add(
            "a digit changed",
            with_another(&text[..proved], part * proved / PLACES).map(|head| head + &text[proved..]),
        );
    }
    forged.retain(|(_, changed)| changed != text);
    forged
}

fn found<'a>(findings: &'a [Finding], name: &str) -> &'a Verdict {
    &findings.iter().find(|finding| finding.what == name).unwrap().verdict
}

/// Forges every file of a derivation. Returns the number of forgeries.
fn forge_files(honest: &Honest, other: &str) -> usize {
    let (written, checked) = honest.written();
    let mut stored = Stored { files: Default::default(), others: Default::default(), ..honest.stored.clone() };
    stored.files.extend(written.iter().map(|file| (file.name.clone(), file.bytes.clone())));
    let check = |stored: &Stored| compare(stored, &written, "proof", &checked);
    assert!(check(&stored).iter().all(|finding| matches!(finding.verdict, Verdict::Holds(_))));
    let mut count = 0;
    for Written { name, bytes, proved } in &written {
        assert!(is_written_name(name) || name == PAGE, "{name}");
        let is_code = name.ends_with(".c") || name.ends_with(".h") || name.ends_with(".rs") || name.ends_with(".cpp");
        assert_eq!(is_printed_solver(bytes), is_code, "{name}");
        let mut forged = stored.clone();
        forged.files.remove(name);
        assert!(matches!(found(&check(&forged), name), Verdict::Fails(_)), "{name} removed");
        let text = std::str::from_utf8(bytes).unwrap();
        for (what, changed) in forgeries(text, *proved, &honest::text(other, name)) {
            forged.files.insert(name.clone(), changed.into_bytes());
            let findings = check(&forged);
            // The page of another robot has groebot's mark, but is not that of this folder.
            let Verdict::Fails(error) = found(&findings, name) else { panic!("{name}: {what}: {findings:?}") };
            assert!(error.to_string().contains(name.as_str()), "{error}");
            let others = findings.iter().filter(|finding| finding.what != *name);
            assert!(others.clone().all(|finding| matches!(finding.verdict, Verdict::Holds(_))), "{name}: {what}");
            count += 1;
        }
    }
    count
}

#[test]
fn forged_files_of_equations_are_refused() {
    assert!(forge_files(&Honest::new("nao_arm_planar"), "nao_leg_sagittal") > 300);
}

#[test]
fn forged_files_of_a_chain_are_refused() {
    assert!(forge_files(&Honest::new("planar_2r"), "puma") > 300);
}

#[test]
fn forged_files_of_an_eigenvalue_problem_are_refused() {
    assert!(forge_files(&Honest::new("crx_like"), "jaco_like") > 300);
}

#[test]
fn forged_files_of_coupled_chains_are_refused() {
    assert!(forge_files(&Honest::two_arms(), "nao_left_leg") > 300);
}

/// Table cells with changes that rounding cannot explain.
#[test]
fn measured_numbers_are_measured_again() {
    let honest = Honest::new("planar_2r");
    let (written, checked) = honest.written();
    let mut stored = honest.stored.clone();
    stored.files.extend(written.iter().map(|file| (file.name.clone(), file.bytes.clone())));
    let mut verdict = |name: &str, change: &dyn Fn(&str) -> String| {
        let file = written.iter().find(|file| file.name == name).unwrap();
        let text = String::from_utf8(file.bytes.clone()).unwrap();
        let changed = change(&text);
        assert_ne!(changed, text);
        stored.files.insert(name.to_owned(), changed.into_bytes());
        let findings = compare(&stored, &written, "proof", &checked);
        stored.files.insert(name.to_owned(), file.bytes.clone());
        found(&findings, name).clone()
    };
    let row = |text: &str, column: usize, value: &dyn Fn(&str) -> String| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let mut cells: Vec<String> = lines[1].split(',').map(str::to_owned).collect();
        let column = if column < 3 { column } else { cells.len() + 2 - column };
        cells[column] = value(&cells[column]);
        lines[1] = cells.join(",");
        lines.join("\n") + "\n"
    };
    // Columns from 3 on count from the end: verdict, nearest, residual, oracle.
    let more = |cell: &str| format!("{:.16e}", cell.parse::<f64>().unwrap() + 1e-4);
    let little = |cell: &str| format!("{:.16e}", cell.parse::<f64>().unwrap() * (1.0 + 1e-15) + 1e-15);
    let set = |text: &'static str| move |_: &str| text.to_owned();
    assert!(matches!(verdict(CHECKS, &|text| row(text, 1, &more)), Verdict::Fails(_)));
    assert!(matches!(verdict(CHECKS, &|text| row(text, 3, &set("FAIL missing"))), Verdict::Fails(_)));
    assert!(matches!(verdict(CHECKS, &|text| row(text, 5, &set("1e-3"))), Verdict::Fails(_)));
    assert!(matches!(verdict(CHECKS, &|text| row(text, 5, &set("tiny"))), Verdict::Fails(_)));
    assert!(matches!(verdict(CHECKS, &|text| row(text, 6, &set("17"))), Verdict::Fails(_)));
    let Verdict::Holds(words) = verdict(CHECKS, &|text| row(text, 1, &little)) else { panic!("rounding") };
    assert!(words.contains("up to rounding"), "{words}");
    assert!(matches!(verdict(PAGE, &|text| text.replacen("| ordinary | 7", "| ordinary | 9", 1)), Verdict::Fails(_)));
    assert!(matches!(verdict(PAGE, &|text| text.replacen("e-16 |", "e-3 |", 1)), Verdict::Fails(_)));
    assert!(matches!(verdict(PAGE, &|text| text.replacen("less well", "as well", 1)), Verdict::Fails(_)));
}

/// A page that a user wrote is not checked; a changed page of groebot fails.
#[test]
fn a_page_of_ones_own_is_named() {
    let honest = Honest::new("planar_2r");
    let (written, checked) = honest.written();
    let ours = written.iter().find(|file| file.name == PAGE).unwrap();
    let page = String::from_utf8(ours.bytes.clone()).unwrap();
    let verdict = |text: &str| {
        let mut stored = honest.stored.clone();
        stored.files.insert(PAGE.to_owned(), text.as_bytes().to_vec());
        found(&compare(&stored, &written, "proof", &checked), PAGE).clone()
    };
    assert!(matches!(verdict("# My arm\n\nIt is blue.\n"), Verdict::NotChecked(_)));
    assert!(matches!(verdict(" \n"), Verdict::Fails(_)));
    assert!(matches!(verdict(&page.replace("Written by `groebot derive`", "Written by me")), Verdict::Fails(_)));
    assert!(honest.stored.get(CERTIFICATE).is_some());
}
