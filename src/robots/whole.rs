//! A whole robot as data: its chains on one base, what the links weigh, how fast the joints turn, its soles. Main type: [`Whole`].

use nalgebra::{Matrix3, Point3};

use super::by_name;
use crate::document::{Document, Node, Table};
use crate::kinematics::Chain;
use crate::spatial::{Pose, Screw};
use crate::{Error, ErrorKind, Result};

/// Mass, centre of mass and inertia as a data file states them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// The mass \[kg\].
    pub mass: f64,
    /// The centre of mass in the link's frame \[m\].
    pub centre: Point3<f64>,
    /// The inertia tensor about the centre of mass, along the axes of the link's frame \[kg m^2\].
    pub inertia: Matrix3<f64>,
}

/// A link and the joint that moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeLink {
    /// The name of the link.
    pub name: String,
    /// The name of the joint, unique in the robot.
    pub joint: String,
    /// The link before it, by its place in [`Whole::links`]; `None` for the base.
    pub parent: Option<usize>,
    /// The joint in the base frame at the zero configuration.
    pub screw: Screw,
    /// The frame of the link at the zero configuration; its origin is on the joint's axis.
    pub base_from_link: Pose,
    /// Least and greatest value of the joint \[rad\].
    pub limits: (f64, f64),
    /// The greatest rate of the joint without load \[rad/s\].
    pub speed: f64,
    /// What the link weighs.
    pub weight: Weight,
}

/// A sole, as rectangles in its frame: x ahead, y left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// The link that it is fixed to, by its place in [`Whole::links`].
    pub link: usize,
    /// The frame of the sole in the base frame at the zero configuration.
    pub base_from_sole: Pose,
    /// Least and greatest x and y of what touches the floor, as measured \[m\].
    pub measured: [(f64, f64); 2],
    /// The same as the source document has it.
    pub seed: [(f64, f64); 2],
}

/// A whole robot: a base, and the links of all chains behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// Its name.
    pub name: String,
    /// What the base weighs.
    pub base: Weight,
    /// The links, chain by chain from the base; link `i` is moved by joint `i`.
    pub links: Vec<WholeLink>,
    /// Pairs of joints that one motor turns by the same angle.
    pub shared: Vec<(usize, usize)>,
    /// The soles, left and right.
    pub soles: [Sole; 2],
}

impl Whole {
    /// Reads the text of a data file; its chains are robots of this module.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`], [`ErrorKind::MissingKey`], [`ErrorKind::UnknownKey`], [`ErrorKind::UnknownName`] for a chain, joint or limb
    /// that is not there, [`ErrorKind::BadValue`] for a wrong number of links or soles; with the line.
    pub fn from_toml(text: &str) -> Result<Self> {
        let document = Document::parse(text)?;
        let root = document.root();
        root.deny_unknown(&["name", "source", "mass", "base", "limb", "shared", "sole"])?;
        let mut links = Vec::new();
        let mut tips = Vec::new();
        for limb in root.required("limb")?.tables()? {
            tips.push(append(&limb, &mut links)?);
        }
        let base = root.required("base")?.table()?;
        base.deny_unknown(&["name", "mass", "centre", "inertia"])?;
        let soles = root.required("sole")?;
        let [left, right] = soles.tables()?[..] else {
            return Err(soles.error(ErrorKind::BadValue, "give two soles, the left one first"));
        };
        Ok(Whole {
            name: root.required("name")?.text()?.to_owned(),
            base: weight(&base)?,
            shared: shared(&root, &links)?,
            soles: [sole(&left, &tips)?, sole(&right, &tips)?],
            links,
        })
    }

    /// The place of the joint `name` in [`Whole::links`].
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.joint == name)
    }
}

/// Where a chain ends.
struct LimbTip {
    chain: String,
    link: usize,
    base_from_tip: Pose,
}

