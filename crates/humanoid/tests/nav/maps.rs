//! Readers of maps, and obstacles on maps.

use groebot_humanoid::ErrorKind;
use groebot_humanoid::nav::{Cell, Map, Meaning, Mode, Shape};
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
fn a_description_names_its_image_file() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("room.yaml");
    std::fs::write(folder.path().join("room.pgm"), b"P5 2 1 255\n\xff\x00").unwrap();
    let description = "image: room.pgm # beside it\nresolution: 0.05\norigin: [-1.0, 2.0, 0.5]\nnegate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    std::fs::write(&yaml, description).unwrap();
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
        ("0.65", "65", ErrorKind::BadValue, "a fraction from 0 to 1"),
        ("room.pgm", "room.yaml", ErrorKind::Unsupported, "an image of a map is a .pgm or .png"),
        ("[-1.0, 2.0, 0.5]", "[1, 2]", ErrorKind::BadValue, "[x, y, yaw]"),
        ("negate: 1", "negate: 2", ErrorKind::BadValue, "0 or 1"),
        ("negate: 1", "mode: tri", ErrorKind::BadValue, "line 4: `mode` is `tri`; give one of trinary, scale, raw"),
        ("room.pgm", "hall.pgm", ErrorKind::Io, "hall.pgm"),
    ] {
        std::fs::write(&yaml, description.replacen(from, to, 1)).unwrap();
        let error = Map::read(&yaml, 1.0).unwrap_err();
        assert!(error.kind() == kind && error.to_string().contains(words), "{error}");
    }
}

const YAML: &str = "image: a.pgm\nresolution: 0.05\norigin: [-1.5, 2.0, 0.25]\nnegate: 1\noccupied_thresh: 0.7\nfree_thresh: 0.2\nmode: scale\n";

/// YAML as written by PyYAML's `safe_dump`, by `map_saver` and by hand: all texts have equal meaning.
#[test]
fn yaml_is_read_as_any_program_writes_it() {
    let expected = (
        "a.pgm".to_owned(),
        Meaning {
            resolution: 0.05,
            origin: [-1.5, 2.0, 0.25],
            negate: true,
            thresholds: [0.7, 0.2],
            mode: Mode::Scale,
        },
    );
    let flow = "[-1.5, 2.0, 0.25]";
    for text in [
        YAML.to_owned(),
        format!("\u{feff}{YAML}"),
        YAML.replace('\n', "\r\n"),
        YAML.replace('\n', "\r"),
        format!("%YAML 1.2\n---\n# a map\n{YAML}...\n"),
        YAML.replace(flow, "\n- -1.5\n- 2.0\n- 0.25"),
        YAML.replace(flow, "\n  - -1.5\n  - 2.0 # metres\n  - 0.25\n"),
        YAML.replace(flow, "[-1.5,\n         2.0, # y\n\n    0.25]"),
        YAML.replace(flow, "&here [-15e-1, +2, .25]\nsame: *here"),
        YAML.replace("0.05", "!!float \"0.050000\"").replace("negate: 1", "'negate': True"),
        format!("{{{}}}", YAML.trim_end().replace('\n', ", ")),
        format!("{YAML}nested: {{a: [1, {{b: c}}]}}\nblock: |\n  mode: raw\n  negate: 0\n"),
    ] {
        assert_eq!(Meaning::from_yaml(&text), Ok(expected.clone()), "{text}");
    }
    let rest = "image: 'my map: #1.pgm' # no remark in it\nresolution: 1\n";
    assert_eq!(Meaning::from_yaml(rest), Ok(("my map: #1.pgm".to_owned(), Meaning::new(1.0))));
}

#[test]
fn yaml_that_is_none_has_a_line() {
    for (from, to, kind, line, words) in [
        ("image: a.pgm", "image: [a.pgm", ErrorKind::Syntax, None, "this is no YAML"),
        ("negate: 1", "negate: \"1", ErrorKind::Syntax, None, "this is no YAML"),
        ("negate: 1", "mode: raw", ErrorKind::DuplicateName, Some(7), "the key `mode` is given twice"),
        ("negate: 1", "negate: [1]", ErrorKind::BadValue, Some(4), "`negate` is `[1]`; give 0 or 1"),
        ("mode: scale", "mode: Scale", ErrorKind::BadValue, Some(7), "give one of trinary, scale, raw"),
        ("mode: scale", "mode:", ErrorKind::BadValue, Some(7), "give one of trinary, scale, raw"),
        ("image: a.pgm", "image: {a: b}", ErrorKind::BadValue, Some(1), "give the name of a file"),
        ("-1.5, 2.0, 0.25", "-1.5, 2.0, .inf", ErrorKind::BadValue, Some(3), "[x, y, yaw]"),
        ("-1.5, 2.0, 0.25", "[-1.5], 2.0, 0.25", ErrorKind::BadValue, Some(3), "[x, y, yaw]"),
        ("0.7", ".nan", ErrorKind::BadValue, Some(5), "a fraction from 0 to 1"),
    ] {
        let error = Meaning::from_yaml(&YAML.replacen(from, to, 1)).unwrap_err();
        assert!(error.kind() == kind && error.message().contains(words), "{to}: {error}");
        assert!(
            line.is_none_or(|line| error.place().line == Some(line)) && error.place().line.is_some(),
            "{to}: {error}"
        );
    }
    for text in ["- image: a.pgm\n", "a map\n", "[1, 2]"] {
        let error = Meaning::from_yaml(text).unwrap_err();
        assert!(error.kind() == ErrorKind::Syntax && error.message().contains("this is not a mapping"), "{error}");
    }
    assert_eq!(Meaning::from_yaml("# nothing\n").unwrap_err().kind(), ErrorKind::MissingKey);
}

