//! Untrusted names and texts on a terminal, in messages and on pages.

use std::fs;

use tempfile::tempdir;

use super::{refused, root, run, succeed, text};

/// Terminal control characters, unescaped.
const ACTS: [char; 4] = ['\u{1b}', '\u{7}', '\u{202e}', '\u{9b}'];

fn is_quiet(text: &str) -> bool {
    !text.contains(ACTS)
}

#[test]
fn names_that_act_on_a_terminal_are_refused_by_every_reader() {
    let folder = tempdir().unwrap();
    let at = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let long = "y".repeat(201);
    for name in ["a\u{1b}]0;x\u{7}b", "a\u{202e}b", "a\u{2066}b", "a\u{9b}31mb", "", " ", long.as_str()] {
        let json = name.replace('\u{1b}', "\\u001b").replace('\u{7}', "\\u0007");
        let chain = fs::read_to_string(root("derivations/planar_2r/0_chain.toml")).unwrap();
        let joint =
            chain.lines().find(|line| line.trim_start().starts_with("name") && !line.contains("planar_2r")).unwrap();
        let toml = chain.replacen(joint, &format!("name = \"{json}\""), 1);
        let program = fs::read_to_string(root("derivations/nao_leg_sagittal/5_program.json")).unwrap();
        let program = program.replacen("\"name\": \"HipPitch\"", &format!("\"name\": \"{json}\""), 1);
        let robot = format!(
            "<robot name='r'><link name='a'/><link name='{}'/></robot>",
            name.replace('\u{1b}', "").replace('\u{7}', "\u{85}")
        );
        let room = format!("size = [4, 4]\n[[furniture]]\nname = \"{json}\"\nbox = [1, 1]\nat = [2, 2]\n");
        let walk = format!(
            "{{\"format\":1,\"robot\":\"r\",\"joints\":[{{\"name\":\"{json}\",\"slides\":false}}],\"time\":[0.0],\"q\":[[0.0]]}}"
        );
        let read = [
            vec!["info".to_owned(), text(&at("c.toml", &toml)).to_owned()],
            vec!["solve".to_owned(), text(&at("p.json", &program)).to_owned(), "--target=60,150".to_owned()],
            vec!["info".to_owned(), text(&at("r.urdf", &robot)).to_owned()],
            vec![
                "path".to_owned(),
                text(&at("room.toml", &room)).to_owned(),
                "--start=1,1".to_owned(),
                "--goal=3,3".to_owned(),
            ],
            vec!["export".to_owned(), text(&at("w.json", &walk)).to_owned(), "--to=x3d".to_owned()],
        ];
        for arguments in read {
            let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
            let ran = run(&arguments);
            assert_eq!(ran.code, 1, "{arguments:?} {name:?}: {}", ran.out);
            assert!(ran.err.contains("name"), "{arguments:?}: {}", ran.err);
            assert!(is_quiet(&ran.err) && is_quiet(&ran.out) && ran.err.len() < 500, "{arguments:?}: {:?}", ran.err);
        }
    }
}

#[test]
fn options_and_files_are_shown_without_acting_and_shortened() {
    let long = "A\u{1b}[31m\u{202e}".repeat(2000);
    let piece = format!("{long}=1,1@x");
    let file = "no-such-\u{1b}[31mfile".to_owned();
    for arguments in [
        &["basis", "-", "--order", &long][..],
        &["task", "nao", "--room", "living-room", "--goal", &long],
        &["task", "nao", "--room", "living-room", "--goal", "sofa", "--then", &piece],
        &["derive", &file],
        &["view", &file, "-o", "x.html"],
        &["derive", "x.toml", "--name", &long],
        &["codegen", text(&root("derivations/nao_leg_sagittal")), "--lang", "c", "--prefix", &long],
        &["codegen", text(&root("derivations/nao_leg_sagittal")), "--lang", "ikfast", "--namespace", &long],
    ] {
        let ran = run(arguments);
        assert!([1, 2].contains(&ran.code), "{}", ran.out);
        assert!(is_quiet(&ran.err), "{:?}", ran.err);
        assert!(ran.err.len() < 1500, "{} bytes: {}", ran.err.len(), &ran.err[..300]);
    }
}

/// A robot's name with HTML, a link and a shell command.
#[test]
fn a_page_has_no_html_no_link_and_no_command() {
    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("in.urdf"), folder.path().join("out"));
    let arm = fs::read_to_string(root("tests/corpus/urdf/three_joint_leg.urdf")).unwrap();
    let start = arm.find("<robot").unwrap();
    let end = start + arm[start..].find('>').unwrap();
    let named = "<robot name=\"&lt;img src=x onerror=alert(1)&gt;$(touch pwned)[a](javascript:b)&amp;lt;\"";
    fs::write(&file, format!("{}{named}{}", &arm[..start], &arm[end..])).unwrap();
    succeed(&["derive", text(&file), "--tip", "foot", "--task", "position", "--quiet", "--out", text(&out)]);
    let page = fs::read_to_string(out.join("README.md")).unwrap();
    // The character before an escape is a letter.
    let bare =
        |text: &str| ["\\<", "\\$", "\\]", "\\&"].iter().fold(text.to_owned(), |text, escape| text.replace(escape, ""));
    for word in ["<img", "$(", "](j", "&lt"] {
        assert!(!bare(&page).contains(word), "{word}: {page}");
    }
    let command = page.lines().find(|line| line.contains("groebot solve derivations/")).unwrap();
    let allowed = |c: char| c.is_ascii_alphanumeric() || " /_-.,".contains(c);
    assert!(command.chars().all(allowed), "{command}");
    let explained = succeed(&["explain", text(&out)]);
    assert!(!bare(&explained).contains("<img") && !bare(&explained).contains("](j"), "{explained}");
}

#[test]
fn no_solver_has_the_name_of_the_run_time() {
    let folder = tempdir().unwrap();
    let leg = root("derivations/nao_leg_sagittal");
    for name in ["groebot", "groebot_six_axes", "groebot_redundant", "groebot_dynamics", "Groebot"] {
        let out = folder.path().join("out");
        assert_eq!(run(&["derive", text(&leg), "--name", name, "--out", text(&out)]).code, 2, "{name}");
        let source = folder.path().join(format!("{name}.c"));
        assert!(refused(&["codegen", text(&leg), "--lang", "c", "-o", text(&source)]).contains("run time"));
        assert!(!source.exists() && !out.exists());
    }
}