/// Appends the links of a limb and tells where it ends.
fn append(limb: &Table<'_>, links: &mut Vec<WholeLink>) -> Result<LimbTip> {
    limb.deny_unknown(&["chain", "prefix", "link"])?;
    let name = limb.required("chain")?;
    let text = || name.error(ErrorKind::UnknownName, "no robot of this crate has this name");
    let chain: Chain = by_name(name.text()?).ok_or_else(text)?;
    let prefix = limb.required("prefix")?.text()?;
    let given = limb.required("link")?;
    let tables = given.tables()?;
    if tables.len() != chain.joints().len() {
        let text = format!("{} links are given; the chain has {} joints", tables.len(), chain.joints().len());
        return Err(given.error(ErrorKind::BadValue, text));
    }
    for (place, table) in tables.iter().enumerate() {
        let parent = (place > 0).then(|| links.len() - 1);
        links.push(link(table, &chain, place, prefix, parent)?);
    }
    Ok(LimbTip { chain: chain.name().to_owned(), link: links.len() - 1, base_from_tip: chain.base_from_tip() })
}

fn link(table: &Table<'_>, chain: &Chain, place: usize, prefix: &str, parent: Option<usize>) -> Result<WholeLink> {
    table.deny_unknown(&["name", "joint", "speed", "mass", "centre", "inertia"])?;
    let joint = &chain.joints()[place];
    let named = table.required("joint")?;
    if named.text()? != joint.name {
        let text = format!("joint {place} of the chain is `{}`; list its joints in order", joint.name);
        return Err(named.error(ErrorKind::UnknownName, text));
    }
    let missing =
        || named.error(ErrorKind::MissingKey, "the chain gives no limits of this joint; a whole robot needs them");
    Ok(WholeLink {
        name: table.required("name")?.text()?.to_owned(),
        joint: format!("{prefix}{}", joint.name),
        parent,
        screw: chain.screws()[place],
        base_from_link: Pose::from_parts(joint.location().coords.into(), nalgebra::UnitQuaternion::identity()),
        limits: joint.limits.ok_or_else(missing)?,
        speed: table.required("speed")?.float()?,
        weight: weight(table)?,
    })
}

fn weight(table: &Table<'_>) -> Result<Weight> {
    let [xx, yy, zz, xy, xz, yz] = table.required("inertia")?.float_vector::<6>()?;
    Ok(Weight {
        mass: table.required("mass")?.float()?,
        centre: Point3::from(table.required("centre")?.float_vector::<3>()?),
        inertia: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    })
}

fn shared(root: &Table<'_>, links: &[WholeLink]) -> Result<Vec<(usize, usize)>> {
    let Some(node) = root.optional("shared") else { return Ok(Vec::new()) };
    let place = |node: &Node<'_>| -> Result<usize> {
        let name = node.text()?;
        let unknown = || node.error(ErrorKind::UnknownName, format!("no joint is called `{name}`"));
        links.iter().position(|link| link.joint == name).ok_or_else(unknown)
    };
    let pair = |table: &Table<'_>| {
        let joints = table.required("joints")?;
        match &joints.array()?[..] {
            [one, other] => Ok((place(one)?, place(other)?)),
            _ => Err(joints.error(ErrorKind::BadValue, "give the names of two joints")),
        }
    };
    node.tables()?.iter().map(pair).collect()
}

fn sole(table: &Table<'_>, tips: &[LimbTip]) -> Result<Sole> {
    table.deny_unknown(&["limb", "x", "y", "seed"])?;
    let named = table.required("limb")?;
    let name = named.text()?;
    let tip = tips
        .iter()
        .find(|tip| tip.chain == name)
        .ok_or_else(|| -> Error { named.error(ErrorKind::UnknownName, "no limb of this robot has that chain") })?;
    let measured = [table.required("x")?.float_vector::<2>()?.into(), table.required("y")?.float_vector::<2>()?.into()];
    let size = table.required("seed")?.float_vector::<2>()?;
    let about = |(low, high): (f64, f64), size: f64| ((low + high - size) / 2.0, (low + high + size) / 2.0);
    let seed = [about(measured[0], size[0]), about(measured[1], size[1])];
    Ok(Sole { link: tip.link, base_from_sole: tip.base_from_tip, measured, seed })
}
