//! What differs between the languages in expressions and declarations ([`Expressions`]).

/// What differs between the languages in expressions and declarations.
pub(super) trait Expressions {
    /// Whether the language or its library keeps this word for itself.
    fn is_reserved(&self, word: &str) -> bool;
    /// `function` (`abs`, `sqrt`, `cos` or `sin`) of an expression; the argument of all but `abs` is typed.
    fn call(&self, function: &str, argument: &str) -> String;
    /// The square root of a typed expression, zero of a number below zero.
    fn root(&self, square: &str) -> String;
    /// A constant.
    fn literal(&self, value: f64) -> String {
        number(value)
    }
    /// A constant outside of what is computed.
    fn given(&self, value: f64) -> String {
        number(value)
    }
    /// A constant that stands alone in a case or among the parameters.
    fn alone(&self, constant: String) -> String {
        constant
    }
    /// A new immutable number.
    fn declare(&self, name: &str, value: &str) -> String;
    /// New numbers, of which each is what stands in its place of `at`; those without a name are not read.
    fn declare_places(&self, names: &[Option<&str>]) -> Vec<String> {
        let declared =
            |(place, name): (usize, &Option<&str>)| name.map(|name| self.declare(name, &format!("at[{place}]")));
        names.iter().enumerate().filter_map(declared).collect()
    }
    /// New numbers, all those of an array.
    fn declare_all(&self, names: &[&str], array: &str) -> Vec<String> {
        let declared = |(place, name): (usize, &&str)| self.declare(name, &format!("{array}[{place}]"));
        names.iter().enumerate().map(declared).collect()
    }
    /// The greatest or least of all numbers, an infinity.
    fn infinity(&self, positive: bool) -> String;
    /// A piece of text in quotation marks.
    fn quote(&self, text: &str) -> String;
}

/// The shortest decimal that reads back as the same double.
pub(super) fn number(value: f64) -> String {
    format!("{value:?}")
}
