//! Floor maps and rooms.

use groebot::Result;
use groebot::nav::{Map, Meaning, Room};

use super::{Target, read, text};

pub(super) const TARGETS: [Target; 5] = [
    Target { name: "map_pgm", about: "maps from PGM, `nav::Map`", run: map_pgm, damaged: 300 },
    Target { name: "map_png", about: "maps from PNG", run: map_png, damaged: 300 },
    Target {
        name: "map_text",
        about: "maps from rows of characters, and of the Moving AI lab",
        run: map_text,
        damaged: 300,
    },
    Target { name: "map_yaml", about: "YAML of ROS' `map_server`, `nav::Meaning`", run: map_yaml, damaged: 300 },
    Target { name: "room_toml", about: "rooms with furniture, `nav::Room`", run: room_toml, damaged: 100 },
];

/// Rooms with more cells are read but not drawn.
const CELLS: f64 = 1e5;
/// The side of a cell \[m\].
const SIDE: f64 = 0.05;
/// An image with all values of a byte.
const IMAGE: &str = "P2 4 2 255 0 1 50 127 128 254 255 205";

/// A map has the number of cells given by its columns and rows, each at its index.
fn check(map: Result<Map>) {
    if let Some(map) = read(map) {
        assert_eq!(map.cells().len(), map.columns() * map.rows());
        let last = map.cells().len() - 1;
        assert!(map.centre(last).iter().all(|x| x.is_finite()));
    }
}

fn map_pgm(bytes: &[u8]) {
    check(Map::from_pgm(bytes, &Meaning::new(SIDE)));
}

fn map_png(bytes: &[u8]) {
    check(Map::from_png(bytes, &Meaning::new(SIDE)));
}

fn map_text(bytes: &[u8]) {
    check(Map::from_text(&text(bytes), SIDE));
}

/// The parameters of a YAML file can be applied to an image.
fn map_yaml(bytes: &[u8]) {
    if let Some((_, meaning)) = read(Meaning::from_yaml(&text(bytes))) {
        check(Map::from_pgm(IMAGE.as_bytes(), &meaning));
    }
}

fn room_toml(bytes: &[u8]) {
    let Some(room) = read(Room::from_toml(&text(bytes))) else { return };
    let cells = room.size.iter().map(|size| (size / room.resolution).abs().max(1.0)).product::<f64>();
    // An invalid number of cells is also refused.
    if !(CELLS..=1e12).contains(&cells) {
        check(room.map());
    }
}
