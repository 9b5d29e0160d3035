//! Detection of a file's type by its content, for files that are given instead of a description.

use std::path::Path;

use serde::de::IgnoredAny;

use crate::{Error, ErrorKind, Result};

/// Advice for meshes.
const MESH: &str = "give the robot's URDF, which names its meshes";
/// Number of bytes that are inspected to recognise a mesh in text or an archive.
const HEAD: usize = 4096;
/// The length of the header, and of a triangle, in a binary STL file.
const STL: [usize; 2] = [84, 50];
/// The first words of the lines of an OBJ mesh.
const OBJ: [&str; 10] = ["v", "vn", "vt", "vp", "f", "o", "g", "s", "mtllib", "usemtl"];
/// Magic bytes of binary files, their type, and advice.
const BINARY: [(&[u8], &str, &str); 21] = [
    (b"PK\x03\x04", "a ZIP archive", "give the URDF in it"),
    (b"PK\x05\x06", "an empty ZIP archive", "give the URDF"),
    (b"\x1f\x8b", "a gzip archive", "give the URDF in it"),
    (b"BZh", "a bzip2 archive", "give the URDF in it"),
    (b"\xfd7zXZ\0", "an xz archive", "give the URDF in it"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive", "give the URDF in it"),
    (b"\x28\xb5\x2f\xfd", "a zstd archive", "give the URDF in it"),
    (b"\x04\x22\x4d\x18", "an lz4 archive", "give the URDF in it"),
    (b"Rar!\x1a", "a RAR archive", "give the URDF in it"),
    (b"PXR-USDC", "a USD scene", "give the robot's URDF"),
    (b"#usda", "a USD scene", "give the robot's URDF"),
    (b"Kaydara FBX Binary", "an FBX scene", "give the robot's URDF"),
    (b"ISO-10303-21", "a STEP model", "give the robot's URDF"),
    (b"ply\n", "a PLY mesh", MESH),
    (b"ply\r\n", "a PLY mesh", MESH),
    (b"glTF", "a glTF scene", "give the robot's URDF"),
    (b"\x89PNG", "a PNG image", "give the robot's URDF"),
    (b"\xff\xd8\xff", "a JPEG image", "give the robot's URDF"),
    (b"%PDF", "a PDF", "give the robot's URDF"),
    (b"\x89HDF", "an HDF5 file", "give the robot's URDF"),
    (b"\x7fELF", "a program", "give the robot's URDF"),
];
/// Number of lines that are inspected to recognise a table.
const TABLE: usize = 4;

/// The ends of names of files in XML.
const XML_ENDS: [&str; 5] = ["urdf", "xml", "xacro", "sdf", "mjcf"];

/// Whether the name of a file is that of a description in XML.
pub fn has_xml_name(path: &Path) -> bool {
    path.extension().is_some_and(|end| XML_ENDS.iter().any(|xml| end.eq_ignore_ascii_case(xml)))
}

/// Whether `bytes` begin like XML, in any encoding.
pub fn is_xml(bytes: &[u8]) -> bool {
    let is_mark = |byte: &u8| matches!(byte, 0 | 0xef | 0xbb | 0xbf | 0xff | 0xfe) || byte.is_ascii_whitespace();
    bytes.iter().find(|byte| !is_mark(byte)) == Some(&b'<')
}

/// Refuses archives, images, meshes, scenes and other binary files.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the file's type, advice, and the allowed formats.
pub fn refuse_binary(bytes: &[u8]) -> Result<()> {
    match BINARY.iter().find(|(start, ..)| bytes.starts_with(start)) {
        Some((b"PK\x03\x04", ..)) if is_usdz(bytes) => Err(foreign("a USDZ scene", "give the robot's URDF")),
        Some((_, name, advice)) => Err(foreign(name, advice)),
        None if bytes.get(257..262) == Some(b"ustar") => Err(foreign("a tar archive", "give the URDF in it")),
        None => mesh_format(bytes).map_or(Ok(()), |name| Err(foreign(name, MESH))),
    }
}

/// Whether a ZIP archive begins with a file of a USD scene.
fn is_usdz(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(HEAD)];
    [b".usdc", b".usda"].iter().any(|end| head.windows(end.len()).any(|window| window == *end))
}

