//! Pseudorandomly damaged inputs, reproducible. Main type: [`Damage`].

/// A linear congruential generator (Knuth's MMIX constants).
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % bound.max(1)
    }
}

/// Pieces that are inserted into inputs: numbers beyond limits, hidden and special characters, brackets.
const PIECES: [&str; 24] = [
    "1e160",
    "1e400",
    "-1",
    "0",
    "NaN",
    "inf",
    "99999999999999999999",
    "1e-320",
    "0.1029",
    "\u{0}",
    "\u{1b}[2J",
    "\u{202e}",
    "\r",
    "\n",
    "\"",
    "<!--",
    "*/",
    "`",
    "{",
    "]]",
    ",,",
    "é",
    "\u{feff}",
    "$(x)",
];
/// Characters that end a number or a name.
const SIGNS: [u8; 12] = *b" \t\n,;=<>\"'[]";

/// An infinite sequence of damaged inputs. A seed is cut off, or loses, repeats or exchanges bytes and lines, or gets another number, character or piece of
/// another seed.
pub struct Damage<'a> {
    seeds: &'a [Vec<u8>],
    chance: Chance,
    next: usize,
}

impl<'a> Damage<'a> {
    /// Builds the sequence from at least one seed.
    pub fn of(seeds: &'a [Vec<u8>]) -> Self {
        assert!(!seeds.is_empty());
        Damage { seeds, chance: Chance(2026), next: 0 }
    }

    /// One change.
    fn change(&mut self, bytes: &mut Vec<u8>) {
        let at = self.chance.below(bytes.len() + 1);
        let end = (at + 1 + self.chance.below(24)).min(bytes.len());
        match self.chance.below(10) {
            0 => bytes.truncate(at),
            1 if at < bytes.len() => bytes[at] ^= 1 << self.chance.below(8),
            2 if at < bytes.len() => bytes[at] = self.chance.below(256) as u8,
            3 => drop(bytes.drain(at..end.max(at))),
            4 => bytes.extend_from_within(at..end.max(at)),
            5 => self.put_word(bytes, at),
            7 | 8 => self.put_digit(bytes, at),
            6 => {
                let other = &self.seeds[self.chance.below(self.seeds.len())];
                let from = self.chance.below(other.len());
                bytes.splice(at..end.max(at), other[from..(from + 40).min(other.len())].iter().copied());
            }
            _ => drop(bytes.splice(at..at, PIECES[self.chance.below(PIECES.len())].bytes())),
        }
    }

    /// Changes the first digit after a position.
    fn put_digit(&mut self, bytes: &mut [u8], at: usize) {
        if let Some(digit) = bytes[at..].iter_mut().find(|byte| byte.is_ascii_digit()) {
            *digit = b'0' + self.chance.below(10) as u8;
        }
    }

    /// Replaces the word or number at a position by a piece.
    fn put_word(&mut self, bytes: &mut Vec<u8>, at: usize) {
        let is_sign = |byte: &u8| SIGNS.contains(byte);
        let begin = bytes[..at].iter().rposition(is_sign).map_or(0, |place| place + 1);
        let end = bytes[at..].iter().position(is_sign).map_or(bytes.len(), |place| at + place);
        bytes.splice(begin..end, PIECES[self.chance.below(PIECES.len())].bytes());
    }
}

impl Iterator for Damage<'_> {
    type Item = Vec<u8>;

    fn next(&mut self) -> Option<Vec<u8>> {
        let mut bytes = self.seeds[self.next % self.seeds.len()].clone();
        self.next += 1;
        // One change leaves more inputs readable than several.
        for _ in 0..=self.chance.below(6) / 4 {
            self.change(&mut bytes);
        }
        Some(bytes)
    }
}
