#![allow(missing_docs)]
use super::values::*; use crate::spatial::*; use nalgebra::*; use super::one_joint::*;
pub fn two_screws_to_point(f:&Screw,s:&Screw,p:&Point3<f64>,k:&Point3<f64>,r:Reach)->Answers<2>{
 let mut out=Answers(Default::default());
 let (Some(a),Some(b))=(f.axis(),s.axis()) else {return out};
 let t2 = if a.is_parallel(b) { let a=a.level_with(p); rotate_to_distance(&b.level_with(p),p,&a.point(),(k-a.foot(k)).norm(),r)} else {rotate_to_plane(b,p,&a.direction(),k,r)};
 let l:Vec<Option<f64>> = match t2 {Values::Free=>vec![None],v=>v.iter().map(Some).collect()};
 for t in l { let c=b.rotate(t.unwrap_or(0.0),p); match rotate_to_point(a,&c,k,r){Values::Free=>out.0.push([None,t]),v=>for x in v.iter(){ if (a.rotate(x,&c)-k).norm()<1e-6 {out.0.push([Some(x),t])}}} }
 out}
