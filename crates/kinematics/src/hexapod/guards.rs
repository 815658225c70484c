//! The restrictions that the build of a hexapod puts on its poses.

/// The restrictions that the build of a hexapod puts on its poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guards {
    /// Largest angle between a strut and the normal of the base, degrees.
    pub max_base_angle_deg: f64,
    /// Largest angle between a strut and the normal of the platform, degrees.
    pub max_platform_angle_deg: f64,
    /// Smallest distance of the centre lines of two struts, mm.
    pub min_strut_distance_mm: f64,
}

impl Guards {
    /// Nothing but singularities is forbidden.
    pub const NONE: Self = Self {
        max_base_angle_deg: 180.0,
        max_platform_angle_deg: 180.0,
        min_strut_distance_mm: 0.0,
    };
}
