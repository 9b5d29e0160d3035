//! The folder of a mechanism: the list of files that `derive` and `dynamics --symbolic` write ([`derived`], [`motion`]), and the check of a stored folder
//! against that list ([`check`]). The writer and the check share the list, so that every written file is checked. A thin folder has a hash of each output
//! instead of the output itself ([`Outputs`]).

mod cache;
mod check;
mod finding;
mod load;
mod measured;
pub mod motion;
mod names;
mod outputs;
mod proof_text;
mod stored;
mod written;

pub use cache::SolverCache;
pub use check::{Checked, check, check_by, compare, prove, prove_text};
pub use finding::{Finding, Verdict};
pub use load::{program, reprove};
pub use names::{CERTIFICATE, CHECKS, DYNAMICS, DYNAMICS_TEXT, OUTPUTS, PROGRAM, is_printed_solver, is_written_name};
pub use outputs::{Outputs, is_thin, thin};
pub use stored::Stored;
pub use written::{Written, derived};
