//! Files of triangles: where they are looked for, and their points.

use std::fs;

use groebot::ErrorKind;
use groebot::model::{Meshes, Solid};
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

fn binary() -> Vec<u8> {
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
        ("broken.stl", ErrorKind::Syntax, "no STL"),
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

/// The points of a solid are on its surface, and as far out along each axis as it is.
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
