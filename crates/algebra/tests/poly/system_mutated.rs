//! Damaged systems, always the same ones. For any bytes the readers return a result or an error, and a result is
//! printed and read back.

use std::panic::{AssertUnwindSafe, catch_unwind};

use groebot_algebra::poly::system::{Format, PolynomialSystem, parse_order};
use groebot_algebra::poly::{parse_equation, parse_latex};

use super::system::FORMATS;

const SEEDS: [&str; 6] = [
    "variables: x, y\nparameters: a, b\ncharacteristic: 32003\norder: grevlex(1), lex(1)\n\nx^2 + a*y/(b + 1) = 0.5e-1\n(x - y)^3 # end\n",
    "L1*c2 + L2*s4 - pz = 0\nc2^2 + s2^2 - 1\r\n-(1/3)*s4\n",
    "// ring\nring r = (0,a),(x,y,z(1..3)),(dp(2),lp(2),C);\npoly f = 3x2y3 - 1/3xy;\nideal i = f, z(1)^2*a - z(3), /* c */ -x;\n",
    "ring r=32003,(x,y),lp;ideal i=x2+y2-1,(x-y)^2,1/2*x;",
    "x, y, z\n2147483647\nx^2*y - 1/2*z,\n-x + y,\nz^3 - 7\n",
    "x1,x2\n0\nx1*x2+1,\nx1-x2\n",
];

/// A linear congruential generator (Knuth's MMIX constants).
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % bound.max(1)
    }

    /// One to three changes: a byte, a piece removed or doubled, a word of the formats, a piece of another seed.
    fn damage(&mut self, seed: &str) -> Vec<u8> {
        const WORDS: [&str; 16] = [
            "(",
            ")",
            ":",
            ",",
            ";",
            "\n",
            "^999",
            "1..9",
            "..",
            "/*",
            "*/",
            "order:",
            "dp",
            "\u{0}",
            "é",
            "99999999999999999999",
        ];
        let mut bytes = seed.as_bytes().to_vec();
        for _ in 0..=self.below(3) {
            let at = self.below(bytes.len() + 1);
            let end = (at + self.below(12)).min(bytes.len());
            match self.below(5) {
                0 if at < bytes.len() => bytes[at] = self.below(256) as u8,
                1 => drop(bytes.drain(at..end)),
                2 => bytes.extend_from_within(at..end),
                3 => drop(bytes.splice(at..at, WORDS[self.below(WORDS.len())].bytes())),
                _ => {
                    let other = SEEDS[self.below(SEEDS.len())].as_bytes();
                    let from = self.below(other.len());
                    bytes.splice(at..end, other[from..(from + 20).min(other.len())].iter().copied());
                }
            }
        }
        bytes
    }
}

/// Reads `bytes` in every format. Systems that are small enough to expand at once are printed and read back.
fn digest(bytes: &[u8]) -> usize {
    let mut read = 0;
    for format in [None, Some(Format::Plain), Some(Format::Singular), Some(Format::Msolve)] {
        match PolynomialSystem::read_bytes(bytes, format) {
            Ok(system) => {
                read += 1;
                if system.polynomials.iter().all(|given| given.expression.expansion_bound().terms < 1000.0) {
                    print_and_read(&system);
                }
            }
            Err(error) => assert!(error.place().line.is_some() && error.message().contains("column "), "{error}"),
        }
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = (parse_order(text), parse_equation(text), parse_latex(text));
    }
    read
}

fn print_and_read(system: &PolynomialSystem) {
    for format in FORMATS {
        let Ok(text) = system.print(format) else { continue };
        // A power may print longer than the input, and msolve's format loses the order.
        match PolynomialSystem::read(&text, Some(format)) {
            Ok(again) if again.heading == system.heading => assert_eq!(again.print(format).unwrap(), text),
            _ => {}
        }
    }
}

#[test]
fn damaged_systems_are_answered_or_refused() {
    let mut chance = Chance(2026);
    let mut read = 0;
    for round in 0..6000 {
        let bytes = chance.damage(SEEDS[round % SEEDS.len()]);
        let outcome = catch_unwind(AssertUnwindSafe(|| digest(&bytes)));
        read += outcome.unwrap_or_else(|_| panic!("{:?}", String::from_utf8_lossy(&bytes)));
    }
    assert!(read > 500, "only {read} damaged texts still make a system: the damage is too great to test much");
}
