//! A text page of headings and lines ([`Page`]).

use super::algebra::wrap;
use super::console::Paint;

/// The column at which lines are broken.
const WIDTH: usize = 100;

/// Headings and the lines under them.
pub struct Page {
    pub text: String,
    pub paint: Paint,
}

impl Page {
    /// Adds a heading after an empty line.
    pub fn heading(&mut self, title: &str) {
        self.text += &format!("\n{}\n", self.paint.bold(title));
    }

    /// Adds a line, wrapped.
    pub fn line(&mut self, text: &str) {
        self.text += &format!("  {}\n", wrap(text, WIDTH, 2));
    }

    /// Adds pairs of a name and a text, the texts aligned and wrapped.
    pub fn entries(&mut self, entries: &[(String, String)]) {
        let width = entries.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).min(WIDTH / 3);
        for (name, text) in entries {
            let padding = " ".repeat(width.saturating_sub(name.chars().count()));
            let text = wrap(text, WIDTH, width + 4);
            self.text += &format!("  {}{padding}  {text}\n", self.paint.dim(name));
        }
    }
}
