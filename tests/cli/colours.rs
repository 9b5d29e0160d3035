//! Colours appear on a terminal, and neither in a pipe nor with `NO_COLOR`. `script` of util-linux provides the terminal.

use std::process::{Command, Output, Stdio};

use super::{groebot, leg_copy, text};

/// The codes of colours and of bold and faint text, in clap's messages too.
fn coloured(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let is_code = |piece: &str| piece.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';').starts_with('m');
    text.split("\x1b[").skip(1).any(is_code)
}

/// Standard output and standard error of a command on a terminal. `None` without `script`, with a message (an error with
/// `GROEBOT_REQUIRE_TOOLS=1`).
fn on_terminal(arguments: &[&str], no_color: bool) -> Option<Output> {
    let line = [&[env!("CARGO_BIN_EXE_groebot")], arguments].concat().join(" ");
    let mut script = Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).stdin(Stdio::null()).env("TERM", "xterm").env_remove("NO_COLOR");
    if no_color {
        script.env("NO_COLOR", "1");
    }
    match script.output() {
        Ok(output) => Some(output),
        Err(error) => {
            let required = std::env::var("GROEBOT_REQUIRE_TOOLS").is_ok_and(|value| value == "1");
            assert!(!required, "script: {error}");
            println!("skipped: there is no `script`: {error}");
            None
        }
    }
}

#[test]
fn colours_are_for_terminals_without_no_color() {
    let copy = leg_copy();
    let folder = text(copy.path());
    let commands: [&[&str]; 6] = [
        &["info", "puma"],
        &["info", "nao"],
        &["check", folder],
        &["derive", folder],
        &["info", "nothing.urdf"],
        &["--help"],
    ];
    for arguments in commands {
        let Some(shown) = on_terminal(arguments, false) else { return };
        assert!(coloured(&shown.stdout), "{arguments:?}: {}", String::from_utf8_lossy(&shown.stdout));
        let plain = on_terminal(arguments, true).unwrap();
        assert!(!coloured(&plain.stdout), "{arguments:?}: {}", String::from_utf8_lossy(&plain.stdout));
        let piped = groebot(arguments).stdin(Stdio::null()).output().unwrap();
        assert!(!coloured(&piped.stdout) && !coloured(&piped.stderr), "{arguments:?}");
    }
}
