//! Rooms with furniture, images, and obstacles grown by an outline.

use groebot_humanoid::ErrorKind;
use groebot_humanoid::nav::{Cell, Map, Meaning, Mode, Room, Shape};
use nalgebra::{Point2, Vector2};

use super::random_map;

const ROOM: &str = r#"
size = [6.0, 5.0]
resolution = 0.1
origin = [-1, -2, 0]
wall = 0.1
[[furniture]]
name = "sofa"
box = [1.8, 0.8]
at = [2.0, 0.5, 90]
[[furniture]]
name = "lamp"
circle = 0.25
at = [0.5, 1.5]
[[slow]]
name = "carpet"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
at = [3, 1]
speed = 0.5
"#;

#[test]
fn a_room_is_walls_and_furniture() {
    let room = Room::from_toml(ROOM).unwrap();
    let map = room.map().unwrap();
    assert_eq!((map.columns(), map.rows()), (60, 50));
    let is_free = |x: f64, y: f64| map.is_free(map.cell_at(&Point2::new(x, y)).unwrap());
    // The sofa is parallel to y, and the walls are inside of the borders.
    assert!(!is_free(2.35, 0.5) && !is_free(2.0, 1.35) && is_free(2.45, 0.5) && is_free(2.0, 1.45));
    assert!(!is_free(-0.95, 0.0) && !is_free(4.95, 0.0) && is_free(-0.85, 0.0) && !is_free(0.5, 1.7));
    let speed = |x: f64, y: f64| map.speeds().unwrap()[map.cell_at(&Point2::new(x, y)).unwrap()];
    assert_eq!((speed(3.5, 1.5), speed(2.95, 1.5)), (0.5, 1.0));
    // 58 x 48 cells within the walls, minus 18 x 8 cells of the sofa and those of the lamp.
    let free = map.cells().iter().filter(|cell| **cell == Cell::Free).count();
    let lamp = 58 * 48 - 18 * 8 - free;
    assert!((20..=36).contains(&lamp), "{lamp}");
    let moved = room.clone().with_moved("sofa", Point2::new(3.0, 2.0), 0.0).unwrap().map().unwrap();
    assert!(moved.is_free(moved.cell_at(&Point2::new(2.35, 0.0)).unwrap()));
    assert!(!moved.is_free(moved.cell_at(&Point2::new(3.85, 2.35)).unwrap()));
    let bare = room.clone().without("sofa").unwrap().without("lamp").unwrap().map().unwrap();
    assert_eq!(bare.cells().iter().filter(|cell| **cell == Cell::Free).count(), 58 * 48);
    let error = room.without("sofas").unwrap_err();
    assert!(error.kind() == ErrorKind::UnknownName && error.message().contains("did you mean `sofa`"), "{error}");
}

#[test]
fn what_is_no_room_is_refused() {
    for (from, to, line, words) in [
        ("size = [6.0, 5.0]", "", Some(1), "`size`"),
        ("[6.0, 5.0]", "[6.0, -5.0]", None, "positive"),
        ("wall = 0.1", "wall = -1", None, "walls of -1 m"),
        ("resolution = 0.1", "resolution = 0", None, "a resolution of 0.0 m"),
        ("wall", "walls", Some(5), "`walls`"),
        ("\"lamp\"", "\"sofa\"", Some(10), "`sofa` is given twice"),
        ("circle = 0.25", "", Some(10), "one outline"),
        ("circle = 0.25", "circle = -0.25", Some(10), "radius"),
        ("circle = 0.25", "polygon = [[0, 0], [1, 1]]", Some(10), "at least three"),
        ("at = [0.5, 1.5]", "at = [0.5]", Some(13), "a yaw in degrees"),
        ("speed = 0.5", "speed = 0", None, "give a positive number"),
    ] {
        let text = ROOM.replacen(from, to, 1);
        let error = Room::from_toml(&text).and_then(|room| room.map()).unwrap_err();
        assert!(error.message().contains(words), "{from} {to}: {error}");
        assert_eq!(error.place().line, line, "{from} {to}: {error}");
    }
}

/// A PNG with eight bits per channel, written by hand: stored blocks, with the checksums of its chunks.
fn png(columns: u32, colour: u8, rows: &[&[u8]]) -> Vec<u8> {
    fn crc(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0u32, |sum, byte| {
            (0..8).fold(sum ^ u32::from(*byte), |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 })
        })
    }
    let raw: Vec<u8> = rows.iter().flat_map(|row| [&[0u8][..], row].concat()).collect();
    let (a, b) = raw.iter().fold((1u32, 0u32), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65_521;
        (a, (a + b) % 65_521)
    });
    let length = raw.len() as u16;
    let zlib =
        [&[0x78, 0x01, 1][..], &length.to_le_bytes(), &(!length).to_le_bytes(), &raw, &(b << 16 | a).to_be_bytes()];
    let head = [&columns.to_be_bytes()[..], &(rows.len() as u32).to_be_bytes(), &[8, colour, 0, 0, 0]].concat();
    let mut file = vec![0x89, b'P', b'N', b'G', 13, 10, 26, 10];
    for (name, data) in [(b"IHDR", head), (b"IDAT", zlib.concat()), (b"IEND", Vec::new())] {
        let own = [&name[..], &data].concat();
        file.extend((data.len() as u32).to_be_bytes());
        file.extend(&own);
        file.extend(crc(&own).to_be_bytes());
    }
    file
}

