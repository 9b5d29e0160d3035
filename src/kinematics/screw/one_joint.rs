#![allow(missing_docs)]
use super::values::*; use crate::spatial::*; use nalgebra::*; use super::paden_kahan as pk; use super::trigonometric::zeros;
fn v(a: pk::Angles)->Values{ match a { pk::Angles::None=>Values::None, pk::Angles::One(x)=>Values::One(x), pk::Angles::Two(x,y)=>Values::Two(x,y), pk::Angles::Free=>Values::Free } }
pub fn rotate_to_point(a:&Axis,p:&Point3<f64>,k:&Point3<f64>,_r:Reach)->Values{
  let w=a.direction(); let u=p-a.point(); let y=k-a.point(); let (u,y)=(u-w.scale(w.dot(&u)),y-w.scale(w.dot(&y)));
  if u.norm()<1e-12 && y.norm()<1e-12 {return Values::Free}
  if (p-a.point()).norm()-(k-a.point()).norm()>1e-7 {return Values::None}
  Values::One(w.dot(&u.cross(&y)).atan2(u.dot(&y)))}
pub fn rotate_to_distance(a:&Axis,p:&Point3<f64>,k:&Point3<f64>,d:f64,_r:Reach)->Values{v(pk::rotate_to_distance(a,p,k,d))}
pub fn rotate_to_plane(a:&Axis,p:&Point3<f64>,n:&Unit<Vector3<f64>>,k:&Point3<f64>,_r:Reach)->Values{
  let f=|t:f64| n.dot(&(a.rotate(t,p)-k));
  if f(0.3).abs().max(f(1.9).abs()).max(f(-1.7).abs())<1e-12 {return Values::Free}
  let z=zeros(1,f); match z[..]{[]=>Values::None,[x]=>Values::One(x),[x,y,..]=>Values::Two(x,y)}}
pub fn translate_to_point(a:&Unit<Vector3<f64>>,p:&Point3<f64>,k:&Point3<f64>,_r:Reach)->Values{Values::One(a.dot(&(k-p)))}
pub fn translate_to_distance(a:&Unit<Vector3<f64>>,p:&Point3<f64>,k:&Point3<f64>,d:f64,_r:Reach)->Values{
 let h=a.dot(&(k-p)); let s=d*d-(p-k).norm_squared()+h*h; if s<0.0 {return Values::None} let s=s.sqrt(); Values::Two(h+s,h-s)}
pub fn translate_to_plane(a:&Unit<Vector3<f64>>,p:&Point3<f64>,n:&Unit<Vector3<f64>>,k:&Point3<f64>,_r:Reach)->Values{
 let d=n.dot(a); if d.abs()<1e-12 {return Values::Free} Values::One(n.dot(&(k-p))/d)}
