//! The raw configuration file, as it is written, before any value is judged.
//!
//! Every value keeps its place in the text, so that a later stage can point at it.

use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A value that may be left out, with its place.
pub(super) type Optional<T> = Option<Spanned<T>>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawConfig {
    #[serde(default)]
    pub(super) machine: RawMachine,
    pub(super) axis: Spanned<RawAxes>,
    #[serde(default)]
    pub(super) joint: BTreeMap<Spanned<String>, Spanned<RawJoint>>,
    #[serde(default)]
    pub(super) home: BTreeMap<Spanned<String>, Spanned<RawHome>>,
    #[serde(default)]
    pub(super) compensation: BTreeMap<Spanned<String>, Spanned<RawCompensation>>,
    #[serde(default)]
    pub(super) squareness: RawSquareness,
    #[serde(default)]
    pub(super) straightness: BTreeMap<Spanned<String>, Spanned<RawStraightness>>,
    #[serde(default)]
    pub(super) path: RawPath,
    #[serde(default)]
    pub(super) interpolator: RawInterpolator,
    #[serde(default)]
    pub(super) jog: RawJog,
    #[serde(default)]
    pub(super) feedback: RawFeedback,
    #[serde(default)]
    pub(super) probe: RawProbe,
    #[serde(default)]
    pub(super) spindle: RawSpindle,
    #[serde(default)]
    pub(super) adaptive_feed: RawAdaptiveFeed,
    #[serde(default)]
    pub(super) superposition: RawSuperposition,
    #[serde(default)]
    pub(super) link: RawLink,
    #[serde(default)]
    pub(super) preview: RawPreview,
    #[serde(default)]
    pub(super) program: RawProgram,
    #[serde(default)]
    pub(super) m_codes: BTreeMap<Spanned<String>, Spanned<RawMCode>>,
    #[serde(default)]
    pub(super) stops: RawStops,
    #[serde(default)]
    pub(super) state: RawState,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawState {
    pub(super) directory: Optional<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawMCode {
    pub(super) done: Optional<String>,
    pub(super) at: Optional<String>,
    pub(super) timeout_s: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawProgram {
    pub(super) dialect: Optional<String>,
    pub(super) fanuc: Optional<String>,
    pub(super) units: Optional<String>,
    pub(super) point: Optional<String>,
    pub(super) offset_memory: Optional<String>,
    pub(super) arctangent: Optional<String>,
    pub(super) bore_shift: Optional<String>,
    pub(super) outer_corners: Optional<String>,
    pub(super) rotation_start: Optional<String>,
    pub(super) roll_over: Optional<String>,
    pub(super) rotation: Optional<String>,
    pub(super) lathe_feed: Optional<String>,
    pub(super) unwind: Optional<String>,
    pub(super) tool_change: Optional<String>,
    pub(super) edge_after_change: Optional<String>,
    pub(super) d_numbers: Optional<String>,
    pub(super) lathe_x: Optional<String>,
    pub(super) increment_after_frame: Optional<String>,
    pub(super) increment_after_length: Optional<String>,
    pub(super) h_words: Optional<String>,
    pub(super) swivel_z: Optional<f64>,
    pub(super) swivel_x: Optional<f64>,
    pub(super) swivel_y: Optional<f64>,
    pub(super) tool_table: Optional<String>,
    pub(super) subroutine_path: Vec<String>,
    pub(super) inputs_outputs: Optional<String>,
    pub(super) extruder: Optional<String>,
    pub(super) firmware: Optional<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "UPPERCASE")]
pub(super) struct RawAxes {
    x: Optional<RawAxis>,
    y: Optional<RawAxis>,
    z: Optional<RawAxis>,
    a: Optional<RawAxis>,
    b: Optional<RawAxis>,
    c: Optional<RawAxis>,
    u: Optional<RawAxis>,
    v: Optional<RawAxis>,
    w: Optional<RawAxis>,
}

impl RawAxes {
    /// The tables in the order of `glidepath_geometry::Axis::ALL`.
    pub(super) fn in_order(self) -> [Optional<RawAxis>; glidepath_geometry::AXES] {
        [
            self.x, self.y, self.z, self.a, self.b, self.c, self.u, self.v, self.w,
        ]
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAxis {
    pub(super) min_position: Optional<f64>,
    pub(super) max_position: Optional<f64>,
    pub(super) max_velocity: Optional<f64>,
    pub(super) max_acceleration: Optional<f64>,
    pub(super) max_jerk: Optional<f64>,
    pub(super) jog_velocity: Optional<f64>,
    pub(super) gantry_difference: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawPath {
    pub(super) tolerance: Optional<f64>,
    pub(super) direction_tolerance: Optional<f64>,
    pub(super) smoothing: Optional<String>,
    pub(super) corners: Optional<String>,
    pub(super) effort: Optional<String>,
    pub(super) default_feed: Optional<f64>,
    pub(super) max_tangential_acceleration: Optional<f64>,
    pub(super) max_normal_acceleration: Optional<f64>,
    pub(super) max_jerk: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawInterpolator {
    pub(super) period_us: Optional<i64>,
    pub(super) priority: Optional<i64>,
    pub(super) cpu: Optional<i64>,
    pub(super) horizon_s: Optional<f64>,
    pub(super) max_missed_ticks: Optional<i64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawJog {
    pub(super) velocity: Optional<f64>,
    pub(super) unhomed_velocity: Optional<f64>,
    pub(super) return_velocity: Optional<f64>,
    pub(super) increments: Optional<Vec<f64>>,
    pub(super) dead_man_ms: Optional<i64>,
    pub(super) tool_axis: Optional<String>,
    pub(super) lift: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawFeedback {
    pub(super) source: Optional<String>,
    pub(super) homing: Optional<String>,
    pub(super) following_error: Optional<f64>,
    pub(super) min_following_error: Optional<f64>,
    pub(super) stale_s: Optional<f64>,
    pub(super) off_s: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawStops {
    pub(super) abort: Optional<bool>,
    pub(super) fault: Optional<bool>,
    pub(super) disable: Optional<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawProbe {
    pub(super) input: Optional<i64>,
    pub(super) contact: Optional<String>,
    pub(super) overtravel: Optional<f64>,
    pub(super) protect: Optional<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawSpindle {
    pub(super) encoder: Optional<bool>,
    pub(super) orientation: Optional<bool>,
    pub(super) override_min: Optional<f64>,
    pub(super) override_max: Optional<f64>,
    pub(super) gear_max: Optional<Vec<f64>>,
    pub(super) gear_min: Optional<Vec<f64>>,
    pub(super) gear_choice: Optional<String>,
    pub(super) axis: Optional<String>,
    pub(super) rigid_tapping: Optional<bool>,
    pub(super) acceleration: Optional<f64>,
    pub(super) overtravel: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawAdaptiveFeed {
    pub(super) input: Optional<i64>,
    pub(super) at_zero: Optional<f64>,
    pub(super) at_full: Optional<f64>,
    pub(super) always: Optional<bool>,
    pub(super) backwards: Optional<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawSuperposition {
    pub(super) axis: Optional<String>,
    pub(super) by: Optional<String>,
    pub(super) share: Optional<f64>,
    pub(super) lowest: Optional<f64>,
    pub(super) highest: Optional<f64>,
    pub(super) input: Optional<i64>,
    pub(super) sets: Optional<String>,
    pub(super) target: Optional<f64>,
    pub(super) gain: Optional<f64>,
    pub(super) dead_band: Optional<f64>,
    pub(super) switched_by: Optional<i64>,
    pub(super) enabled_by: Optional<i64>,
    pub(super) enabled_at: Optional<String>,
    pub(super) freeze_below: Optional<f64>,
    pub(super) freeze_for: Optional<f64>,
    pub(super) off: Optional<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawHome {
    pub(super) search_velocity: Optional<f64>,
    pub(super) latch_velocity: Optional<f64>,
    pub(super) final_velocity: Optional<f64>,
    pub(super) index_input: Optional<i64>,
    pub(super) index: Optional<String>,
    pub(super) offset: Optional<f64>,
    pub(super) position: Optional<f64>,
    pub(super) absolute: Optional<String>,
    pub(super) sequence: Optional<i64>,
    pub(super) shared: bool,
    pub(super) volatile: bool,
    pub(super) ignore_limits: bool,
    pub(super) search_travel: Optional<f64>,
    pub(super) clearance: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawCompensation {
    pub(super) backlash: Optional<f64>,
    pub(super) positions: Optional<Vec<f64>>,
    pub(super) corrections: Optional<Vec<f64>>,
    pub(super) corrections_down: Optional<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "UPPERCASE")]
pub(super) struct RawSquareness {
    pub(super) xy: Optional<f64>,
    pub(super) xz: Optional<f64>,
    pub(super) yz: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawStraightness {
    pub(super) positions: Optional<Vec<f64>>,
    pub(super) corrections: Optional<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawLink {
    pub(super) instance: Optional<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawPreview {
    pub(super) growth: Optional<f64>,
    pub(super) max_growth: Optional<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "kebab-case")]
pub(super) struct RawMachine {
    pub(super) kinematics: Optional<String>,
    pub(super) hexapod: Optional<RawHexapod>,
    pub(super) translational_hexapod: Optional<RawTranslational>,
    pub(super) linear_delta: Optional<RawLinearDelta>,
    pub(super) rotary_delta: Optional<RawRotaryDelta>,
    pub(super) scara: Optional<RawScara>,
    pub(super) five_bar: Optional<RawFiveBar>,
    pub(super) five_axis: Optional<RawFiveAxis>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawHexapod {
    pub(super) base_radius: Spanned<f64>,
    pub(super) platform_radius: Spanned<f64>,
    pub(super) half_angle: Spanned<f64>,
    pub(super) base_z: Optional<f64>,
    pub(super) tool: Optional<[f64; 3]>,
    pub(super) max_base_angle: Optional<f64>,
    pub(super) max_platform_angle: Optional<f64>,
    pub(super) min_strut_distance: Optional<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawTranslational {
    pub(super) radius_difference: Spanned<f64>,
    pub(super) base_z: Optional<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawLinearDelta {
    pub(super) rod: Spanned<f64>,
    pub(super) radius: Spanned<f64>,
    pub(super) tower_angles: Optional<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawRotaryDelta {
    pub(super) base_radius: Spanned<f64>,
    pub(super) platform_radius: Spanned<f64>,
    pub(super) upper_arm: Spanned<f64>,
    pub(super) forearm: Spanned<f64>,
    pub(super) arm_angles: Optional<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawScara {
    pub(super) upper_arm: Spanned<f64>,
    pub(super) forearm: Spanned<f64>,
    pub(super) tool: Optional<f64>,
    pub(super) height: Optional<f64>,
    pub(super) elbow: Optional<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFiveBar {
    pub(super) shoulder_distance: Spanned<f64>,
    pub(super) upper_arm: Spanned<f64>,
    pub(super) forearm: Spanned<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFiveAxis {
    pub(super) layout: Spanned<String>,
    pub(super) tilt: Spanned<String>,
    pub(super) tilt_direction: Optional<[f64; 3]>,
    #[serde(default)]
    pub(super) tilt_reversed: bool,
    #[serde(default)]
    pub(super) rotary_reversed: bool,
    pub(super) tool: Spanned<f64>,
    pub(super) tilt_point: Optional<[f64; 3]>,
    pub(super) rotary_point: Optional<[f64; 3]>,
    pub(super) rotary_to_tilt: Optional<[f64; 3]>,
    pub(super) tilt_to_spindle: Optional<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawJoint {
    pub(super) min_position: Optional<f64>,
    pub(super) max_position: Optional<f64>,
    pub(super) max_velocity: Spanned<f64>,
    pub(super) max_acceleration: Spanned<f64>,
    pub(super) max_jerk: Spanned<f64>,
}
