//! Maps of the floor: the first byte chooses PGM, PNG, rows of characters, a room or what `map_server` tells of an image.
#![no_main]

use groebot::nav::{Map, Meaning, Room};
use libfuzzer_sys::fuzz_target;

/// Rooms of more cells are read but not drawn.
const CELLS: f64 = 1e6;

fuzz_target!(|bytes: &[u8]| {
    let Some((first, bytes)) = bytes.split_first() else { return };
    let map = match first % 5 {
        0 => Map::from_pgm(bytes, &Meaning::new(0.05)),
        1 => Map::from_png(bytes, &Meaning::new(0.05)),
        4 => {
            let _ = Meaning::from_yaml(&String::from_utf8_lossy(bytes));
            return;
        }
        2 => Map::from_text(&String::from_utf8_lossy(bytes), 0.05),
        _ => match Room::from_toml(&String::from_utf8_lossy(bytes)) {
            Ok(room) if room.size.iter().map(|size| (size / room.resolution).max(1.0)).product::<f64>() < CELLS => {
                room.map()
            }
            _ => return,
        },
    };
    if let Ok(map) = map {
        assert_eq!(map.cells().len(), map.columns() * map.rows());
    }
});
