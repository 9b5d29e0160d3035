//! Whole robots from their data files.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::{Sole, Weight, Whole, WholeLimb, WholeLink};
use crate::document::{Document, Node, Table};
use crate::kinematics::Chain;
use crate::robots::by_name;
use crate::spatial::{Pose, Screw};
use crate::{Error, ErrorKind, Result};

impl Whole {
    /// Reads the text of a data file; its chains are robots of [`crate::robots`]. Its vectors are along the axes that `axes` names
    /// (`["ahead", "left", "up"]` unless it says otherwise); the robot's base frame has x ahead, y left, z up.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`], [`ErrorKind::MissingKey`], [`ErrorKind::UnknownKey`], [`ErrorKind::UnknownName`] for a chain, joint or limb
    /// that is not there, [`ErrorKind::BadValue`] for a wrong number of links or soles; with the line.
    pub fn from_toml(text: &str) -> Result<Self> {
        let document = Document::parse(text)?;
        let root = document.root();
        let keys =
            ["name", "source", "mass", "axes", "angle_unit", "base", "limb", "shared", "coordinated", "sole", "status"];
        root.deny_unknown(&keys)?;
        let mut reader = Reader { axes: axes(&root)?, angle: angle_unit(&root)?, links: Vec::new(), limbs: Vec::new() };
        for limb in root.required("limb")?.tables()? {
            reader.append(&limb)?;
        }
        let base = root.required("base")?.table()?;
        base.deny_unknown(&["name", "mass", "centre", "inertia"])?;
        let soles = root.required("sole")?;
        let [left, right] = soles.tables()?[..] else {
            return Err(soles.error(ErrorKind::BadValue, "give two soles, the left one first"));
        };
        Ok(Whole {
            name: root.required("name")?.text()?.to_owned(),
            base: reader.weight(&base)?,
            is_point_mass: reader.links.iter().all(|link| link.weight.is_none()),
            shared: reader.pairs(&root, "shared")?,
            coordinated: reader.pairs(&root, "coordinated")?,
            soles: [reader.sole(&left)?, reader.sole(&right)?],
            links: reader.links,
            limbs: reader.limbs,
        })
    }
}

/// What has been read so far.
struct Reader {
    /// From the axes of the file to ours: x ahead, y left, z up.
    axes: UnitQuaternion<f64>,
    /// The file's unit of angles \[rad\].
    angle: f64,
    links: Vec<WholeLink>,
    limbs: Vec<WholeLimb>,
}

fn axes(root: &Table<'_>) -> Result<UnitQuaternion<f64>> {
    let Some(node) = root.optional("axes") else { return Ok(UnitQuaternion::identity()) };
    let names = [("ahead", Vector3::x()), ("left", Vector3::y()), ("up", Vector3::z())];
    let columns = node.array()?.iter().map(|name| name.one_of(&names)).collect::<Result<Vec<_>>>()?;
    let turn = match columns[..] {
        [x, y, z] if x.cross(&y) == z => Matrix3::from_columns(&[x, y, z]),
        _ => return Err(node.error(ErrorKind::BadValue, "name what x, y and z are, right-handed")),
    };
    Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn)))
}

fn angle_unit(root: &Table<'_>) -> Result<f64> {
    let Some(node) = root.optional("angle_unit") else { return Ok(1.0) };
    node.one_of(&[("rad", 1.0), ("deg", 1_f64.to_radians())])
}

