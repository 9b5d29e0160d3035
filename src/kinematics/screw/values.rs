use smallvec::SmallVec;
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach { Within(f64), Closest }
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values { None, One(f64), Two(f64,f64), Free }
impl Values { pub fn iter(self) -> impl Iterator<Item = f64> {
        let pair = match self { Values::None | Values::Free => [None, None], Values::One(a) => [Some(a), None], Values::Two(a,b) => [Some(a), Some(b)] };
        pair.into_iter().flatten() } }
#[derive(Clone, Debug, PartialEq)]
pub struct Answers<const N: usize>(pub SmallVec<[[Option<f64>; N]; 4]>);
impl<const N: usize> std::ops::Deref for Answers<N> { type Target=[[Option<f64>;N]]; fn deref(&self)->&Self::Target {&self.0} }