#[test]
fn images_of_other_colours_are_the_same_map() {
    let meaning = Meaning::new(0.1);
    let cells = [Cell::Free, Cell::Occupied, Cell::Unknown, Cell::Free, Cell::Free, Cell::Occupied];
    let grey = png(3, 0, &[&[254, 254, 0], &[254, 0, 205]]);
    let lower_first: Vec<Cell> = [&cells[0..3], &cells[3..6]].concat();
    assert_eq!(Map::from_png(&grey, &meaning).unwrap().cells(), lower_first);
    let threefold = |row: &[u8]| row.iter().flat_map(|value| [*value; 3]).collect::<Vec<u8>>();
    let colours = png(3, 2, &[&threefold(&[254, 254, 0]), &threefold(&[254, 0, 205])]);
    assert_eq!(Map::from_png(&colours, &meaning).unwrap().cells(), lower_first);
    // Transparent pixels are unknown, whatever their colour, in the mode `scale` and without a mode.
    let through = png(3, 4, &[&[254, 255, 254, 255, 0, 255], &[254, 255, 0, 255, 0, 0]]);
    let scale = Meaning { mode: Mode::Scale, ..meaning.clone() };
    assert_eq!(Map::from_png(&through, &scale).unwrap().cells(), lower_first);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("room.png");
    std::fs::write(&file, &through).unwrap();
    assert_eq!(Map::read(&file, 0.1).unwrap().cells(), lower_first);
    std::fs::write(&file, &grey).unwrap();
    // In the mode `trinary` alpha is a fourth colour: opaque 205 is (3 * 205 + 255) / (4 * 255) white, 0.147 black; opaque black is 0.75 black.
    let opaque = png(4, 4, &[&[205, 255, 0, 255, 0, 0, 255, 0]]);
    let trinary = [Cell::Free, Cell::Occupied, Cell::Occupied, Cell::Unknown];
    assert_eq!(Map::from_png(&opaque, &meaning).unwrap().cells(), trinary);
    let [red, green] = [&[205, 205, 205, 255, 0, 0, 0, 255][..], &[0, 0, 0, 0, 255, 255, 255, 0]];
    assert_eq!(Map::from_png(&png(4, 6, &[&[red, green].concat()]), &meaning).unwrap().cells(), trinary);
    std::fs::write(folder.path().join("room.yaml"), "image: room.png\nresolution: 0.1\norigin: [0, 0, 0]\n").unwrap();
    assert_eq!(Map::read(&folder.path().join("room.yaml"), 1.0).unwrap().cells(), lower_first);
    for bad in [&grey[..40], b"\x89PNG", b""] {
        let error = Map::from_png(bad, &meaning).unwrap_err();
        assert!(error.kind() == ErrorKind::Syntax && error.message().contains("no PNG"), "{error}");
    }
    let mut huge = grey;
    huge[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    assert!(Map::from_png(&huge, &meaning).is_err());
}

/// The feasible positions of an outline, by testing each of them.
#[test]
fn obstacles_grown_by_an_outline_are_those_that_it_touches() {
    let corners = [(0.1, -0.05), (0.12, 0.06), (-0.07, 0.08), (0.0, 0.0), (-0.09, -0.06)];
    let outline = Shape::Polygon(corners.map(|(x, y)| Point2::new(x, y)).to_vec());
    for (yaw, turned) in [(0.0, 0.0), (0.7, 0.0), (0.7, 0.4), (2.9, -1.0)] {
        let map = random_map(29, 23, 0.08, 7).placed(Point2::new(0.3, -0.2), turned).unwrap();
        let grown = map.grown_by(&outline, yaw).unwrap();
        let mut free = 0;
        for cell in 0..map.cells().len() {
            let (sine, cosine) = f64::sin_cos(yaw);
            let at = |(x, y): (f64, f64)| map.centre(cell) + Vector2::new(cosine * x - sine * y, sine * x + cosine * y);
            let there = Shape::Polygon(corners.map(at).to_vec());
            assert_eq!(grown.is_free(cell), map.obstacle_under(&there).is_none(), "{cell} {yaw} {turned}");
            free += usize::from(grown.is_free(cell));
        }
        assert!(free > 20, "{free}");
    }
    assert!(random_map(3, 3, 0.1, 1).grown_by(&Shape::Polygon(Vec::new()), 0.0).is_err());
}
