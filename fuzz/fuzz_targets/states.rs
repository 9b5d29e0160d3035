//! Tables of states: what is refused says where.
#![no_main]

use groebot::motion::StateTable;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    match StateTable::from_csv(text) {
        Ok(table) => assert!(table.rows.iter().all(|row| row.q.len() == table.coordinates)),
        Err(error) => assert!(error.place().line.is_some(), "{error}"),
    }
});
