//! Files of triangles that shapes name: where they are, and their points. Main type: [`Meshes`].

use std::io::Cursor;
use std::path::{Path, PathBuf};

use nalgebra::Point3;

use super::Solid;
use crate::document::shown;
use crate::limits;
use crate::{Error, ErrorKind, Result};

/// The longest file that is read, in bytes.
pub const MESH_LIMIT: u64 = limits::MESH_BYTES;

/// The triangles of a mesh, as places among its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The points \[m\].
    pub points: Vec<Point3<f64>>,
    /// The corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// The folders in which the files of meshes are looked for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Meshes {
    folders: Vec<PathBuf>,
}

impl Meshes {
    /// Beside the description at `file`, and in all folders above it: `package://name/path` is `path` in one that is called `name`, or
    /// `name/path` in any.
    pub fn beside(file: &Path) -> Self {
        let full = std::path::absolute(file).unwrap_or(file.to_owned());
        Meshes { folders: full.ancestors().skip(1).map(Path::to_owned).collect() }
    }

    /// The file that a description calls `path`; `None` where there is none.
    pub fn find(&self, path: &str) -> Option<PathBuf> {
        let plain = path.strip_prefix("file://").unwrap_or(path);
        let Some(rest) = plain.strip_prefix("package://").or(plain.strip_prefix("model://")) else {
            let beside = self.folders.first().map(|folder| folder.join(plain));
            return beside.into_iter().chain([PathBuf::from(plain)]).find(|file| file.is_file());
        };
        let (package, inner) = rest.split_once('/')?;
        let inside = |folder: &PathBuf| {
            let is_package = folder.file_name().is_some_and(|name| name == package);
            [is_package.then(|| folder.join(inner)), Some(folder.join(rest))]
        };
        self.folders.iter().flat_map(inside).flatten().find(|file| file.is_file())
    }

    /// Points whose hull is the solid, or nearly so, in its frame \[m\]: of a mesh the corners of its triangles.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for a file that is not there or cannot be read; [`ErrorKind::Unsupported`] for another format than STL;
    /// [`ErrorKind::Syntax`] for a file that is no STL; [`ErrorKind::BadValue`] beyond a hundred megabytes.
    pub fn points(&self, solid: &Solid) -> Result<Vec<Point3<f64>>> {
        if let Solid::Mesh { .. } = solid { Ok(self.triangles(solid)?.points) } else { Ok(solid.points()) }
    }

    /// The triangles of a mesh, in its frame; those of another solid, which has none, are empty.
    ///
    /// # Errors
    /// As [`Meshes::points`].
    pub fn triangles(&self, solid: &Solid) -> Result<Surface> {
        let Solid::Mesh { path, scale } = solid else {
            return Ok(Surface { points: Vec::new(), triangles: Vec::new() });
        };
        let missing = || {
            let text =
                format!("the mesh `{}` is not found; its folder must be above the description's file", shown(path));
            Error::new(ErrorKind::Io, text)
        };
        let file = self.find(path).ok_or_else(missing)?;
        read_stl(&file, *scale).map_err(|error| error.in_file(&file))
    }

    /// The triangles of a mesh; where they cannot be read the reason joins `notes`, once.
    pub fn triangles_or_note(&self, solid: &Solid, notes: &mut Vec<String>) -> Option<Surface> {
        self.triangles(solid)
            .map_err(|error| {
                let note = error.to_string();
                if !notes.contains(&note) {
                    notes.push(note);
                }
            })
            .ok()
    }
}

fn read_stl(file: &Path, [x, y, z]: [f64; 3]) -> Result<Surface> {
    if !file.extension().is_some_and(|end| end.eq_ignore_ascii_case("stl")) {
        return Err(Error::new(ErrorKind::Unsupported, "only meshes in STL are read; convert it, or give boxes"));
    }
    let length = std::fs::metadata(file).map_err(|error| Error::io(file, &error))?.len();
    if length > MESH_LIMIT {
        let text = format!("{length} bytes are too many; a mesh has at most {MESH_LIMIT}");
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    let bytes = std::fs::read(file).map_err(|error| Error::io(file, &error))?;
    let wrong = |error| Error::new(ErrorKind::Syntax, format!("this is no STL: {error}"));
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(wrong)?;
    let point = |corner: &stl_io::Vertex| {
        let [a, b, c] = [corner[0], corner[1], corner[2]].map(f64::from);
        Point3::new(a * x, b * y, c * z)
    };
    let points: Vec<Point3<f64>> = mesh.vertices.iter().map(point).collect();
    if points.iter().all(|point| point.iter().all(|x| x.is_finite())) {
        // A file of at most a hundred megabytes has fewer corners than 2^32.
        let triangles = mesh.faces.iter().map(|face| face.vertices.map(|corner| corner as u32)).collect();
        return Ok(Surface { points, triangles });
    }
    Err(Error::new(ErrorKind::BadValue, "a corner of a triangle is not finite"))
}
