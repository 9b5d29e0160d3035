//! Outputs of commands, and files that they never replace.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use tempfile::tempdir;

use super::{content, groebot, refused, root, run, succeed, text};

fn corpus(name: &str) -> String {
    text(&root("tests/corpus").join(name)).to_owned()
}

/// The arguments by which each command reads the file `a` and writes to it.
const ONTO_INPUT: [&[&str]; 18] = [
    &["view", "a", "-o", "a"],
    &["view", "nao", "--robot", "a", "-o", "a"],
    &["export", "a", "--to", "glb", "-o", "a"],
    &["explain", "a", "-o", "a"],
    &["codegen", "a", "--lang", "rust", "-o", "a"],
    &["basis", "a", "-o", "a"],
    &["basis", "a", "--certificate=a"],
    &["walk", "a", "--plot", "a"],
    &["walk", "nao", "--footsteps", "a", "-o", "a"],
    &["navigate", "nao", "--map", "a", "--goal", "1,1", "-o", "a"],
    &["task", "nao", "--room", "a", "--goal", "x", "-o", "a"],
    &["path", "a", "--start", "0,0", "--goal", "1,1", "-o", "a"],
    &["follow", "nao", "--poses", "a", "-o", "a"],
    &["simulate", "a", "-o", "a"],
    &["identify", "nao_v5", "a", "-o", "a"],
    &["track", "nao_v5", "--law", "open-loop", "--trajectory", "a", "-o", "a"],
    &["dynamics", "nao_v5", "--states", "a", "-o", "a"],
    &["dynamics", "a", "--lang", "rust", "-o", "a"],
];

#[test]
fn no_command_replaces_an_input() {
    let folder = tempdir().unwrap();
    let (file, other) = (folder.path().join("a"), folder.path().join("same"));
    fs::write(&file, "input").unwrap();
    fs::hard_link(&file, &other).unwrap();
    for arguments in ONTO_INPUT {
        for force in [&[][..], &["--force"]] {
            // The last one is another name of the same file.
            let mut whole: Vec<String> =
                arguments.iter().map(|word| word.replace("=a", &format!("={}", text(&file)))).collect();
            whole.iter_mut().filter(|word| *word == "a").for_each(|word| *word = text(&file).to_owned());
            if whole.last().is_some_and(|last| last == text(&file)) {
                *whole.last_mut().unwrap() = text(&other).to_owned();
            }
            let whole: Vec<&str> = whole.iter().map(String::as_str).chain(force.iter().copied()).collect();
            let error = refused(&whole);
            assert!(error.contains("input of the command"), "{arguments:?}: {error}");
            assert_eq!(fs::read(&file).unwrap(), b"input");
        }
    }
}

#[test]
fn the_files_of_a_derivation_are_inputs() {
    let folder = super::leg_copy();
    let program = folder.path().join("5_program.json");
    let before = content(folder.path());
    for command in [&["codegen", "--lang", "rust"][..], &["explain"], &["reach", "--plot"], &["view"]] {
        let out: &[&str] = if command.contains(&"--plot") { &[] } else { &["-o"] };
        let whole = [&command[..1], &[text(folder.path())], &command[1..], out, &[text(&program), "--force"]].concat();
        assert!(refused(&whole).contains("input of the command"), "{command:?}");
    }
    assert_eq!(content(folder.path()), before);
}