impl Reader {
    fn append(&mut self, limb: &Table<'_>) -> Result<()> {
        limb.deny_unknown(&["chain", "name", "prefix", "link", "reversed", "mirrored", "on"])?;
        let given = limb.required("link")?;
        let first = self.links.len();
        let flag = |key: &str| limb.optional(key).map_or(Ok(false), |node| node.boolean());
        let (reversed, mirrored) = (flag("reversed")?, flag("mirrored")?);
        let parent = limb.optional("on").map(|node| self.place(&node)).transpose()?;
        let prefix = limb.required("prefix")?.text()?;
        let tables = given.tables()?;
        let turned = Pose::from_parts(Vector3::zeros().into(), self.axes);
        let mut read = WholeLimb {
            chain: String::new(),
            joints: (first..first + tables.len()).collect(),
            reversed,
            mirrored,
            base_from_root: turned,
            base_from_tip: turned,
        };
        if let Some(node) = limb.optional("chain") {
            let missing = || node.error(ErrorKind::UnknownName, "no robot of this crate has this name");
            let chain: Chain = by_name(node.text()?).ok_or_else(missing)?;
            if tables.len() != chain.joints().len() {
                let text = format!("{} links are given; the chain has {} joints", tables.len(), chain.joints().len());
                return Err(given.error(ErrorKind::BadValue, text));
            }
            read.chain = chain.name().to_owned();
            if reversed {
                read.base_from_root = turned * chain.base_from_tip().inverse();
                read.joints.reverse();
            } else {
                read.base_from_tip = reflected(&(turned * chain.base_from_tip()), mirrored);
            }
            for (place, table) in tables.iter().enumerate() {
                let place = if reversed { tables.len() - 1 - place } else { place };
                let joint = Jointed::of_chain(table, &chain, place, &read)?;
                self.links.push(self.link(table, joint, prefix, first, parent)?);
            }
        } else {
            read.chain = limb.required("name")?.text()?.to_owned();
            for table in &tables {
                let joint = Jointed::stated(table, &turned)?;
                self.links.push(self.link(table, joint, prefix, first, parent)?);
            }
        }
        self.limbs.push(read);
        Ok(())
    }

    /// A link of the limb whose links start at `first` and whose first link is carried by `carrier`.
    fn link(
        &self,
        table: &Table<'_>,
        joint: Jointed,
        prefix: &str,
        first: usize,
        carrier: Option<usize>,
    ) -> Result<WholeLink> {
        table.deny_unknown(&[
            "name", "joint", "symbol", "axis", "point", "limits", "speed", "mass", "centre", "inertia",
        ])?;
        let given = table.optional("limits").map(|node| node.float_vector::<2>()).transpose()?;
        let given = given.map(|[low, high]| (low * self.angle, high * self.angle));
        let named = table.required("joint")?;
        let missing = || named.error(ErrorKind::MissingKey, "give the joint's `limits`; a whole robot needs them");
        Ok(WholeLink {
            name: table.required("name")?.text()?.to_owned(),
            joint: format!("{prefix}{}", named.text()?),
            symbol: joint.symbol,
            parent: if self.links.len() > first { Some(self.links.len() - 1) } else { carrier },
            screw: joint.screw,
            base_from_link: Pose::from_parts(joint.location.coords.into(), UnitQuaternion::identity()),
            limits: given.or(joint.limits).ok_or_else(missing)?,
            speed: table.required("speed")?.float()?,
            weight: table.optional("mass").map(|_| self.weight(table)).transpose()?,
        })
    }

    fn weight(&self, table: &Table<'_>) -> Result<Weight> {
        let [xx, yy, zz, xy, xz, yz] = table.required("inertia")?.float_vector::<6>()?;
        let turn = self.axes.to_rotation_matrix().into_inner();
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let centre = Vector3::from(table.required("centre")?.float_vector::<3>()?);
        Ok(Weight {
            mass: table.required("mass")?.float()?,
            centre: Point3::from(self.axes * centre),
            inertia: if self.axes == UnitQuaternion::identity() { inertia } else { turn * inertia * turn.transpose() },
        })
    }

    fn place(&self, node: &Node<'_>) -> Result<usize> {
        let name = node.text()?;
        let unknown = || node.error(ErrorKind::UnknownName, format!("no joint is called `{name}`"));
        self.links.iter().position(|link| link.joint == name).ok_or_else(unknown)
    }

