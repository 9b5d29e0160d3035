//! Joins short declarations on one line.

/// The longest line of joined declarations, in characters.
const LINE: usize = 112;

/// The form in which a language declares a constant number.
pub(super) struct Declaration {
    /// The text before its name.
    pub head: &'static str,
    /// The separator between two on one line.
    pub glue: &'static str,
}

impl Declaration {
    /// The text with consecutive plain declarations joined on one line.
    pub fn joined(&self, text: &str) -> String {
        let mut lines: Vec<String> = Vec::new();
        for line in text.lines() {
            let earlier = lines.last_mut().zip(self.declared(line));
            match earlier.and_then(|(last, (indent, rest))| Some((self.declared(last)?.0 == indent, last, rest))) {
                Some((true, last, rest)) if last.len() + self.glue.len() + rest.len() <= LINE => {
                    last.pop();
                    *last += self.glue;
                    *last += rest;
                }
                _ => lines.push(line.to_owned()),
            }
        }
        lines.join("\n") + "\n"
    }

    /// The indentation of a line that declares numbers by plain expressions, and the declarations.
    fn declared<'a>(&self, line: &'a str) -> Option<(&'a str, &'a str)> {
        let start = line.trim_start();
        let rest = start.strip_prefix(self.head)?;
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let is_named = rest.split_once(" = ").is_some_and(|(name, _)| !name.is_empty() && name.chars().all(is_word));
        let is_plain = rest.ends_with(';') && !rest.contains(['{', '|', '&', '?', '<']);
        (is_named && is_plain).then(|| (&line[..line.len() - start.len()], rest))
    }
}