/// Commands that write quickly, and the options with which they write something else.
fn writers() -> Vec<(Vec<String>, Vec<String>, &'static str)> {
    let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let leg = text(&root("derivations/nao_leg_sagittal")).to_owned();
    let arm = corpus("dynamics/rrp.urdf");
    let folder = root("tests/corpus");
    let system = text(&folder.join("basis_of_others.txt")).to_owned();
    vec![
        (words("export nao_v5 --to urdf"), words("export rh0 --to urdf"), "-o"),
        (words("export nao_v5 --to mjcf"), words("export rh0 --to mjcf"), "-o"),
        (words("export nao_v5 --to glb"), words("export rh0 --to glb"), "-o"),
        (words("export nao_v5 --to x3d"), words("export rh0 --to x3d"), "-o"),
        (words("export nao_v5 --to wrl"), words("export rh0 --to wrl"), "-o"),
        (words("view nao"), words("view rh0"), "-o"),
        (words(&format!("explain {leg}")), words(&format!("explain {leg} --latex")), "-o"),
        (words(&format!("codegen {leg} --lang rust")), words(&format!("codegen {leg} --lang latex")), "-o"),
        (
            words(&format!("dynamics {arm} --lang rust --functions gravity")),
            words(&format!("dynamics {arm} --lang rust")),
            "-o",
        ),
        (words(&format!("basis {system} --quiet")), words(&format!("basis {system} --quiet --order lex")), "-o"),
        (
            words(&format!("basis {system} --quiet --output-format singular")),
            words(&format!("basis {system} --quiet --output-format singular --order lex")),
            "-o",
        ),
    ]
}

#[test]
fn foreign_files_stay_and_those_of_earlier_runs_do_not() {
    let folder = tempdir().unwrap();
    let system = folder.path().join("system.txt");
    fs::write(&system, "variables: x, y\nx^2 + y^2 - 1\nx*y - 2\n").unwrap();
    for (number, (first, second, option)) in writers().into_iter().enumerate() {
        let file = folder.path().join(format!("out{number}"));
        let run_with = |arguments: &[String], more: &[&str]| {
            let replaced: Vec<String> = arguments
                .iter()
                .map(|word| if word.ends_with("basis_of_others.txt") { text(&system).to_owned() } else { word.clone() })
                .collect();
            let whole: Vec<&str> =
                replaced.iter().map(String::as_str).chain([option, text(&file)]).chain(more.iter().copied()).collect();
            run(&whole)
        };
        fs::write(&file, "mine, and not of that program").unwrap();
        let refusal = run_with(&first, &[]);
        assert!(refusal.code == 1 && refusal.err.contains("did not write it"), "{first:?}: {}", refusal.err);
        assert_eq!(fs::read(&file).unwrap(), b"mine, and not of that program");
        assert_eq!(run_with(&first, &["--force"]).code, 0, "{first:?}");
        let before = fs::read(&file).unwrap();
        let again = run_with(&second, &[]);
        assert_eq!(again.code, 0, "{second:?}: {}", again.err);
        assert_ne!(fs::read(&file).unwrap(), before, "{second:?}");
    }
}

#[test]
fn tables_are_known_by_their_first_line() {
    let folder = tempdir().unwrap();
    let (map, out) = (folder.path().join("maze.map"), folder.path().join("path.csv"));
    fs::write(&map, "....\n.##.\n....\n").unwrap();
    let path = |goal: &str| {
        run(&["path", text(&map), "--resolution", "1", "--start", "0.5,0.5", "--goal", goal, "-o", text(&out)])
    };
    fs::write(&out, "name,age\nme,3\n").unwrap();
    assert!(path("3.5,2.5").err.contains("did not write it"));
    fs::remove_file(&out).unwrap();
    assert_eq!(path("3.5,2.5").code, 0);
    let before = fs::read(&out).unwrap();
    assert_eq!(path("0.5,2.5").code, 0);
    assert_ne!(fs::read(&out).unwrap(), before);
}

#[test]
fn two_results_need_two_files() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("a.csv");
    let error = refused(&["walk", "nao", "-o", text(&out), "--plot", text(&out)]);
    assert!(error.contains("two results"), "{error}");
    assert!(!out.exists());
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_and_its_faults() {
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for arguments in [&["--help"][..], &["--version"], &["walk", "--help"], &["export", "nao_v5", "--to", "urdf"]] {
        let output = groebot(arguments).stdout(full()).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        // No message is repeated, and a full standard error does not change the status.
        assert_eq!(groebot(arguments).stderr(full()).output().unwrap().status.code(), Some(0), "{arguments:?}");
    }
    assert_eq!(groebot(&["walk", "--nonsense"]).stderr(full()).output().unwrap().status.code(), Some(2));
    let whole = succeed(&["export", "nao_v5", "--to", "urdf", "-o", "/dev/stdout"]);
    assert!(whole.starts_with("<?xml") && whole.ends_with("</robot>\n"));
    refused(&["export", "nao_v5", "--to", "urdf", "-o", "/dev/full"]);
    // The reader has closed: both runs end without a message.
    for out in [&[][..], &["-o", "/dev/stdout"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = groebot(&[&["export", "nao_v5", "--to", "urdf"], out].concat()).stdout(writer).output().unwrap();
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]), "{out:?}");
    }
}

