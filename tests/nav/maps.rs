//! Maps as they are read, and what stands on them.

use groebot::ErrorKind;
use groebot::nav::{Cell, Map, Meaning, Shape};
use nalgebra::Point2;

use super::random_map;

const ROOM: &str = "#####\n#.?.#\n#...#\n#####\n";

#[test]
fn characters_and_pixels_are_the_same_room() {
    let text = Map::from_text(ROOM, 0.5).unwrap();
    assert_eq!((text.columns(), text.rows(), text.resolution()), (5, 4, 0.5));
    // The first row is the uppermost one.
    assert_eq!(text.cells()[2 * 5 + 2], Cell::Unknown);
    let meaning = Meaning::new(0.5);
    let value = |cell: char| match cell {
        '#' => 0u8,
        '.' => 254,
        _ => 205,
    };
    let pixels: Vec<u8> = ROOM.lines().flat_map(str::chars).map(value).collect();
    let mut image = b"P5 # made by hand\n5 4\n255\n".to_vec();
    image.extend(&pixels);
    assert_eq!(Map::from_pgm(&image, &meaning).unwrap(), text);
    let words: Vec<String> = pixels.iter().map(ToString::to_string).collect();
    let plain = format!("P2\n5\n# a remark\n4 255 {}", words.join("\n"));
    assert_eq!(Map::from_pgm(plain.as_bytes(), &meaning).unwrap(), text);
    let moving = format!("type octile\nheight 4\nwidth 5\nmap\n{}", ROOM.replace('#', "@"));
    assert_eq!(Map::from_text(&moving, 0.5).unwrap(), text);
}

#[test]
fn a_description_tells_where_its_image_stands() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("room.yaml");
    std::fs::write(folder.path().join("room.pgm"), b"P5 2 1 255\n\xff\x00").unwrap();
    let told = "image: room.pgm # beside it\nresolution: 0.05\norigin: [-1.0, 2.0, 0.5]\nnegate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    std::fs::write(&yaml, told).unwrap();
    let map = Map::read(&yaml, 1.0).unwrap();
    assert_eq!((map.cells(), map.resolution()), (&[Cell::Occupied, Cell::Free][..], 0.05));
    let middle = map.centre(1);
    let (sine, cosine) = 0.5f64.sin_cos();
    let expected = Point2::new(-1.0 + 0.075 * cosine - 0.025 * sine, 2.0 + 0.075 * sine + 0.025 * cosine);
    assert!((middle - expected).norm() < 1e-15);
    assert_eq!(map.cell_at(&middle).unwrap(), 1);
    for (from, to, kind, words) in [
        ("resolution: 0.05", "", ErrorKind::MissingKey, "`resolution`"),
        ("0.05", "wide", ErrorKind::BadValue, "give a positive number of metres"),
        ("0.05", "-1", ErrorKind::BadValue, "line 2: `resolution` is `-1`; give a positive number"),
        ("0.65", "65", ErrorKind::BadValue, "a share from 0 to 1"),
        ("room.pgm", "room.yaml", ErrorKind::Unsupported, "an image of a map is a .pgm or .png"),
        ("[-1.0, 2.0, 0.5]", "[1, 2]", ErrorKind::BadValue, "[x, y, yaw]"),
        ("negate: 1", "negate: 2", ErrorKind::BadValue, "0 or 1"),
        ("negate: 1", "mode: raw", ErrorKind::BadValue, "trinary"),
        ("room.pgm", "hall.pgm", ErrorKind::Io, "hall.pgm"),
    ] {
        std::fs::write(&yaml, told.replacen(from, to, 1)).unwrap();
        let error = Map::read(&yaml, 1.0).unwrap_err();
        assert!(error.kind() == kind && error.to_string().contains(words), "{error}");
    }
}

#[test]
fn what_is_no_map_is_refused() {
    let image = |bytes: &[u8]| Map::from_pgm(bytes, &Meaning::new(0.1)).unwrap_err();
    for (bytes, words) in [
        (&b"P6 1 1 255\n000"[..], "`P6`"),
        (b"", "``"),
        (b"P5 2", "the height"),
        (b"P5 2 x 255\n", "the height is `x`"),
        (b"P5 2 2 70000\n", "up to 65535"),
        (b"P5 2 2 255\n\x00", "1 bytes of pixels; 2 x 2 take 4"),
        (b"P2 1 2 9 3 12", "pixel 1: the value is `12`; give a number up to 9"),
        (b"P5 1 1 9\n\x0a", "pixel 0: the value is 10; give a number up to 9"),
        (b"P5 0 0 255\n", "0 x 0 cells"),
        (b"P5 200000000 200000000 255\n", "bytes of pixels"),
    ] {
        let error = image(bytes);
        assert!(error.message().contains(words), "{error}");
    }
    let error = Map::from_text("..\n.x\n", 0.1).unwrap_err();
    assert!(error.place().line == Some(2) && error.message().contains("`x` is no cell"), "{error}");
    let error = Map::from_text("..\n...\n", 0.1).unwrap_err();
    assert!(error.place().line == Some(2) && error.message().contains("3 cells"), "{error}");
    let error = Map::from_text("type octile\nheight 9\nwidth 2\nmap\n..\n..\n", 0.1).unwrap_err();
    assert!(error.place().line == Some(2) && error.message().contains("make it 2"), "{error}");
    assert!(Map::from_text("", 0.1).is_err() && Map::new(3, 3, f64::NAN).is_err());
}

