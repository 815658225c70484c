//! The interpolator process: frames to setpoints, one per period.
