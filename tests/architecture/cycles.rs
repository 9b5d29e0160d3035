//! Import cycles between files. A folder's `mod.rs` and the files below it may import each other.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::Source;
use super::scan;

type Module = Vec<String>;

/// The imports of `sources` that are on cycles or lead from one cycle to another, one line for each pair of files.
pub fn on_rings(sources: &[Source]) -> Vec<String> {
    let house = House::new(sources);
    let mut edges: BTreeMap<&Module, BTreeSet<&Module>> = BTreeMap::new();
    for source in sources {
        let targets = source.references().into_iter().filter_map(|reference| house.module_of(reference.path));
        let beside = targets.filter(|target| !is_above(target, &source.module) && !is_above(&source.module, target));
        edges.entry(&source.module).or_default().extend(beside);
    }
    // A file that imports no remaining file, or is imported by none, is on no cycle.
    loop {
        let imported: BTreeSet<&Module> = edges.values().flatten().copied().collect();
        let before = edges.len();
        edges.retain(|module, targets| !targets.is_empty() && imported.contains(module));
        let left: BTreeSet<&Module> = edges.keys().copied().collect();
        edges.values_mut().for_each(|targets| targets.retain(|target| left.contains(target)));
        if edges.len() == before {
            break;
        }
    }
    let line = |(from, to): (&Module, &Module)| format!("{} imports {}", from.join("::"), to.join("::"));
    edges.iter().flat_map(|(from, targets)| targets.iter().map(move |to| line((from, to)))).collect()
}

/// Whether `other` is `module` or inside it.
fn is_above(module: &[String], other: &[String]) -> bool {
    other.starts_with(module)
}

/// The modules of the files, and the names that they re-export.
struct House<'a> {
    modules: BTreeSet<&'a Module>,
    lent: HashMap<(&'a Module, String), Module>,
}

impl<'a> House<'a> {
    fn new(sources: &'a [Source]) -> Self {
        let lent = |source: &'a Source| {
            let own = scan::lent(&source.tokens, &source.module).into_iter();
            own.map(move |(name, path)| ((&source.module, name), path))
        };
        House {
            modules: sources.iter().map(|source| &source.module).collect(),
            lent: sources.iter().flat_map(lent).collect(),
        }
    }

    /// The file that defines what `path` names, after all re-exports are resolved; `None` outside the crate's files.
    fn module_of(&self, mut path: Module) -> Option<&'a Module> {
        for _ in 0..8 {
            let depth = (0..=path.len()).rev().find(|&depth| self.modules.contains(&path[..depth].to_vec()))?;
            let module = *self.modules.get(&path[..depth].to_vec())?;
            let Some(name) = path.get(depth) else { return Some(module) };
            let Some(target) = self.lent.get(&(module, name.clone())) else { return Some(module) };
            path = target.iter().chain(&path[depth + 1..]).cloned().collect();
        }
        None
    }
}
