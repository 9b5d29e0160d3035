//! The syntax tree of expressions. Main type: [`Expression`].

use super::value::Value;

/// An operator on two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    FloorDivide,
    Remainder,
    Power,
    BitAnd,
    BitOr,
    BitXor,
    ShiftLeft,
    ShiftRight,
}

/// A comparison of two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
    In,
    NotIn,
    Is,
    IsNot,
}

/// An operator on one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    Minus,
    Plus,
    Not,
    Invert,
}

/// An expression.
#[derive(Debug)]
pub enum Expression {
    Literal(Value),
    Name(String),
    List(Vec<Expression>),
    Tuple(Vec<Expression>),
    Dict(Vec<(Expression, Expression)>),
    Comprehension(Box<Comprehension>),
    Unary(Unary, Box<Expression>),
    Binary(Operator, Box<Expression>, Box<Expression>),
    Compare(Box<Expression>, Vec<(Comparison, Expression)>),
    And(Box<Expression>, Box<Expression>),
    Or(Box<Expression>, Box<Expression>),
    /// The condition, and the values if it is true or false.
    If(Box<[Expression; 3]>),
    Attribute(Box<Expression>, String),
    Index(Box<Expression>, Box<Expression>),
    /// Start, end and step.
    Slice(Box<Expression>, Box<[Option<Expression>; 3]>),
    Call(Box<Expression>, Vec<Expression>, Vec<(String, Expression)>),
}

/// `[element for names in source if condition]`.
#[derive(Debug)]
pub struct Comprehension {
    pub element: Expression,
    pub names: Vec<String>,
    pub source: Expression,
    pub condition: Option<Expression>,
}

/// The binary operators with their levels: a higher one binds closer.
pub const OPERATORS: [(&str, u8, Operator); 11] = [
    ("|", 1, Operator::BitOr),
    ("^", 2, Operator::BitXor),
    ("&", 3, Operator::BitAnd),
    ("<<", 4, Operator::ShiftLeft),
    (">>", 4, Operator::ShiftRight),
    ("+", 5, Operator::Add),
    ("-", 5, Operator::Subtract),
    ("*", 6, Operator::Multiply),
    ("/", 6, Operator::Divide),
    ("//", 6, Operator::FloorDivide),
    ("%", 6, Operator::Remainder),
];

/// The comparisons that have a sign.
pub const COMPARISONS: [(&str, Comparison); 6] = [
    ("==", Comparison::Equal),
    ("!=", Comparison::Unequal),
    ("<", Comparison::Less),
    ("<=", Comparison::AtMost),
    (">", Comparison::Greater),
    (">=", Comparison::AtLeast),
];
