//! Numbers as text that loses no bit: base64 (RFC 4648, section 4) of little-endian doubles.

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Doubles in base64.
pub fn doubles(numbers: impl IntoIterator<Item = f64>) -> String {
    base64(&numbers.into_iter().flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
}

/// Singles in base64.
pub fn singles(numbers: impl IntoIterator<Item = f32>) -> String {
    base64(&numbers.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

/// Whole numbers in base64.
pub fn wholes(numbers: impl IntoIterator<Item = u32>) -> String {
    base64(&numbers.into_iter().flat_map(u32::to_le_bytes).collect::<Vec<u8>>())
}

fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let word = three.iter().fold(0, |word, byte| word << 8 | u32::from(*byte)) << (8 * (3 - three.len()));
        for place in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * place)) as usize & 63];
            text.push(if place > three.len() { '=' } else { char::from(digit) });
        }
    }
    text
}
