//! The time parametrisation along a given path: path position by time, near the least time that all
//! limits allow.
//!
//! S-curves between junctions without acceleration are quick to make, but a curve whose curvature
//! changes all the time binds the speed everywhere, and there they lose a fifth of the time. This
//! parametrisation is optimised as a whole. Over time, or with v over s, acceleration would be a product
//! of unknowns. With b = v² as a function of path position s, every limit is linear in b and its
//! derivatives, but for the jerk:
//!
//! ```text
//!   speed          b ≤ cap(s)²                          s̈ = b′/2
//!   acceleration   |q′·b′/2 + q″·b| ≤ A                 s⃛ = ½·b″·√b
//!   jerk           |½·q′·b″ + 3/2·q″·b′ + q‴·b|·√b ≤ J
//! ```
//!
//! Units are millimetres (or degrees, where the feed is in them) and seconds: b is in mm²/s², b′ in
//! mm/s², b″ in 1/s². What the barrier sees is each limit's own share, but for the jerk, whose argument has a
//! unit that only shifts the value; the weight of the time is per second. So nothing has to be scaled.
//!
//! * **Discretisation.** b is a quadratic spline in s: speed and acceleration are continuous, b″ is
//!   constant on a span, and on each span ẍ = b′(x)/2 is a linear differential equation, solved by
//!   hyperbolic or circular functions. So the parametrisation is evaluated exactly, and what was
//!   checked on b holds for the motion ([`Parametrisation`]). Next to a rest, where b ~ s^(4/3), a
//!   short phase of constant jerk takes the place of the spline. Between the knots, where there are
//!   no constraints, the parametrisation is judged afterwards ([`between_knots`]).
//! * **Joints.** Where joints are not axes, every line is driven by it, from rest to rest, and the jerk that an
//!   interval leaves unused next to a rest counts at each corner. There s is the time of the S-curves
//!   ([`nominal`]), and rests need no phase of their own.
//! * **Optimisation.** Least Σ h/√b, which is the time, ∫ ds/v, and convex in b, with a logarithmic
//!   barrier for each limit, by Newton's method; each constraint of the problem touches three
//!   neighbouring coefficients, so a step costs a banded factorisation ([`barrier`]). Its initial
//!   iterate is the S-curves, slowed down, which keeps all limits with room to spare: no step ever leaves them.
//!
//! **The unknowns** are one coefficient of b for each interval between knots, the middle Bézier point of its
//! parabola, and one more at either end. Of these the first two and the last two are given: they are speed
//! and acceleration there. At a rest in nominal time the rate is unknown as well, and only its slope is given. A window of n intervals has n − 2 unknowns, and the least time is sought over
//! them alone: the path is not.
//!
//! **What if none is found.** The initial iterate has to keep the constraints with room to spare. If it does not, the
//! next slower one is tried, from rest to rest down to .4 of the S-curves' speed, elsewhere only .85. If no
//! rate will do, or what comes out still demands too much between knots after eight times, there is no
//! parametrisation. The window is then parted, left later, or driven by S-curves
//! ([`crate::on_path::refining`]): time is lost, no limit is.
//!
//! Where a parametrisation takes the place of S-curves, [`crate::on_path::refining`] decides.

mod barrier;
mod between_knots;
mod constraints;
mod initial;
mod interval;
mod knot_times;
mod knots;
mod least_time;
mod nominal;
mod parabola;
mod parametrisation;
mod solver_tolerances;

pub(crate) use between_knots::keeps_limits;
pub(crate) use knots::KnotPath;
pub(crate) use least_time::optimise;
pub(crate) use parametrisation::Parametrisation;
pub(crate) use solver_tolerances::SolverTolerances;
