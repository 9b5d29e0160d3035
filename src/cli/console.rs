//! Standard output with colours. It does not panic when its reader has closed.

use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::Path;

use super::progress::begin_output;
use super::{Halt, Outcome};
use crate::Error;
use groebot_algebra::escape;

/// Whether text is coloured.
#[derive(Clone, Copy)]
pub struct Paint(bool);

impl Paint {
    /// Colours text on a terminal, unless `NO_COLOR` is set to something or the terminal is a dumb one.
    pub fn of(stream: &impl IsTerminal) -> Self {
        let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        let dumb = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
        Paint(stream.is_terminal() && !set("NO_COLOR") && !dumb)
    }

    /// Bold.
    pub fn bold(self, text: &str) -> String {
        self.with("1", text)
    }

    /// Faint.
    pub fn dim(self, text: &str) -> String {
        self.with("2", text)
    }

    /// Green.
    pub fn green(self, text: &str) -> String {
        self.with("32", text)
    }

    /// Red.
    pub fn red(self, text: &str) -> String {
        self.with("31", text)
    }

    fn with(self, code: &str, text: &str) -> String {
        if self.0 { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    /// The text without control characters, except those of [`Paint`].
    fn safe(self, text: &str) -> String {
        let mut pieces = text.split('\x1b');
        let first = escape::page(pieces.next().unwrap_or_default()).into_owned();
        pieces.fold(first, |whole, piece| {
            let own = CODES.iter().find(|code| self.0 && piece.starts_with(**code)).copied().unwrap_or_default();
            let sign = if own.is_empty() { "\\u001b" } else { "\x1b" };
            whole + sign + own + &escape::page(&piece[own.len()..])
        })
    }
}

/// The codes that [`Paint`] writes after an escape character.
const CODES: [&str; 5] = ["[0m", "[1m", "[2m", "[31m", "[32m"];

/// Writes `text` to standard output.
pub fn print(text: &str) -> Outcome {
    begin_output()?;
    let mut out = io::stdout().lock();
    let text = Paint::of(&out).safe(text);
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| unwritten(&error))
}

/// Writes notes about ignored input to standard error.
pub fn print_notes(notes: &[String]) {
    notes.iter().for_each(|note| line("note", note));
}

/// Writes a line to standard error, which may be closed.
pub fn line(kind: &str, text: &str) {
    let _ = writeln!(io::stderr(), "{kind}: {}", escape::message(text));
}

/// The outcome for a failed write to standard output.
pub fn unwritten(error: &io::Error) -> Halt {
    match error.kind() {
        ErrorKind::BrokenPipe => Halt::PipeClosed,
        _ => Halt::Error(Error::io(Path::new("<stdout>"), error)),
    }
}
