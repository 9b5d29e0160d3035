//! `--base` and `--tip`: which chain of a URDF.

use crate::derive::Ends;

/// The links between which a chain is wanted.
#[derive(clap::Args)]
pub struct EndArguments {
    /// URDF: the link where the chain starts (default: the root)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// URDF: the link where the chain ends (default: the only leaf)
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
}

impl EndArguments {
    /// The same as plain data.
    pub fn ends(&self) -> Ends {
        Ends { base: self.base.clone(), tip: self.tip.clone() }
    }
}
