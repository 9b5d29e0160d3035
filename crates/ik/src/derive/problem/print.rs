//! The text of a system: the stage file `1_equations.txt`.

use std::fmt::{self, Display, Formatter};

use crate::derive::problem::system::System;
use crate::derive::report::explain::equations_page;

impl Display for System {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&equations_page(self).to_text())
    }
}