/// Texts of a hundred thousand bytes, the largest permitted description, with expansion, nesting or long look-ahead.
#[test]
fn no_yaml_takes_long() {
    let most = 100_000;
    let growing: String =
        (1..9).map(|n| format!("a{n}: &a{n} [{}]\n", vec![format!("*a{}", n - 1); 9].join(", "))).collect();
    let list = format!("x: &x [{}]\n", "1, ".repeat(most / 6));
    let again: String = (0..most / 20).map(|n| format!("k{n}: *x\n")).collect();
    let keys: String = (0..most / 9).map(|n| format!("k{n}: 1\n")).collect();
    for text in [
        format!("a0: &a0 [lol]\n{growing}"),
        list + &again,
        keys,
        "[".repeat(most),
        "{a: ".repeat(most / 4),
        format!("a: {}", "[".repeat(most)),
        "- ".repeat(most / 2),
        "? ".repeat(most / 2),
        format!("a: {}", "&a ".repeat(most / 3)),
        format!("a: \"{}", "\\n".repeat(most / 2)),
        "a".repeat(most),
        "#".repeat(most),
        "\n".repeat(most),
        "a: b: c: ".repeat(most / 9),
        "%".repeat(most),
        "!".repeat(most),
        "a: |\n".to_owned() + &" \n".repeat(most / 2),
        format!("a: [{}", "a, ".repeat(most / 3)),
        format!("a: {}", "'' ".repeat(most / 3)),
    ] {
        let start = std::time::Instant::now();
        assert!(Meaning::from_yaml(&text).is_err());
        assert!(start.elapsed().as_secs_f64() < 5.0, "{}: {:?}", &text[..text.len().min(20)], start.elapsed());
    }
}

/// The state for each value of a byte by the formulas in the documentation of `map_server` (`nav2_map_server`, `map_io.cpp`).
#[test]
fn modes_are_those_of_map_server() {
    let image: Vec<u8> = b"P5 256 1 255\n".iter().copied().chain(0..=255).collect();
    let cells = |meaning: &Meaning| Map::from_pgm(&image, meaning).unwrap().cells().to_vec();
    for negate in [false, true] {
        for mode in Mode::ALL {
            let meaning = Meaning { mode, negate, thresholds: [0.65, 0.25], ..Meaning::new(0.1) };
            for (value, cell) in cells(&meaning).into_iter().enumerate() {
                let shade = value as f64 / 255.0;
                let percent = match mode {
                    Mode::Raw if value > 100 => None,
                    Mode::Raw => Some(value as f64 / 100.0),
                    _ => Some(if negate { shade } else { 1.0 - shade }),
                };
                let expected = match percent {
                    Some(share) if share > 0.65 => Cell::Occupied,
                    Some(share) if share < 0.25 => Cell::Free,
                    _ => Cell::Unknown,
                };
                assert_eq!(cell, expected, "{mode:?} {negate} {value}");
            }
        }
    }
    // Output of `map_saver` in the mode raw: 0 is free, 100 occupied, 255 unknown.
    let saved = Map::from_pgm(b"P2 3 1 255 0 100 255", &Meaning { mode: Mode::Raw, ..Meaning::new(0.1) }).unwrap();
    assert_eq!(saved.cells(), [Cell::Free, Cell::Occupied, Cell::Unknown]);
    let bits = Map::from_pgm(b"P2 3 1 65535 0 25700 65535", &Meaning { mode: Mode::Raw, ..Meaning::new(0.1) }).unwrap();
    assert_eq!(bits.cells(), saved.cells(), "two bytes a pixel are scaled to one");
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
    assert!(error.place().line == Some(2) && error.message().contains("`x` is not a cell"), "{error}");
    let error = Map::from_text("..\n...\n", 0.1).unwrap_err();
    assert!(error.place().line == Some(2) && error.message().contains("3 cells"), "{error}");
    let error = Map::from_text("type octile\nheight 9\nwidth 2\nmap\n..\n..\n", 0.1).unwrap_err();
    assert!(error.place().line == Some(2) && error.message().contains("the rows give 2"), "{error}");
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
        // The outside of the map counts as an obstacle too.
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
        // Sample points all over the cell.
        let corner = map.centre(cell) - nalgebra::Vector2::repeat(0.05);
        let grid = (1..40).flat_map(|i| (1..40).map(move |j| (f64::from(i), f64::from(j))));
        let mut inside = grid.map(|(i, j)| Point2::new(corner.x + 0.0025 * i, corner.y + 0.0025 * j));
        let holds = inside.any(|point| shapes.iter().any(|shape| shape.holds(&point)));
        // The area of contact may be smaller than the distance of the sample points.
        assert!(!holds || !covered.is_free(cell), "{cell}");
    }
    let free = (0..400).filter(|cell| covered.is_free(*cell)).count();
    let area: f64 = 0.1 + std::f64::consts::PI * 0.17 * 0.17 + 0.05;
    assert!((400 - free) as f64 * 0.01 < 2.5 * area);
    // The original map is unchanged.
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
