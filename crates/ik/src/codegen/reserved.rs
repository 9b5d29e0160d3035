//! Names that printed code must not use.

use groebot_algebra::limits::RUN_TIME_FILES;
use groebot_robot::document::word;

/// Reserved words of C, C++, their libraries and the run time.
const RESERVED: &str = "auto break case char const continue default do double else enum extern float for goto if inline int \
    long register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while \
    bool true false asm typeof \
    and and_eq bitand bitor catch char16_t char32_t char8_t class compl concept const_cast consteval constinit co_await co_return \
    co_yield decltype delete dynamic_cast explicit export friend mutable namespace new not not_eq operator or or_eq private \
    protected public reinterpret_cast requires static_cast template this throw try typeid typename using virtual xor xor_eq std UNITS IkReal \
    alignas alignof constexpr nullptr static_assert thread_local noreturn \
    size_t ptrdiff_t wchar_t NULL offsetof NAN INFINITY HUGE_VAL HUGE_VALF HUGE_VALL DECIMAL_DIG errno complex imaginary I \
    float_t double_t math_errhandling signgam linux unix i386 T R GROEBOT_H \
    sin cos sqrt fabs fmax fmin atan2 round copysign isfinite isnan free_joints assert";

/// Prefixes of other reserved words.
const PREFIXES: [&str; 9] = ["FLT_", "DBL_", "LDBL_", "FP_", "MATH_", "M_", "__", "gb_", "GB_"];

/// Whether the word is reserved in C or C++.
pub(super) fn is_reserved(word: &str) -> bool {
    RESERVED.split_whitespace().any(|reserved| reserved == word)
        || PREFIXES.iter().any(|prefix| word.starts_with(prefix))
}

/// Whether a file with this name would overwrite one of the run time.
#[doc(hidden)]
pub fn is_run_time(stem: &str) -> bool {
    RUN_TIME_FILES.iter().any(|own| stem.eq_ignore_ascii_case(own))
}

/// The prefix of function names and, in capitals, of constants, from a program's or robot's name. It is not a reserved
/// word of a language or the run time, and does not begin like one.
pub(super) fn prefix(name: &str) -> String {
    let name = word(name);
    let begun = format!("{name}_");
    let is_taken = [&name, &begun, &begun.to_ascii_uppercase()].into_iter().any(|word| is_reserved(word));
    if is_taken || is_run_time(&name) { format!("robot_{name}") } else { name }
}
