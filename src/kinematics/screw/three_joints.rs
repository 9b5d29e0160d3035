#![allow(missing_docs)]
use super::values::*; use crate::spatial::*; use nalgebra::*; use super::one_joint::*; use super::trigonometric::zeros;
pub fn three_screws_to_point(f:[&Screw;3],p:&Point3<f64>,k:&Point3<f64>,r:Reach)->Answers<3>{
 let mut out=Answers(Default::default());
 let (Some(a),Some(b),Some(c))=(f[0].axis(),f[1].axis(),f[2].axis()) else {return out};
 let w=b.direction(); let e1=Unit::new_normalize(w.cross(&Vector3::ith(w.iamin(),1.0))); let e2=w.cross(&e1);
 let flat=|x:&Vector3<f64>| Vector2::new(e1.dot(x),e2.dot(x));
 let w1=a.direction().into_inner(); let arm=a.point()-b.point();
 let (f1,f2)=(flat(&w1),flat(&arm));
 let Some(inv)=Matrix2::new(f1.x,f1.y,f2.x,f2.y).try_inverse() else {return out};
 let d=(k-a.point()).norm_squared();
 let at=|t:f64| { let y=c.rotate(t,p)-b.point(); let h=w.dot(&y);
   let b1=w1.dot(&(k-b.point()))-h*w.dot(&w1);
   let b2=(y.norm_squared()+arm.norm_squared()-d)/2.0-h*w.dot(&arm);
   (flat(&y),inv*Vector2::new(b1,b2)) };
 for t in zeros(2,|t|{let (u,v)=at(t); u.norm_squared()-v.norm_squared()}) { let (u,v)=at(t); let s=u.perp(&v).atan2(u.dot(&v));
  let x=b.rotate(s,&c.rotate(t,p)); for z in rotate_to_point(a,&x,k,r).iter() { out.0.push([Some(z),Some(s),Some(t)]); } }
 out}