/// Two derivations write to one new folder at the same time. Afterwards the folder has the files of one of them.
#[test]
fn two_derivations_into_one_folder_do_not_mix() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("new/out");
    let derive = |name: &str| {
        let input = root("derivations").join(name).join("0_chain.toml");
        groebot(&["derive", text(&input), "--quiet", "--out", text(&out)]).spawn().unwrap()
    };
    let both = [derive("planar_2r"), derive("nao_head")];
    for child in both {
        assert_eq!(child.wait_with_output().unwrap().status.code(), Some(0));
    }
    succeed(&["check", text(&out)]);
}

#[test]
fn an_interrupted_folder_is_refused_until_it_is_derived_again() {
    let folder = super::leg_copy();
    let all: String =
        content(folder.path()).keys().filter(|name| !name.starts_with('0')).map(|name| format!("{name}\n")).collect();
    fs::write(folder.path().join(".groebot-unfinished"), all).unwrap();
    let at = text(folder.path());
    assert_eq!(run(&["check", at]).code, 1);
    for arguments in [
        &["solve", at, "--target", "60,150"][..],
        &["codegen", at, "--lang", "c"],
        &["explain", at],
        &["view", at, "-o", "/dev/null"],
    ] {
        assert!(refused(arguments).contains("interrupted"), "{arguments:?}");
    }
    succeed(&["derive", at, "--quiet"]);
    succeed(&["check", at]);
    assert!(!folder.path().join(".groebot-unfinished").exists());
}

/// All readers check this, for all kinds of files.
#[test]
fn files_of_an_interrupted_set_are_refused_by_every_reader() {
    let folder = tempdir().unwrap();
    let at = |name: &str, bytes: &str| {
        fs::write(folder.path().join(name), bytes).unwrap();
        text(&folder.path().join(name)).to_owned()
    };
    at("part.stl", "solid\nendsolid\n");
    at("map.pgm", "P2 2 2 1 1 1 1 1\n");
    let mesh = "<link name='a'><visual><geometry><mesh filename='part.stl'/></geometry></visual></link>";
    let robot = at("robot.urdf", &format!("<robot name='r'>{mesh}</robot>"));
    let map = at(
        "map.yaml",
        "image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n",
    );
    let system = at("system.txt", "variables: x\nx^2 - 1\n");
    let poses = at("poses.csv", "0.3,0.1,0.4,0,0,0,1\n");
    let ur5 = text(&root("derivations/ur5")).to_owned();
    let arguments: [&[&str]; 4] = [
        &["export", &robot, "--meshes", "--to", "x3d"],
        &["path", &map, "--start", "0.5,0.5", "--goal", "1.5,1.5"],
        &["basis", &system],
        &["follow", &ur5, "--poses", &poses],
    ];
    let is_refused = |arguments: &[&str]| run(arguments).err.contains("interrupted, or is in progress");
    assert!(!arguments.into_iter().any(is_refused));
    at(".groebot-unfinished", "part.stl\nmap.pgm\nsystem.txt\nposes.csv\n");
    for arguments in arguments {
        assert!(refused(arguments).contains("interrupted, or is in progress"), "{arguments:?}");
    }
}

#[test]
fn code_of_others_stays_in_a_derived_folder() {
    let folder = super::leg_copy();
    let mine = folder.path().join("leg.c");
    fs::write(&mine, "int main(void) { return 0; }\n").unwrap();
    let error = refused(&["derive", text(folder.path()), "--name", "leg"]);
    assert!(error.contains("`leg.c`"), "{error}");
    assert!(fs::read_to_string(&mine).unwrap().starts_with("int main"));
    assert!(!Path::new(&mine.with_extension("h")).exists());
}
