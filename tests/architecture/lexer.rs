//! Rust source as words and punctuation, without comments, strings and character literals.

/// A word (identifier, keyword, number), `::`, or one punctuation character.
#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    pub text: String,
    /// The line, counted from 1.
    pub line: usize,
}

/// The tokens of `source`, in order.
pub fn tokens(source: &str) -> Vec<Token> {
    let mut lexer = Lexer { chars: source.chars().collect(), at: 0, line: 1, tokens: Vec::new() };
    while lexer.at < lexer.chars.len() {
        lexer.step();
    }
    lexer.tokens
}

struct Lexer {
    chars: Vec<char>,
    at: usize,
    line: usize,
    tokens: Vec<Token>,
}

impl Lexer {
    fn step(&mut self) {
        match (self.peek(0), self.peek(1)) {
            ('/', '/') => self.skip_while(|c| c != '\n'),
            ('/', '*') => self.skip_block_comment(),
            ('"', _) => self.skip_string(),
            ('\'', _) => self.skip_quote(),
            (':', ':') => self.push(2),
            (c, _) if is_word(c) => self.word(),
            (c, _) if c.is_whitespace() => self.advance(1),
            _ => self.push(1),
        }
    }

    fn peek(&self, ahead: usize) -> char {
        self.chars.get(self.at + ahead).copied().unwrap_or('\0')
    }

    fn advance(&mut self, count: usize) {
        let end = (self.at + count).min(self.chars.len());
        self.line += self.chars[self.at..end].iter().filter(|&&c| c == '\n').count();
        self.at = end;
    }

    fn push(&mut self, count: usize) {
        let text = self.chars[self.at..self.at + count].iter().collect();
        self.tokens.push(Token { text, line: self.line });
        self.advance(count);
    }

    fn skip_while(&mut self, keep: impl Fn(char) -> bool) {
        while self.at < self.chars.len() && keep(self.peek(0)) {
            self.advance(1);
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        while self.at < self.chars.len() {
            let (step, change) = match (self.peek(0), self.peek(1)) {
                ('/', '*') => (2, 1),
                ('*', '/') => (2, -1),
                _ => (1, 0),
            };
            self.advance(step);
            depth += change;
            if depth == 0 {
                return;
            }
        }
    }

    /// A string with escapes, from its opening quote.
    fn skip_string(&mut self) {
        self.advance(1);
        while self.at < self.chars.len() && self.peek(0) != '"' {
            self.advance(if self.peek(0) == '\\' { 2 } else { 1 });
        }
        self.advance(1);
    }

    /// A raw string, from the first `#` or quote after its `r`.
    fn skip_raw_string(&mut self, hashes: usize) {
        self.advance(hashes + 1);
        while self.at < self.chars.len() {
            let closes = self.peek(0) == '"' && (1..=hashes).all(|i| self.peek(i) == '#');
            self.advance(if closes { hashes + 1 } else { 1 });
            if closes {
                return;
            }
        }
    }

    /// Skips a whole character literal, or only the quote of a lifetime.
    fn skip_quote(&mut self) {
        if self.peek(1) == '\\' {
            self.advance(3);
            self.skip_while(|c| c != '\'');
            self.advance(1);
        } else {
            self.advance(if self.peek(2) == '\'' { 3 } else { 1 });
        }
    }

    fn word(&mut self) {
        let length = self.chars[self.at..].iter().take_while(|&&c| is_word(c)).count();
        let text: String = self.chars[self.at..self.at + length].iter().collect();
        let hashes = self.chars[self.at + length..].iter().take_while(|&&c| c == '#').count();
        let is_prefix = ["r", "br", "cr"].contains(&text.as_str());
        if is_prefix && self.peek(length + hashes) == '"' {
            self.advance(length);
            self.skip_raw_string(hashes);
        } else if is_prefix && hashes == 1 && is_word(self.peek(length + 1)) {
            self.advance(length + 1); // a raw identifier: its word is the next token
        } else if ["b", "c"].contains(&text.as_str()) && matches!(self.peek(length), '"' | '\'') {
            self.advance(length);
        } else {
            self.push(length);
        }
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
