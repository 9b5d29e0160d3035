//! Descriptions in other forms that are converted to TOML when they are read. Main function: [`as_toml`].

pub mod dh_csv;
pub mod ur_calibration;

use crate::Result;

/// The description in `text` as TOML: a Denavit-Hartenberg table in [CSV](dh_csv), or the calibration of an [arm of Universal Robots](ur_calibration). Other text
/// is unchanged.
///
/// # Errors
/// As [`dh_csv::to_toml`] and [`ur_calibration::to_toml`], with the line.
pub fn as_toml(text: String) -> Result<String> {
    // Spreadsheets write a byte-order mark.
    let plain = text.trim_start_matches('\u{feff}');
    if dh_csv::is_dh_csv(plain) {
        return dh_csv::to_toml(plain);
    }
    if ur_calibration::is_ur_calibration(plain) {
        return ur_calibration::to_toml(plain);
    }
    Ok(text)
}
