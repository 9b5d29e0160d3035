//! The families of polynomial systems as variables and texts, for benchmarks and tests, which include this file with
//! `#[path]`.
//!
//! The definitions are those of `tests/corpus/groebner/families.py`, and the tests compare both.

/// Variables and generators.
pub type Texts = (Vec<String>, Vec<String>);

/// The member of size `n` of a family, by the family's name; `None` for a name that is not known.
pub fn member(family: &str, n: usize) -> Option<Texts> {
    let make = match family {
        "cyclic" => cyclic,
        "katsura" => katsura,
        "eco" => eco,
        "redeco" => redeco,
        "noon" => noon,
        "reimer" => reimer,
        "chandra" => chandra,
        _ => return None,
    };
    Some(make(n))
}

fn names(letter: char, indices: std::ops::Range<usize>) -> Vec<String> {
    indices.map(|i| format!("{letter}{i}")).collect()
}

/// The sums of all products of d cyclically consecutive unknowns, d < n, and the product of all minus 1.
pub fn cyclic(n: usize) -> Texts {
    let x = names('x', 0..n);
    let product =
        |start: usize, length: usize| (0..length).map(|j| x[(start + j) % n].as_str()).collect::<Vec<_>>().join("*");
    let sum = |length| (0..n).map(|start| product(start, length)).collect::<Vec<_>>().join(" + ");
    let mut equations: Vec<String> = (1..n).map(sum).collect();
    equations.push(product(0, n) + " - 1");
    (x, equations)
}

/// n+1 unknowns with x(-l) = x(l), and x(l) = 0 for l > n: x(m) = sum over l of x(l) x(m-l) for m < n, and the sum of all x(l) is 1.
pub fn katsura(n: usize) -> Texts {
    let x = names('x', 0..n + 1);
    let last = n as isize;
    let equation = |m: isize| {
        let inside = (-last..=last).filter(|l| (m - l).abs() <= last);
        let terms = inside.map(|l| format!("{}*{}", x[l.unsigned_abs()], x[(m - l).unsigned_abs()]));
        format!("{} - {}", terms.collect::<Vec<_>>().join(" + "), x[m.unsigned_abs()])
    };
    let linear = (-last..=last).map(|l| x[l.unsigned_abs()].as_str()).collect::<Vec<_>>().join(" + ") + " - 1";
    let equations = std::iter::once(linear).chain((0..last).map(equation)).collect();
    (x, equations)
}

/// (x(k) + sum over i of x(i) x(i+k)) x(n) = k for k < n, and the sum of x(1)..x(n-1) is -1.
pub fn eco(n: usize) -> Texts {
    let mut x = names('x', 1..n);
    let sums = (1..n).map(|k| format!("({})*x{n} - {k}", autocorrelation(&x, k)));
    let equations = sums.chain([x.join(" + ") + " + 1"]).collect();
    x.push(format!("x{n}"));
    (x, equations)
}

/// Same as [`eco`], but with u = 1/x(n).
pub fn redeco(n: usize) -> Texts {
    let mut x = names('x', 1..n);
    let sums = (1..n).map(|k| format!("{} - {k}*u{n}", autocorrelation(&x, k)));
    let equations = sums.chain([x.join(" + ") + " + 1"]).collect();
    x.push(format!("u{n}"));
    (x, equations)
}

/// x(k) + x(1) x(1+k) + x(2) x(2+k) + ...
fn autocorrelation(x: &[String], k: usize) -> String {
    let products = x.iter().zip(&x[k..]).map(|(a, b)| format!("{a}*{b}"));
    std::iter::once(x[k - 1].clone()).chain(products).collect::<Vec<_>>().join(" + ")
}

/// 10 x(i) (sum over j /= i of x(j)^2) - 11 x(i) + 10 = 0.
pub fn noon(n: usize) -> Texts {
    let x = names('x', 1..n + 1);
    let equation = |a: &String| {
        let squares: Vec<String> = x.iter().filter(|b| *b != a).map(|b| format!("{b}^2")).collect();
        format!("10*{a}*({}) - 11*{a} + 10", squares.join(" + "))
    };
    let equations = x.iter().map(equation).collect();
    (x, equations)
}

/// 2 (x(1)^k - x(2)^k + ...) = 1 for k = 2..n+1.
pub fn reimer(n: usize) -> Texts {
    let x = names('x', 1..n + 1);
    let signed = |i: usize, k: usize| format!("{} 2*{}^{k}", if i.is_multiple_of(2) { "+" } else { "-" }, x[i]);
    let equation = |k: usize| format!("0 {} - 1", (0..n).map(|i| signed(i, k)).collect::<Vec<_>>().join(" "));
    let equations = (2..n + 2).map(equation).collect();
    (x, equations)
}

/// 2n h(k) - c h(k) (1 + sum over i < n of k/(k+i) h(i)) = 2n with c = 51234/100000.
pub fn chandra(n: usize) -> Texts {
    let h = names('h', 1..n + 1);
    let equation = |k: usize| {
        let here = &h[k - 1];
        let sum: String = (1..n).map(|i| format!(" + {k}/{}*{}", k + i, h[i - 1])).collect();
        format!("{0}*{here} - 51234/100000*{here}*(1{sum}) - {0}", 2 * n)
    };
    let equations = (1..=n).map(equation).collect();
    (h, equations)
}
