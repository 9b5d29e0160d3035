//! Lossless encoding of numbers as text: little-endian, in base64 (RFC 4648, section 4).

use miniz_oxide::deflate::compress_to_vec_zlib;

use super::data::Column;

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The compression level, from 0 to 10.
const EFFORT: u8 = 9;

/// Packs 64-bit floats: the first bytes of all numbers, then the second ones and so on, which are similar from sample
/// to sample. The result is zlib (RFC 1950) in base64.
pub fn packed(numbers: impl IntoIterator<Item = f64>) -> String {
    let doubles: Vec<[u8; 8]> = numbers.into_iter().map(f64::to_le_bytes).collect();
    let planes: Vec<u8> = (0..8).flat_map(|place| doubles.iter().map(move |double| double[place])).collect();
    base64(&compress_to_vec_zlib(&planes, EFFORT))
}

/// A file, as zlib in base64.
pub fn file(bytes: &[u8]) -> String {
    base64(&compress_to_vec_zlib(bytes, EFFORT))
}

/// The numbers of all samples: one number where all are identical, else packed.
pub fn column(numbers: impl Iterator<Item = f64> + Clone) -> Column {
    let mut bits = numbers.clone().map(f64::to_bits);
    match bits.next() {
        Some(first) if bits.all(|other| other == first) => Column::Constant(f64::from_bits(first)),
        _ => Column::Varying(packed(numbers)),
    }
}

/// Same as [`column`], for each of `N` numbers of a sample.
pub fn columns<const N: usize>(rows: &[[f64; N]]) -> Vec<Column> {
    (0..N).map(|place| column(rows.iter().map(|row| row[place]))).collect()
}

/// 32-bit floats in base64.
pub fn singles(numbers: impl IntoIterator<Item = f32>) -> String {
    base64(&numbers.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

/// Integers in base64.
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
