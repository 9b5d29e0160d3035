//! The limits of one expansion. Main type: [`Budget`].

use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;

/// The remaining steps and bytes of an expansion, and its current depth.
pub struct Budget {
    steps: usize,
    input: u64,
    output: usize,
    files: usize,
    depth: usize,
}

impl Budget {
    /// The whole budget.
    pub fn new() -> Self {
        Budget {
            steps: limits::XACRO_STEPS,
            input: limits::XACRO_BYTES,
            output: limits::XML_BYTES as usize,
            files: limits::XACRO_FILES,
            depth: 0,
        }
    }

    /// Spends steps: one for an operation, and one for each 16 bytes or entries of its result.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if none remain.
    pub fn spend(&mut self, size: usize) -> Result<()> {
        let left = self.steps.checked_sub(1 + size / 16);
        self.steps =
            left.ok_or_else(|| over(format!("the expansion takes more than {} steps", limits::XACRO_STEPS)))?;
        Ok(())
    }

    /// Spends steps for a text or a list of `length`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for more than [`limits::XACRO_LENGTH`], and as [`Budget::spend`].
    pub fn spend_length(&mut self, length: usize) -> Result<()> {
        check_length(length)?;
        self.spend(length)
    }

    /// The number of bytes that a file may have.
    pub fn input(&self) -> u64 {
        self.input
    }

    /// Spends the bytes of one file.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for too many bytes or files.
    pub fn spend_file(&mut self, bytes: u64) -> Result<()> {
        let bytes = self.input.checked_sub(bytes);
        let files = self.files.checked_sub(1);
        let many = || {
            let (files, bytes) = (limits::XACRO_FILES, limits::XACRO_BYTES);
            over(format!("the expansion reads more than {files} files or {bytes} bytes"))
        };
        (self.input, self.files) = bytes.zip(files).ok_or_else(many)?;
        self.spend(0)
    }

    /// Spends bytes of the output.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if the output is too long.
    pub fn spend_output(&mut self, bytes: usize) -> Result<()> {
        let left = self.output.checked_sub(bytes);
        self.output = left.ok_or_else(|| over(format!("the expansion is longer than {} bytes", limits::XML_BYTES)))?;
        self.spend(bytes)
    }

    /// Enters an element, a macro, a property or a part of an expression. [`Budget::leave`] leaves it.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] at the maximum depth.
    pub fn enter(&mut self) -> Result<()> {
        if self.depth >= limits::XACRO_DEPTH {
            let text = format!("elements, macros and expressions are nested deeper than {}", limits::XACRO_DEPTH);
            return Err(over(text));
        }
        self.depth += 1;
        Ok(())
    }

    /// Leaves what [`Budget::enter`] entered.
    pub fn leave(&mut self) {
        self.depth -= 1;
    }
}

/// Checks the length of a text or a list.
///
/// # Errors
/// [`ErrorKind::BadValue`] for more than [`limits::XACRO_LENGTH`].
pub fn check_length(length: usize) -> Result<()> {
    if length <= limits::XACRO_LENGTH {
        return Ok(());
    }
    Err(over(format!("a text or list is longer than {} characters or entries", limits::XACRO_LENGTH)))
}

fn over(text: String) -> Error {
    Error::new(ErrorKind::BadValue, format!("{text}; this is the limit"))
}
