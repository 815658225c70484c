//! The structures by which the machine is moved: jogs, and segments with their answers. Records of
//! `glidepath-link`, as they are.

use super::structure::{Each, Field, InC, Structure, structure};
use glidepath_link::{JogDemand, LongText, Record, SegmentReply, SegmentRequest};

structure! {
    /// How the axes, or the joints, are to be moved by hand. The latest counts; the first client owns
    /// the axes until they are at rest.
    JOG: "gp_jog" = JogDemand, JogDemand::NAME, 136 {
        /// Who asks. Filled in.
        client: u64,
        /// Counts what the client asks for. Filled in.
        number: u64,
        /// When it was sent, ns of CLOCK_MONOTONIC. Filled in.
        sent_ns: u64,
        /// When it was asked for, by gp_now_ns. What was asked for before the machine was stopped moves nothing. Filled
        /// in where it is 0.
        asked_ns: u64,
        /// A GP_JOG_MODE_.
        mode: u32,
        /// The axes, or joints, that are meant, one bit each, X or J0 lowest.
        mask: u32,
        /// 1 if mask and value are about joints, 0 if about axes.
        by_joint: u32,
        /// Must be zero.
        reserved: u32,
        /// How fast at most, mm/s or degrees/s, in the modes that give no velocity; 0 for as fast as
        /// jogging may be.
        velocity_v: f64,
        /// What a count of a wheel is, mm or degrees.
        scale: f64,
        /// Velocities, mm/s or degrees/s (continuous); distances, mm or degrees (incremental); or
        /// counts of the wheel since it was switched on.
        value: Each<f64>,
    }
}

structure! {
    /// A piece of a stream. Fields that a kind does not use are zero.
    SEGMENT: "gp_segment" = SegmentRequest, SegmentRequest::NAME, 360 {
        /// The stream. Filled in.
        session: u64,
        /// Counts the pieces of a stream. Filled in.
        number: u64,
        /// Of GP_SEGMENT_OPEN: when the stream was asked for, by gp_now_ns. An abort after that, or the loss of power, ends
        /// the stream, also if its planner hangs until then. Filled in where it is 0.
        asked_ns: u64,
        /// A GP_SEGMENT_.
        kind: u32,
        /// Line of a program, from 1; 0 for GP_SEGMENT_OPEN and GP_SEGMENT_END.
        line: u32,
        /// Of a line, arc or curve: 1 if it is a rapid move, else 0.
        rapid: u32,
        /// Of a line, arc or curve: a GP_PATH_.
        mode: u32,
        /// Of an arc: a GP_PLANE_.
        plane: u32,
        /// Of an event: a GP_EVENT_ in the lowest byte; above it the number of an output, or a phase, or
        /// an axis in four bits and a depth in micrometres.
        event_kind: u32,
        /// The event's number (speed, tool, M code).
        event_value: f64,
        /// Of a line, arc or curve that is not rapid: feedrate, mm/s (degrees/s for rotary axes
        /// alone), > 0.
        feed_v: f64,
        /// Path tolerance, mm, > 0, with GP_PATH_CONTINUOUS_WITHIN.
        tolerance_mm: f64,
        /// Of a dwell: time, s, 0 or more.
        dwell_t: f64,
        /// Of an arc: signed sweep, radians, not 0.
        sweep_rad: f64,
        /// Of an arc: centre on the first and second axis of the plane, mm.
        center: [f64; 2],
        /// Where it starts: the end of the piece before, bit for bit.
        start: Each<f64>,
        /// Where it ends.
        end: Each<f64>,
        /// Of a curve: first derivative of X, Y, Z by path position, at its start, then at its end.
        tangents: [[f64; 3]; 2],
        /// Of a curve: second derivative likewise, 1/mm.
        bends: [[f64; 3]; 2],
        /// Of a curve: its length, mm, > 0.
        length: f64,
        /// Of a curve: how far it is from what it stands for, mm, 0 or more.
        error_mm: f64,
    }
}

structure! {
    /// The answer to a piece of a stream.
    SEGMENT_REPLY: "gp_segment_reply" = SegmentReply, SegmentReply::NAME, 1128 {
        /// The stream.
        session: u64,
        /// The number of the piece.
        number: u64,
        /// Pieces of the stream accepted so far: the number of the next one expected.
        accepted: u64,
        /// How many more would be accepted now.
        credit: u32,
        /// A GP_SEGMENT_REFUSAL_, 0 if the piece was accepted.
        refusal: u32,
        /// Where the next piece must start.
        position: Each<f64>,
        /// More about a refusal, for people.
        message: LongText,
    }
}
