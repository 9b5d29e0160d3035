//! The expressions and declarations that differ between the languages ([`Expressions`]).

/// The expressions and declarations that differ between the languages.
pub(super) trait Expressions {
    /// Whether the language or its library reserves this word.
    fn is_reserved(&self, word: &str) -> bool;
    /// `function` (`abs`, `sqrt`, `cos` or `sin`) of an expression; the argument of all but `abs` is typed.
    fn call(&self, function: &str, argument: &str) -> String;
    /// The square root of a typed expression, zero for a negative number.
    fn root(&self, square: &str) -> String;
    /// A constant.
    fn literal(&self, value: f64) -> String {
        number(value)
    }
    /// A constant outside of the generic number type.
    fn given(&self, value: f64) -> String {
        number(value)
    }
    /// A constant that is used alone in a case or among the parameters.
    fn alone(&self, constant: String) -> String {
        constant
    }
    /// A new immutable number.
    fn declare(&self, name: &str, value: &str) -> String;
    /// New numbers from the elements of the array `at`; those without a name are not read.
    fn declare_places(&self, names: &[Option<&str>]) -> Vec<String> {
        let declared =
            |(place, name): (usize, &Option<&str>)| name.map(|name| self.declare(name, &format!("at[{place}]")));
        names.iter().enumerate().filter_map(declared).collect()
    }
    /// New numbers from all elements of an array.
    fn declare_all(&self, names: &[&str], array: &str) -> Vec<String> {
        let declared = |(place, name): (usize, &&str)| self.declare(name, &format!("{array}[{place}]"));
        names.iter().enumerate().map(declared).collect()
    }
    /// Positive or negative infinity.
    fn infinity(&self, positive: bool) -> String;
    /// Quotes a text.
    fn quote(&self, text: &str) -> String;
}

/// The shortest decimal that reads back as the same double.
pub(super) fn number(value: f64) -> String {
    format!("{value:?}")
}
