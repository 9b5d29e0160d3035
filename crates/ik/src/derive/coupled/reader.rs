//! Reader of coupled chains from TOML: [`CoupledChains::read`], [`CoupledChains::from_toml`].

use std::path::Path;

use super::model::{CoupledChain, CoupledChains, CoupledParts, Fault, JointPlace, Part};
use crate::{ErrorKind, Result};
use groebot_robot::document::{Document, Node, TEXT_LIMIT, Table, one_among, read_text, shown};
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::chain_toml::{read_given, read_task};

const ROOT_KEYS: [&str; 5] = ["name", "description", "source", "shared", "chain"];
const CHAIN_KEYS: [&str; 5] = ["name", "prefix", "chain", "task", "given"];

impl CoupledChains {
    /// Reads the coupled chains in the file at `path`. Files that it names are in its folder.
    ///
    /// # Errors
    /// As [`read_text`] and [`CoupledChains::from_toml`], with the file.
    pub fn read(path: &Path) -> Result<CoupledChains> {
        let folder = path.parent().unwrap_or(Path::new(""));
        CoupledChains::from_toml(&read_text(path, TEXT_LIMIT)?, folder).map_err(|error| error.in_file(path))
    }

    /// Reads the coupled chains in `text`, in the format of [`crate::derive::coupled`]. Files that it names are in `folder`.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not TOML; [`ErrorKind::UnknownKey`], [`ErrorKind::MissingKey`]; [`ErrorKind::UnknownName`] for a shared joint
    /// that does not exist; [`ErrorKind::BadValue`] for a wrong type or value. As [`Chain::read`] for a chain, [`Chain::with_task`] for its task, and
    /// [`CoupledChains::new`]. All have a line: that of the chain's file if the error is there.
    pub fn from_toml(text: &str, folder: &Path) -> Result<CoupledChains> {
        let document = Document::parse(text)?;
        let root = document.root();
        root.deny_unknown(&ROOT_KEYS)?;
        let tables = root.required("chain")?.tables()?;
        let members = tables.iter().map(|table| read_member(*table, folder)).collect::<Result<Vec<_>>>()?;
        let groups = root.optional("shared").map(|node| node.array()).transpose()?.unwrap_or_default();
        let shared = groups.iter().map(|group| read_group(group, &members)).collect::<Result<_>>()?;
        let text = |key| root.optional(key).map(|node| node.text().map(str::to_owned)).transpose();
        let parts = CoupledParts {
            name: root.required("name")?.text()?.to_owned(),
            description: text("description")?,
            source: text("source")?,
            chains: members,
            shared,
        };
        CoupledChains::assemble(parts).map_err(|Fault { part, error }| match part {
            Part::Whole => error.at_line(root.line()),
            Part::Chain(index) => error.at_line(tables[index].line()),
            Part::Shared(index) => error.at_line(groups[index].line()),
        })
    }
}

fn read_member(table: Table<'_>, folder: &Path) -> Result<CoupledChain> {
    table.deny_unknown(&CHAIN_KEYS)?;
    let name = table.required("name")?.text()?.to_owned();
    let named = |error: crate::Error| error.with_context(format_args!("chain `{}`", shown(&name)));
    let chain = read_chain(table.required("chain")?, folder).map_err(named)?;
    let chain = requested(table, chain).map_err(|error| named(error).at_line(table.line()))?;
    let prefix = table.optional("prefix").map(|node| node.text().map(str::to_owned)).transpose()?;
    let file = table.required("chain")?.text().ok().map(str::to_owned);
    Ok(CoupledChain { prefix: prefix.unwrap_or_else(|| format!("{name}_")), name, chain, file })
}

/// Reads a chain from the description itself or from the file that it names.
fn read_chain(node: Node<'_>, folder: &Path) -> Result<Chain> {
    if let Ok(table) = node.table() {
        return Chain::from_table(table);
    }
    let wanted = "give the name of a chain.toml in the same folder, or a table";
    let file = node.text().map_err(|_| node.error(ErrorKind::BadValue, wanted))?;
    let is_plain = Path::new(file).file_name().is_some_and(|name| name == file) && !file.contains(['/', '\\']);
    if !is_plain {
        return Err(node.error(ErrorKind::BadValue, format!("`{}` is not a plain file name; {wanted}", shown(file))));
    }
    Chain::read(&folder.join(file))
}

/// `chain` with the task, the direction and the given joints of its entry.
fn requested(table: Table<'_>, chain: Chain) -> Result<Chain> {
    let own = || (chain.task(), chain.direction().clone());
    let task = table.optional("task").map(|node| read_task(node.table()?)).transpose()?;
    let is_given = table.optional("given").is_some();
    let (is_requested, (task, direction)) = (task.is_some() || is_given, task.unwrap_or_else(own));
    let given = if is_given { read_given(table)? } else { chain.parts().given.clone() };
    if is_requested { chain.with_task(task, direction, given) } else { Ok(chain) }
}

/// Reads joints with a common actuator.
fn read_group(node: &Node<'_>, members: &[CoupledChain]) -> Result<Vec<JointPlace>> {
    node.array()?.iter().map(|joint| read_place(joint, members)).collect()
}

/// Reads a joint in the form `chain.joint`.
fn read_place(node: &Node<'_>, members: &[CoupledChain]) -> Result<JointPlace> {
    let text = node.text()?;
    let unknown = |name: &str, allowed: Vec<&str>| {
        let text = format!("there is no `{}`{}", shown(name), one_among(name, &allowed));
        node.error(ErrorKind::UnknownName, text)
    };
    let Some((member_name, joint_name)) = text.split_once('.') else {
        let text = format!("`{}` is not a joint of a chain; give one such as \"left.Hip\"", shown(text));
        return Err(node.error(ErrorKind::BadValue, text));
    };
    let names = || members.iter().map(|member| member.name.as_str()).collect();
    let member =
        members.iter().position(|member| member.name == member_name).ok_or_else(|| unknown(member_name, names()))?;
    let joints = members[member].chain.joints();
    let names = || joints.iter().map(|joint| joint.name.as_str()).collect();
    let joint = joints.iter().position(|joint| joint.name == joint_name).ok_or_else(|| unknown(joint_name, names()))?;
    Ok(JointPlace { member, joint })
}