    fn pairs(&self, root: &Table<'_>, key: &str) -> Result<Vec<(usize, usize)>> {
        let Some(node) = root.optional(key) else { return Ok(Vec::new()) };
        let pair = |table: &Table<'_>| {
            let joints = table.required("joints")?;
            match &joints.array()?[..] {
                [one, other] => Ok((self.place(one)?, self.place(other)?)),
                _ => Err(joints.error(ErrorKind::BadValue, "give the names of two joints")),
            }
        };
        node.tables()?.iter().map(pair).collect()
    }

    fn sole(&self, table: &Table<'_>) -> Result<Sole> {
        table.deny_unknown(&["limb", "mirrored", "at", "x", "y", "seed"])?;
        let named = table.required("limb")?;
        let name = named.text()?;
        let mirrored = table.optional("mirrored").map_or(Ok(false), |node| node.boolean())?;
        let limb = self.limbs.iter().find(|limb| limb.chain == name && limb.mirrored == mirrored);
        let limb = limb
            .ok_or_else(|| -> Error { named.error(ErrorKind::UnknownName, "no limb of this robot has that chain") })?;
        let base_from_sole = match table.optional("at") {
            Some(node) => {
                let at = self.axes * Vector3::from(node.float_vector::<3>()?);
                Pose::from_parts(at.into(), UnitQuaternion::identity())
            }
            None => limb.base_from_tip,
        };
        let range = |key: &str| Ok::<(f64, f64), Error>(table.required(key)?.float_vector::<2>()?.into());
        let measured = [range("x")?, range("y")?];
        let about = |(low, high): (f64, f64), size: f64| ((low + high - size) / 2.0, (low + high + size) / 2.0);
        let seed = match table.optional("seed") {
            Some(node) => {
                let size = node.float_vector::<2>()?;
                [about(measured[0], size[0]), about(measured[1], size[1])]
            }
            None => measured,
        };
        let last = if limb.reversed { limb.joints.first() } else { limb.joints.last() };
        let no_joint = || named.error(ErrorKind::BadValue, "this limb has no joint");
        Ok(Sole { link: *last.ok_or_else(no_joint)?, base_from_sole, measured, seed })
    }
}

/// The mirror image of a pose without a turn in the plane y = 0.
fn reflected(pose: &Pose, mirrored: bool) -> Pose {
    let mut pose = *pose;
    if mirrored {
        pose.translation.vector.y = -pose.translation.vector.y;
    }
    pose
}

/// A joint in the base frame.
struct Jointed {
    symbol: String,
    screw: Screw,
    location: Point3<f64>,
    limits: Option<(f64, f64)>,
}

impl Jointed {
    /// Joint `place` of `chain` in `limb`.
    fn of_chain(table: &Table<'_>, chain: &Chain, place: usize, limb: &WholeLimb) -> Result<Self> {
        let joint = &chain.joints()[place];
        let named = table.required("joint")?;
        if named.text()? != joint.name {
            let text = format!("this joint of the chain is `{}`; list its joints in order from the base", joint.name);
            return Err(named.error(ErrorKind::UnknownName, text));
        }
        let (screw, mut location) = (chain.screws()[place], limb.base_from_root * joint.location());
        let mut direction = limb.base_from_root.rotation * screw.twist().w;
        if limb.reversed {
            // Seen from the tip, the root turns the other way.
            direction = -direction;
        }
        if limb.mirrored {
            location.y = -location.y;
        }
        let screw = Screw::revolute(direction, location).map_err(|error| named.place(error))?;
        Ok(Jointed { symbol: joint.symbol.clone(), screw, location, limits: joint.limits })
    }

    /// A joint that the file states itself.
    fn stated(table: &Table<'_>, base_from_file: &Pose) -> Result<Self> {
        let axis = table.required("axis")?;
        let direction = Vector3::from(axis.float_vector::<3>()?);
        let location = base_from_file * Point3::from(table.required("point")?.float_vector::<3>()?);
        let screw =
            Screw::revolute(base_from_file.rotation * direction, location).map_err(|error| axis.place(error))?;
        let symbol = table.optional("symbol").map_or(Ok(String::new()), |node| node.text().map(str::to_owned))?;
        Ok(Jointed { symbol, screw, location, limits: None })
    }
}
