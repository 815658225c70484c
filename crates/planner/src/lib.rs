//! The planner process: input to setpoint frames.