/// STL, COLLADA or OBJ, if `bytes` are such a mesh.
fn mesh_format(bytes: &[u8]) -> Option<&'static str> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
    let [header, triangle] = STL;
    let count =
        bytes.get(header - 4..header).and_then(|count| Some(u32::from_le_bytes(count.try_into().ok()?) as usize));
    let is_binary_stl = count
        .is_some_and(|count| count > 0 && count.checked_mul(triangle).map(|size| size + header) == Some(bytes.len()));
    let is_text_stl = head.starts_with("solid") && (head.contains("facet normal") || head.contains("endsolid"));
    let lines = || head.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let has_vertex = || lines().any(|line| line.starts_with("v ") && line.split_whitespace().count() >= 4);
    match () {
        () if is_binary_stl || is_text_stl => Some("an STL mesh"),
        () if is_xml(bytes) && head.contains("<COLLADA") => Some("a COLLADA mesh"),
        // The last line may be cut off.
        () if has_vertex()
            && lines()
                .take(TABLE)
                .all(|line| line.split_whitespace().next().is_some_and(|word| OBJ.contains(&word))) =>
        {
            Some("an OBJ mesh")
        }
        () => None,
    }
}

/// Replaces the `error` of a description's reader if `text` has another known format. The new error names this format.
pub fn explained(error: Error, text: &str) -> Error {
    let name = if error.kind() == ErrorKind::Syntax { text_format(text) } else { None };
    name.map_or(error, |name| foreign(name, "give the robot's URDF"))
}

fn foreign(name: &str, advice: &str) -> Error {
    let text = format!(
        "this is {name}; {advice}: descriptions are URDF, xacro, MJCF or SDF (XML); TOML of a robot, a chain, a DH table or a system of equations; DH tables in CSV; \
         calibrations of Universal Robots (YAML)"
    );
    Error::new(ErrorKind::Unsupported, text)
}

/// JSON, YAML, CSV or Markdown, if `text` is one of them and neither XML nor TOML with a typing error.
fn text_format(text: &str) -> Option<&'static str> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('{') || (text.starts_with('[') && serde_json::from_str::<IgnoredAny>(text).is_ok()) {
        return Some("JSON");
    }
    if has_fenced_block(text) {
        return Some("Markdown");
    }
    if text.starts_with('<') || text.lines().any(|line| line.contains(" = ") || line.starts_with("[[")) {
        return None;
    }
    let significant =
        text.lines().map(str::trim_end).filter(|line| !line.is_empty() && !line.trim_start().starts_with('#'));
    let lines: Vec<&str> = significant.take(TABLE).collect();
    let first = *lines.first()?;
    if first == "---" || first.starts_with("--- ") || first.starts_with("%YAML") || is_yaml_entry(first) {
        return Some("YAML");
    }
    let cells =
        |separator: char| lines.iter().all(|line| line.matches(separator).count() == first.matches(separator).count());
    let is_table =
        |separator: &char| lines.len() > 1 && first.contains(*separator) && !first.contains('=') && cells(*separator);
    if [',', ';', '\t'].iter().any(is_table) {
        return Some("a table (CSV)");
    }
    let is_toml = |line: &str| line.contains('=') || line.starts_with('[');
    (text.starts_with("# ") && !text.lines().any(is_toml)).then_some("Markdown")
}

/// Whether `text` has a fenced block of code, and no line of TOML outside of such blocks.
fn has_fenced_block(text: &str) -> bool {
    let (mut is_inside, mut has_block) = (false, false);
    for line in text.lines() {
        if line.starts_with("```") {
            (is_inside, has_block) = (!is_inside, true);
        } else if !is_inside && (line.contains(" = ") || (line.starts_with('[') && line.ends_with(']'))) {
            return false;
        }
    }
    has_block
}

/// Whether `line` is `key: value`, or `key:` with the value on the next lines, or `- value`.
fn is_yaml_entry(line: &str) -> bool {
    let is_key = |key: &str| !key.is_empty() && !key.contains(['=', '[', '{', '<', ',']);
    let entry = line.split_once(": ").map(|(key, _)| key).or_else(|| line.strip_suffix(':'));
    line.starts_with("- ") || entry.is_some_and(is_key)
}
