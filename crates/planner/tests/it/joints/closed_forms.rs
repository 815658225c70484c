//! Where joints are, by closed forms of their own: nothing of what the planner asks is asked here.

use glidepath_geometry::AxisVector;
use glidepath_kinematics::{
    Elbow, FiveAxis, FiveBar, Hexapod, LinearDelta, Mechanism, Rotaries, RotaryDelta, Scara, Tilt,
    TranslationalHexapod,
};
use nalgebra::{Rotation3, Unit, Vector2, Vector3};

/// The joints at a position of the axes, J0 first, mm or degrees; not a number out of reach.
pub(crate) fn joints(mechanism: &Mechanism, axes: &AxisVector) -> Vec<f64> {
    let tip = Vector3::new(axes[0], axes[1], axes[2]);
    match mechanism {
        Mechanism::Trivial(_) => axes.iter().copied().collect(),
        Mechanism::CoreXy(_) => vec![tip.x + tip.y, tip.x - tip.y, tip.z],
        Mechanism::LinearDelta(delta) => carriages(delta, &tip),
        Mechanism::RotaryDelta(delta) => swung(delta, &tip),
        Mechanism::Scara(arm) => scara(arm, &tip, axes[5]),
        Mechanism::FiveBar(bars) => five_bar(bars, &tip),
        Mechanism::FiveAxis(machine) => five_axis(machine, &tip, axes),
        Mechanism::Hexapod(hexapod) => struts(hexapod, &tip, axes),
        Mechanism::Translational(hexapod) => parallel_struts(hexapod, &tip),
    }
}

/// A unit vector in the plane.
fn towards(degrees: f64) -> Vector2<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vector2::new(cos, sin)
}

/// The angle of a triangle between its sides a and b, opposite of c, radians.
fn angle(a: f64, b: f64, c: f64) -> f64 {
    // By halves: exact where the triangle is flat.
    let half = 0.5 * (a + b + c);
    2.0 * ((half - a) * (half - b))
        .sqrt()
        .atan2((half * (half - c)).sqrt())
}

fn carriages(delta: &LinearDelta, tip: &Vector3<f64>) -> Vec<f64> {
    let above = |tower: &f64| {
        let aside = (tip.xy() - towards(*tower) * delta.radius_mm).norm();
        tip.z + ((delta.rod_mm - aside) * (delta.rod_mm + aside)).sqrt()
    };
    delta.tower_deg.iter().map(above).collect()
}

/// In the plane of an arm the forearm is seen shorter, and the triangle of pivot, knee and platform is known.
fn swung(delta: &RotaryDelta, tip: &Vector3<f64>) -> Vec<f64> {
    let of_arm = |direction: &f64| {
        let out = towards(*direction);
        let across = out.perp(&tip.xy());
        let u = out.dot(&tip.xy()) + delta.platform_radius_mm - delta.base_radius_mm;
        let seen = ((delta.forearm_mm - across) * (delta.forearm_mm + across)).sqrt();
        let to_platform = u.hypot(tip.z);
        let below = (-tip.z).atan2(u);
        let bend = angle(to_platform, delta.upper_arm_mm, seen);
        // The knee points outwards.
        let (one, other) = (below - bend, below + bend);
        if other.cos() > one.cos() { other } else { one }.to_degrees()
    };
    delta.arm_deg.iter().map(of_arm).collect()
}

fn scara(arm: &Scara, tip: &Vector3<f64>, heading_deg: f64) -> Vec<f64> {
    let wrist = tip.xy() - towards(heading_deg) * arm.tool_mm;
    let (a, b, reach) = (arm.upper_arm_mm, arm.forearm_mm, wrist.norm());
    let side = match arm.elbow {
        Elbow::Positive => 1.0,
        Elbow::Negative => -1.0,
    };
    let elbow = side * (core::f64::consts::PI - angle(a, b, reach)).to_degrees();
    let before = wrist.y.atan2(wrist.x) - side * angle(a, reach, b);
    let shoulder = before.sin().atan2(before.cos()).to_degrees();
    vec![
        shoulder,
        elbow,
        arm.height_mm - tip.z,
        heading_deg - shoulder - elbow,
    ]
}

fn five_bar(bars: &FiveBar, tip: &Vector3<f64>) -> Vec<f64> {
    let arm = |side: f64| {
        let shoulder = Vector2::new(0.5 * side * bars.shoulder_distance_mm, 0.0);
        let to_tool = tip.xy() - shoulder;
        let bend = angle(bars.upper_arm_mm, to_tool.norm(), bars.forearm_mm);
        (to_tool.y.atan2(to_tool.x) - side * bend).to_degrees()
    };
    vec![arm(-1.0), arm(1.0), tip.z]
}

fn five_axis(machine: &FiveAxis, tip: &Vector3<f64>, axes: &AxisVector) -> Vec<f64> {
    let (about, tilt_deg) = match machine.tilt {
        Tilt::A => (Vector3::x_axis(), axes[3]),
        Tilt::B => (Vector3::y_axis(), axes[4]),
        Tilt::Skewed(skewed) => (
            Unit::new_normalize(*skewed.direction()),
            axes[machine.tilt_axis().index()],
        ),
    };
    let sign = |reversed: bool| if reversed { -1.0 } else { 1.0 };
    let tilt = sign(machine.tilt_reversed) * tilt_deg.to_radians();
    let turn = sign(machine.rotary_reversed) * axes[5].to_radians();
    let tilt = Rotation3::from_axis_angle(&about, tilt);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn);
    let tool = Vector3::new(0.0, 0.0, machine.tool_mm);
    let linear = match &machine.rotaries {
        Rotaries::TableTable {
            tilt_point: a,
            rotary_point: c,
        } => a + tilt * (c - a + turn * (tip - c)) + tool,
        Rotaries::HeadHead {
            rotary_to_tilt: d,
            tilt_to_spindle: e,
        } => tip - turn * (d + tilt * (e - tool)) + d + e - tool,
        Rotaries::TableHead { rotary_point: c } => c + turn * (tip - c) + tilt * tool - tool,
    };
    vec![linear.x, linear.y, linear.z, tilt_deg, axes[5]]
}

fn struts(hexapod: &Hexapod, tip: &Vector3<f64>, axes: &AxisVector) -> Vec<f64> {
    let [a, b, c] = [3, 4, 5].map(|k| axes[k].to_radians());
    let turn = Rotation3::from_euler_angles(a, b, c);
    let both = hexapod.platform.iter().zip(&hexapod.base);
    both.map(|(on_platform, on_base)| (tip + turn * (on_platform - hexapod.tool) - on_base).norm())
        .collect()
}

fn parallel_struts(hexapod: &TranslationalHexapod, tip: &Vector3<f64>) -> Vec<f64> {
    let strut = |k: u8| {
        let foot = towards(60.0 * f64::from(k)) * hexapod.radius_difference_mm;
        let foot = Vector3::new(foot.x, foot.y, hexapod.base_z_mm);
        (tip - foot).norm()
    };
    (0..6).map(strut).collect()
}
