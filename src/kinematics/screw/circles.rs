#![allow(missing_docs)]
use super::values::*; use nalgebra::*; use super::trigonometric::zeros;
pub fn four_circles(h:[Vector3<f64>;4],_k:[Unit<Vector3<f64>>;4],_p:[Vector3<f64>;4],d1:f64,d2:f64,_r:Reach)->Answers<2>{
 let mut out=Answers(Default::default());
 let Some(inv)=Matrix2::new(h[0].x,h[0].y,h[2].x,h[2].y).try_inverse() else {return out};
 let at=|t:f64| inv*Vector2::new(d1-h[1].x*t.cos()-h[1].y*t.sin(), d2-h[3].x*t.cos()-h[3].y*t.sin());
 for t in zeros(2,|t| at(t).norm_squared()-1.0) { let v=at(t); out.0.push([Some(v.y.atan2(v.x)),Some(t)]); }
 out}
