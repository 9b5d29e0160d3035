//! Mesh files: their search paths and their points.

use std::fs;

use groebot_robot::ErrorKind;
use groebot_robot::model::{Meshes, Solid};
use nalgebra::Point3;

const TETRAHEDRON: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn ascii() -> String {
    let facet = |face: &[usize; 3]| {
        let vertices: String =
            face.iter().map(|corner| TETRAHEDRON[*corner]).map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!("solid t\n{}endsolid t\n", FACES.iter().map(facet).collect::<String>())
}

pub fn binary() -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(4u32.to_le_bytes());
    for face in FACES {
        bytes.extend([0u8; 12]);
        for corner in face {
            TETRAHEDRON[corner].iter().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
        }
        bytes.extend([0, 0]);
    }
    bytes
}

fn mesh(path: &str) -> Solid {
    Solid::Mesh { path: path.to_owned(), scale: [0.5, 1.0, 2.0] }
}

#[test]
fn corners_of_triangles_are_read_and_scaled() {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("share/rich");
    fs::create_dir_all(package.join("meshes")).unwrap();
    fs::create_dir_all(package.join("urdf")).unwrap();
    fs::write(package.join("meshes/a.stl"), ascii()).unwrap();
    fs::write(package.join("urdf/B.STL"), binary()).unwrap();
    let meshes = Meshes::beside(&package.join("urdf/robot.urdf"));
    let whole = format!("file://{}", package.join("meshes/a.stl").display());
    for path in ["package://rich/meshes/a.stl", "../meshes/a.stl", "B.STL", &whole] {
        let points = meshes.points(&mesh(path)).unwrap();
        let has = |[x, y, z]: &[f64; 3]| points.iter().any(|p| (p - Point3::new(x * 0.5, *y, z * 2.0)).norm() < 1e-12);
        assert!(points.len() == 4 && TETRAHEDRON.iter().all(has), "{path}: {points:?}");
    }
    let refused = [
        ("package://poor/a.stl", ErrorKind::Io, "is not found"),
        ("a.dae", ErrorKind::Unsupported, "only meshes in STL"),
        ("broken.stl", ErrorKind::Syntax, "not an STL file"),
    ];
    for (path, _, _) in &refused[1..] {
        fs::write(package.join("urdf").join(path), "solid").unwrap();
    }
    for (path, kind, words) in refused {
        let error = meshes.points(&mesh(path)).unwrap_err();
        assert!(error.kind() == kind && error.message().contains(words), "{error}");
    }
    assert!(Meshes::default().points(&mesh("a.stl")).is_err());
}

/// The error for a file with these bytes; `None` when all four corners are read.
fn fault(bytes: impl AsRef<[u8]>) -> Option<groebot_robot::Error> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.stl");
    fs::write(&file, bytes).unwrap();
    match Meshes::beside(&folder.path().join("robot.urdf")).triangles(&mesh("part.stl")) {
        Ok(surface) => {
            assert_eq!((surface.points.len() % 4, surface.triangles.len() % 4), (0, 0));
            None
        }
        Err(error) => {
            assert_eq!(error.place().file.as_deref(), Some(file.as_path()), "{error}");
            Some(error)
        }
    }
}

#[test]
fn all_kinds_of_stl_are_read() {
    let mut head_of_text = binary();
    head_of_text[..9].copy_from_slice(b"solid t\n\n");
    let latin1 =
        [b"solid n\xe4m\xe9\r\n".to_vec(), ascii().replacen("solid t\n", "", 1).replace('\n', "\r\n").into_bytes()]
            .concat();
    let whole: [Vec<u8>; 7] = [
        ascii().into(),
        binary(),
        head_of_text,
        ascii().to_uppercase().into(),
        ascii().replace("solid t", "solid").into(),
        latin1,
        format!("\n  {}", ascii()).into(),
    ];
    for bytes in whole {
        let error = fault(&bytes);
        assert!(error.is_none(), "{}: {error:?}", String::from_utf8_lossy(&bytes));
    }
    // All solids of a text are read.
    let folder = tempfile::tempdir().unwrap();
    let moved = ascii().replace("vertex 1", "vertex 5");
    fs::write(folder.path().join("two.stl"), ascii() + "\n" + &moved).unwrap();
    let surface = Meshes::beside(&folder.path().join("robot.urdf")).triangles(&mesh("two.stl")).unwrap();
    assert_eq!((surface.points.len(), surface.triangles.len()), (5, 8));
}

#[test]
fn damage_is_named_with_its_place() {
    let line = |number: usize, old: &str, new: &str| {
        let lines: Vec<String> = ascii().lines().map(str::to_owned).collect();
        let changed = lines[number - 1].replace(old, new);
        assert_ne!(changed, lines[number - 1]);
        [&lines[..number - 1], &[changed], &lines[number..]].concat().join("\n")
    };
    for (text, number) in [
        (line(5, "vertex", "vertx"), 5),
        (line(6, " 0", " nan"), 6),
        (line(9, " 0", " zero"), 9),
        (line(7, "endloop", ""), 8),
        (line(30, "endsolid t", ""), 29),
        (ascii().lines().take(12).collect::<Vec<_>>().join("\n"), 12),
        (ascii() + "\nfacet", 32),
    ] {
        let error = fault(&text).unwrap();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::Syntax, Some(number)), "{error}: {text}");
    }
    let changed = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = binary();
        change(&mut bytes);
        fault(bytes).unwrap()
    };
    let short = changed(&|bytes| bytes.truncate(84 + 2 * 50 + 7));
    assert!(
        short.message().contains("the number 4 of triangles") && short.message().contains("in triangle 3"),
        "{short}"
    );
    let long = changed(&|bytes| bytes.extend([0; 50]));
    assert!(long.message().contains("after the last triangle"), "{long}");
    let infinite = changed(&|bytes| bytes[84 + 50 + 12..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes()));
    assert!(infinite.message().contains("triangle 2 is not finite"), "{infinite}");
    assert!(fault("").unwrap().message().contains("this file has 0"));
    assert!(fault("solid\nendsolid\n").unwrap().message().contains("no triangle"));
    // Every truncation is detected.
    assert!((0..binary().len()).all(|length| fault(&binary()[..length]).is_some()));
}

/// The points of a solid are on its surface, and as far out along each axis as the solid.
#[test]
fn points_of_solids_reach_their_ends() {
    let cases = [
        (Solid::Box { size: [1.0, 2.0, 3.0] }, [0.5, 1.0, 1.5]),
        (Solid::Cylinder { radius: 0.3, length: 1.0 }, [0.3, 0.3, 0.5]),
        (Solid::Capsule { radius: 0.3, length: 1.0 }, [0.3, 0.3, 0.8]),
        (Solid::Sphere { radius: 0.3 }, [0.3, 0.3, 0.3]),
    ];
    for (solid, ends) in cases {
        let points = solid.points();
        for axis in 0..3 {
            let most = points.iter().map(|point| point[axis]).fold(f64::NEG_INFINITY, f64::max);
            let least = points.iter().map(|point| point[axis]).fold(f64::INFINITY, f64::min);
            assert!(
                (most - ends[axis]).abs() < 1e-12 && (least + ends[axis]).abs() < 1e-12,
                "{solid}: {least}..{most}"
            );
        }
    }
}
