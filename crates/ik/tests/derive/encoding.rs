//! URDF in encodings other than UTF-8, and files that are not URDF.

use std::fs;

use groebot_ik::derive::{Description, InputFile};
use groebot_robot::ErrorKind;
use groebot_robot::document::{as_utf8, decode_xml};
use groebot_robot::model::Robot;
use tempfile::tempdir;

/// A URDF as Unicode text, with a comment and a link's name.
fn urdf(declared: &str, comment: &str, link: &str) -> String {
    format!(
        "<?xml version=\"1.0\"{declared}?>\n<!-- {comment} -->\n<robot name=\"r\">\n<link name=\"{link}\"/><link name=\"tip\"/>\n\
         <joint name=\"j\" type=\"continuous\"><parent link=\"{link}\"/><child link=\"tip\"/></joint>\n</robot>\n"
    )
}

/// Characters up to U+00FF, one byte each: ISO 8859-1 by its definition.
fn latin(text: &str) -> Vec<u8> {
    text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect()
}

fn wide(text: &str, mark: bool, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let mark = mark.then_some(0xfeff);
    mark.into_iter().chain(text.encode_utf16()).flat_map(bytes).collect()
}

/// The robot in a file of these bytes, read by both readers, and its stored text.
fn read(bytes: &[u8]) -> groebot_robot::Result<(Robot, String)> {
    let folder = tempdir().unwrap();
    let file = folder.path().join("0_robot.urdf");
    fs::write(&file, bytes).unwrap();
    let robot = Robot::read(&file);
    let input = InputFile::read(&file);
    match (robot, input) {
        (Ok(robot), Ok(input)) => {
            assert_eq!(input.description, Description::Robot(robot.clone()));
            Ok((robot, input.text))
        }
        (Err(error), Err(other)) => {
            assert_eq!(error, other);
            Err(error)
        }
        (robot, input) => panic!("{robot:?} {input:?}"),
    }
}

#[test]
fn declared_encodings_are_read() {
    let declared = |name: &str, link: &str| urdf(&format!(" encoding='{name}'"), "Jörg", link);
    // 0x80 is the euro sign in windows-1252 (its code chart); あ is 0x82 0xa0 in Shift_JIS (JIS X 0208, row 4).
    let euro: Vec<u8> = latin(&declared("windows-1252", "\u{80}"));
    let kana = urdf(" encoding='Shift_JIS'", "-", "@").into_bytes();
    let kana: Vec<u8> =
        kana.iter().flat_map(|byte| if *byte == b'@' { vec![0x82, 0xa0] } else { vec![*byte] }).collect();
    for (bytes, link) in [
        (latin(&declared("ISO-8859-1", "Fuß")), "Fuß"),
        (latin(&declared("iso-8859-1", "Fuß")), "Fuß"),
        (euro, "€"),
        (kana, "あ"),
        (declared("UTF-8", "足").into_bytes(), "足"),
        (declared("UTF-16", "足").into_bytes(), "足"),
        (wide(&declared("UTF-16", "足"), true, u16::to_le_bytes), "足"),
        (wide(&declared("UTF-16", "足"), true, u16::to_be_bytes), "足"),
        (wide(&urdf("", "-", "足"), true, u16::to_be_bytes), "足"),
        (format!("\u{feff}{}", urdf("", "-", "足")).into_bytes(), "足"),
    ] {
        let (robot, text) = read(&bytes).unwrap();
        assert_eq!((robot.root(), robot.parts().notes.len()), (link, 0));
        // The stored text is UTF-8 and declares it. Read again, it gives the same robot.
        assert_eq!(read(text.as_bytes()).unwrap().0, robot);
    }
}

#[test]
fn bytes_in_comments_do_no_harm() {
    let (robot, text) = read(&latin(&urdf("", "geändert von Jörg", "base"))).unwrap();
    assert_eq!(robot.parts().notes, ["line 2: bytes of a comment are not UTF-8; they are ignored"]);
    assert_eq!(robot.notes(&robot.path(None, None).unwrap()), robot.parts().notes);
    assert!(text.contains("ge\u{fffd}ndert"));
    for (bytes, line) in [
        (latin(&urdf("", "Jörg", "Fuß")), 4),
        (latin(&urdf("", "-", "Fuß")), 4),
        (latin(&urdf("", "-->ö<!--", "base")), 2),
        (latin("<robot name='r'><link name='a'/><![CDATA[<!-- ö -->]]></robot>"), 1),
    ] {
        let error = read(&bytes).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::Syntax, Some(line)), "{error}");
        assert!(error.message().contains("not UTF-8; save the file as UTF-8, or declare its encoding"), "{error}");
    }
}

#[test]
fn what_cannot_be_read_says_how_it_could() {
    let plain = urdf("", "-", "base");
    let four = |unit: u16| -> Vec<u8> { u32::from(unit).to_le_bytes().to_vec() };
    let mut broken = wide(&plain, true, u16::to_le_bytes);
    broken.extend([0x00, 0xd8, 0x00, 0x00]);
    for (bytes, words) in [
        (
            wide(&plain, false, u16::to_be_bytes),
            "UTF-16 (big-endian) without a byte-order mark; save the file as UTF-8, or as UTF-16 with",
        ),
        (wide(&plain, false, u16::to_le_bytes), "UTF-16 (little-endian) without a byte-order mark"),
        (plain.encode_utf16().flat_map(four).collect(), "the text is UTF-32; save the file as UTF-8"),
        (broken, "the text is not UTF-16LE"),
        (
            urdf(" encoding=\"EBCDIC\"", "-", "base").into_bytes(),
            "the declared encoding `EBCDIC` is unknown; allowed are UTF-8, ISO-8859-1",
        ),
        (b" \n".to_vec(), "the file is empty"),
    ] {
        let error = read(&bytes).unwrap_err();
        assert!(error.kind() == ErrorKind::Syntax && error.message().contains(words), "{error}");
        assert!(error.place().file.is_some(), "{error}");
    }
}

