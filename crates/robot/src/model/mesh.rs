//! Mesh files of shapes: their location and their triangles. Main type: [`Meshes`].

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use nalgebra::Point3;

use super::{ReadOptions, Solid, stl};
use crate::document::{read_bytes, shown};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;

/// Maximum size of a mesh file in bytes.
pub(crate) const MESH_LIMIT: u64 = limits::MESH_BYTES;

/// A triangle mesh with indexed points.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The points \[m\].
    pub points: Vec<Point3<f64>>,
    /// The indices of each triangle's corners.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Whether all points are in a plane, up to the fraction `within` of their extent.
    pub(super) fn is_flat(&self, within: f64) -> bool {
        let Some(a) = self.points.first() else { return true };
        let farthest = |distance: &dyn Fn(&Point3<f64>) -> f64| {
            let point = self.points.iter().max_by(|p, q| distance(p).total_cmp(&distance(q))).unwrap_or(a);
            (*point, distance(point))
        };
        let (b, size) = farthest(&|p| (p - a).norm());
        let (c, _) = farthest(&|p| (p - a).cross(&(b - a)).norm());
        let normal = (b - a).cross(&(c - a));
        let (_, off) = farthest(&|p| (p - a).dot(&normal).abs());
        let bound = within * size * normal.norm();
        off <= bound || !(off - bound).is_finite()
    }
}

/// The folders in which mesh files are searched.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Meshes {
    folders: Vec<PathBuf>,
    options: ReadOptions,
}

impl Meshes {
    /// Searches in the folder of the description `file` and in all folders above it. `package://name/path` is `path` in
    /// a folder with the name `name`, or `name/path` in any folder, or `path` in the package `name` of
    /// [`ReadOptions::from_environment`].
    pub fn beside(file: &Path) -> Self {
        Meshes::beside_with(file, ReadOptions::from_environment())
    }

    /// Same as [`Meshes::beside`], but with the packages of `options`.
    pub fn beside_with(file: &Path, options: ReadOptions) -> Self {
        let full = std::path::absolute(file).unwrap_or(file.to_owned());
        Meshes { folders: full.ancestors().skip(1).map(Path::to_owned).collect(), options }
    }

    /// The file for the description's `path`; `None` if it does not exist.
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
        let found = self.folders.iter().flat_map(inside).flatten().find(|file| file.is_file());
        found.or_else(|| {
            self.options.find_package(package).map(|folder| folder.join(inner)).filter(|file| file.is_file())
        })
    }

    /// Points whose convex hull is approximately the solid, in its frame \[m\]. For a mesh they are the corners of its
    /// triangles.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for a missing or unreadable file; [`ErrorKind::Unsupported`] for a format other than STL;
    /// [`ErrorKind::Syntax`] for a file that is not STL, with the line or the triangle; [`ErrorKind::BadValue`] above a
    /// hundred megabytes, for a corner that is not finite, and for a file without triangles.
    #[doc(hidden)]
    pub fn points(&self, solid: &Solid) -> Result<Vec<Point3<f64>>> {
        if let Solid::Mesh { .. } = solid { Ok(self.triangles(solid)?.points) } else { Ok(solid.points()) }
    }

    /// The triangles of a mesh, in its frame; empty for another solid.
    ///
    /// # Errors
    /// Those of [`Meshes::points`].
    pub fn triangles(&self, solid: &Solid) -> Result<Surface> {
        let Solid::Mesh { path, scale } = solid else {
            return Ok(Surface { points: Vec::new(), triangles: Vec::new() });
        };
        let missing = || {
            let text = format!(
                "the mesh `{}` is not found; its folder must be above the description's file, or given by `--package NAME=FOLDER`",
                shown(path)
            );
            Error::new(ErrorKind::Io, text)
        };
        let file = self.find(path).ok_or_else(missing)?;
        read_stl(&file, *scale).map_err(|error| error.in_file(&file))
    }

    /// The triangles of a mesh. If they cannot be read, the reason is added to `notes`, once.
    #[doc(hidden)]
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

/// Whether an STL mesh is a text file.
pub(super) fn is_text(file: &Path) -> bool {
    read_bytes(file, MESH_LIMIT).is_ok_and(|bytes| stl::is_text(&bytes))
}

fn read_stl(file: &Path, scale: [f64; 3]) -> Result<Surface> {
    if !file.extension().is_some_and(|end| end.eq_ignore_ascii_case("stl")) {
        return Err(Error::new(ErrorKind::Unsupported, "only meshes in STL are read; convert it, or give boxes"));
    }
    let corners = stl::corners(read_bytes(file, MESH_LIMIT)?)?;
    if corners.is_empty() {
        return Err(Error::new(ErrorKind::BadValue, "this STL has no triangle"));
    }
    let (mut points, mut places) = (Vec::new(), HashMap::new());
    let mut place = |corner: [f32; 3]| {
        // A file of at most a hundred megabytes has fewer than 2^32 corners.
        *places.entry(corner.map(f32::to_bits)).or_insert_with(|| {
            points.push(Point3::from(std::array::from_fn(|axis| f64::from(corner[axis]) * scale[axis])));
            points.len() as u32 - 1
        })
    };
    let triangles: Vec<[u32; 3]> = corners.into_iter().map(|triangle| triangle.map(&mut place)).collect();
    let is_bad = |corner: &u32| !points[*corner as usize].iter().all(|x: &f64| x.is_finite());
    match triangles.iter().position(|triangle| triangle.iter().any(is_bad)) {
        None => Ok(Surface { points, triangles }),
        Some(place) => {
            let text = format!("a corner of triangle {} is not finite", place + 1);
            Err(Error::new(ErrorKind::BadValue, text))
        }
    }
}