#[test]
fn clearances_are_those_of_brute_force() {
    for (columns, rows, share, seed) in
        [(23, 17, 0.05, 1), (9, 31, 0.3, 2), (1, 12, 0.2, 3), (40, 1, 0.1, 4), (6, 6, 0.0, 5)]
    {
        let map = random_map(columns, rows, share, seed);
        let clearances = map.clearances();
        let occupied: Vec<usize> = (0..columns * rows).filter(|cell| !map.is_free(*cell)).collect();
        for (cell, found) in clearances.iter().enumerate() {
            let beyond = |a: usize, b: usize| (a.abs_diff(b) as f64 - 0.5).max(0.0) * 0.05;
            let away =
                |other: &usize| beyond(cell % columns, other % columns).hypot(beyond(cell / columns, other / columns));
            let expected = occupied.iter().map(away).fold(f64::INFINITY, f64::min);
            assert!(*found == expected || (found - expected).abs() < 1e-12, "{cell}: {found} {expected}");
        }
        let grown = map.grown(0.12).unwrap();
        // What is off the map is an obstacle, too.
        let inside = |place: usize, count: usize| place.min(count - 1 - place) as f64 + 0.5 >= 0.12 / 0.05;
        let is_far = |cell: usize| inside(cell % columns, columns) && inside(cell / columns, rows);
        let expected = |cell: usize| clearances[cell] >= 0.12 && is_far(cell);
        assert!((0..columns * rows).all(|cell| grown.is_free(cell) == expected(cell)));
    }
    assert!(random_map(3, 3, 0.1, 1).grown(f64::NAN).is_err());
}

#[test]
fn furniture_covers_the_cells_that_it_touches() {
    let map = Map::new(20, 20, 0.1).unwrap().placed(Point2::new(-1.0, -1.0), 0.0).unwrap();
    let shapes = [
        Shape::rectangle(Point2::new(0.03, 0.02), 0.5, 0.2, 0.4),
        Shape::Circle { centre: Point2::new(-0.6, 0.5), radius: 0.17 },
        Shape::Polygon([(0.5, 0.5), (0.9, 0.5), (0.9, 0.9), (0.7, 0.6)].map(|(x, y)| Point2::new(x, y)).to_vec()),
    ];
    let covered = map.with(&shapes).unwrap();
    for cell in 0..400 {
        // Points all over the cell.
        let corner = map.centre(cell) - nalgebra::Vector2::repeat(0.05);
        let grid = (1..40).flat_map(|i| (1..40).map(move |j| (f64::from(i), f64::from(j))));
        let mut inside = grid.map(|(i, j)| Point2::new(corner.x + 0.0025 * i, corner.y + 0.0025 * j));
        let holds = inside.any(|point| shapes.iter().any(|shape| shape.holds(&point)));
        // A touch may be smaller than the points are apart.
        assert!(!holds || !covered.is_free(cell), "{cell}");
    }
    let free = (0..400).filter(|cell| covered.is_free(*cell)).count();
    let area: f64 = 0.1 + std::f64::consts::PI * 0.17 * 0.17 + 0.05;
    assert!((400 - free) as f64 * 0.01 < 2.5 * area);
    // It was put there on another map.
    assert!((0..400).all(|cell| map.is_free(cell)));
    let error = covered.free_cell_at(&Point2::new(0.03, 0.02)).unwrap_err();
    assert!(error.message().contains("occupied; the nearest free place is ("), "{error}");
    assert!(covered.cell_at(&Point2::new(1.5, 0.0)).unwrap_err().message().contains("not on the map"));
    for bad in [Shape::Polygon(vec![Point2::origin(); 2]), Shape::Circle { centre: Point2::origin(), radius: -1.0 }] {
        assert!(map.with(std::slice::from_ref(&bad)).is_err() && map.clone().with_speed(&bad, 1.0).is_err());
    }
    for speed in [0.0, -1.0, 1e-46, 1e39, f64::NAN, f64::INFINITY] {
        let error = map.clone().with_speed(&shapes[0], speed).unwrap_err();
        assert!(error.message().contains("give a positive number"), "{error}");
    }
}