#[test]
fn other_files_are_named() {
    let stl = [vec![0; 80], 1_u32.to_le_bytes().to_vec(), vec![0; 50]].concat();
    let scene: &[u8] = b"#usda 1.0\ndef Xform \"robot\" {}\n";
    for (bytes, words) in [
        (
            &b"PK\x03\x04\x14\0\0\0"[..],
            "this is a ZIP archive; give the URDF in it: descriptions are URDF, xacro, MJCF or SDF (XML); TOML",
        ),
        (b"\x1f\x8b\x08\0\0", "this is a gzip archive"),
        (b"PXR-USDC\0\0", "this is a USD scene"),
        (scene, "this is a USD scene"),
        (b"\x28\xb5\x2f\xfd\0", "this is a zstd archive"),
        (b"PK\x03\x04\x14\0\0\0\0robot.usdc", "this is a USDZ scene"),
        (b"solid arm\nfacet normal 0 0 1\n", "this is an STL mesh; give the robot's URDF, which names its meshes"),
        (&stl, "this is an STL mesh"),
        (b"ply\nformat ascii 1.0\n", "this is a PLY mesh"),
        (b"# arm\no arm\nv 0 0 1\nv 0 1 0\nv 1 0 0\nf 1 2 3\n", "this is an OBJ mesh"),
        (b"<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"/>", "this is a COLLADA mesh"),
        (b"{\"name\": \"arm\"}", "this is JSON; give the robot's URDF"),
        (b"[{\"name\": \"arm\"}]", "this is JSON"),
        (b"---\nname: arm\n", "this is YAML"),
        (b"\xef\xbb\xbf# an arm\nname: arm\njoints:\n  - a\n", "this is YAML"),
        (b"# Arm\n\nAn arm with two joints.\n", "this is Markdown"),
        (b"# Arm\n\n- one joint\n\n```toml\n[tip]\nname = \"a\"\n```\n", "this is Markdown"),
        (b"t,q0,q1\n0,1,2\n", "this is a table (CSV)"),
        (b"# groebot trajectory 1\n# robot: r\ntime [s],q:a [rad]\n0,1\n", "this is a table (CSV)"),
    ] {
        // The type is detected from the content, independent of the name.
        for name in ["arm.urdf", "arm.toml", "arm.yaml", "arm"] {
            let folder = tempdir().unwrap();
            let file = folder.path().join(name);
            fs::write(&file, bytes).unwrap();
            let error = InputFile::read(&file).unwrap_err();
            assert!(error.kind() == ErrorKind::Unsupported && error.message().contains(words), "{name}: {error}");
            assert_eq!(error.place().file.as_deref(), Some(&*file));
        }
    }
}

#[test]
fn a_slip_in_a_description_stays_a_slip() {
    let folder = tempdir().unwrap();
    for (text, words) in [
        ("name = 'arm'\nlink = [1, 2\n", "this is not TOML"),
        ("name = 'arm' 1, 2\nx = 1, 2\n", "this is not TOML"),
        ("[[link]]\nname 'a'\n", "this is not TOML"),
        ("name: 'arm'\nx = 1\n", "this is not TOML"),
        ("<!-- a, b -->\n<robot name='a, b'>", "this is not XML"),
        ("<robot name='a'><link name='b'></robot>", "this is not XML"),
    ] {
        let file = folder.path().join("arm.toml");
        fs::write(&file, text).unwrap();
        let error = InputFile::read(&file).unwrap_err();
        assert!(error.kind() == ErrorKind::Syntax && error.message().contains(words), "{error}");
    }
}

#[test]
fn text_that_is_decoded_already_is_utf8() {
    assert_eq!(
        as_utf8("<?xml version='1.0' encoding='ISO-8859-1'?><a/>"),
        "<?xml version='1.0' encoding='UTF-8'?><a/>"
    );
    for same in [
        "<?xml version='1.0' encoding='utf-8'?><a/>",
        "<a encoding='b'/>",
        "<?xml version='1.0'?><a encoding='b'/>",
        "",
    ] {
        assert_eq!(as_utf8(same), same);
    }
}

proptest::proptest! {
    #![proptest_config(crate::cases(128))]

    #[test]
    fn any_bytes_are_decoded_or_refused(
        start in proptest::sample::select(vec![&b""[..], b"\xff\xfe", b"\xfe\xff", b"<?xml encoding='latin1'?>", b"<?xml encoding=\"gbk", b"<!--"]),
        bytes in proptest::collection::vec(proptest::prelude::any::<u8>(), 0..60),
    ) {
        let bytes = [start, &bytes].concat();
        if let Ok(decoded) = decode_xml(&bytes) {
            let _ = Robot::from_urdf(&decoded.text);
        }
    }
}
