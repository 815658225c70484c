//! The record of one piece of a streamed program, from another program to a listening planner, in
//! program order.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{Record, event};
use glidepath_geometry::{AXES, Arc, AxisVector, Plane, Quintic, Segment};
use glidepath_program::{Item, ItemKind, PathMode, Rate};
use iceoryx2::prelude::ZeroCopySend;

coded! {
    /// The kind of a request: what it carries.
    pub enum RequestKind {
        /// Start of a stream.
        Open = 1,
        /// A straight move.
        Line = 2,
        /// An arc.
        Arc = 3,
        /// A dwell.
        Dwell = 4,
        /// An event.
        Event = 5,
        /// End of the stream.
        End = 6,
        /// A piece of a smooth curve.
        Curve = 7,
    }
}

coded! {
    /// Planes on the wire.
    pub enum PlaneCode {
        /// G17.
        Xy = 1,
        /// G18.
        Zx = 2,
        /// G19.
        Yz = 3,
        /// G17.1.
        Uv = 4,
        /// G18.1.
        Wu = 5,
        /// G19.1.
        Vw = 6,
    }
}

coded! {
    /// Path modes on the wire.
    pub enum ModeCode {
        /// G61.1.
        ExactStop = 1,
        /// G61.
        ExactPath = 2,
        /// G64 with the configured tolerance.
        Continuous = 3,
        /// G64 with its own tolerance.
        ContinuousWithin = 4,
    }
}

/// An item that a client streams: one request each.
#[allow(
    clippy::large_enum_variant,
    reason = "nearly every value of a stream is the large one"
)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StreamItem {
    /// Start of a stream. The reply tells where the machine stands: the first segment starts there.
    Open {
        /// When the client asked for it, ns of the host's steady clock; 0 if it does not say. A stop of the machine after
        /// that counts for the stream.
        asked_ns: u64,
    },
    /// A move, a dwell or an event.
    Item(Item),
    /// End of the stream: the machine comes to rest at the end of what was sent.
    End,
}

/// The record of one piece of a stream. Fields a kind does not use are zero.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.SegmentRequest.v3")]
pub struct SegmentRequest {
    /// Chosen by the client at random, the same for all of a stream.
    pub session: u64,
    /// Counts the requests of a stream from 0 (its `Open`), without gaps.
    pub number: u64,
    /// For open: when the client asked for the stream, ns of `CLOCK_MONOTONIC`; 0 if it does not say.
    pub asked_ns: u64,
    /// What this is: 1 open, 2 line, 3 arc, 4 dwell, 5 event, 6 end, 7 curve.
    pub kind: u32,
    /// Source line, from 1; 0 for open and end.
    pub line: u32,
    /// For a line or arc: 1 if it is a rapid move, else 0.
    pub rapid: u32,
    /// For a line or arc: 1 exact stop, 2 exact path, 3 continuous, 4 continuous within
    /// `tolerance_mm`.
    pub mode: u32,
    /// For an arc: 1 XY, 2 ZX, 3 YZ, 4 UV, 5 WU, 6 VW.
    pub plane: u32,
    /// For an event: the code of an [`super::EventKind`] in the lowest byte; above it the number of an
    /// output, or the phase, or the axis in four bits and the depth in µm.
    pub event_kind: u32,
    /// The event's number (speed, tool, M code).
    pub event_value: f64,
    /// For a line or arc that is not rapid: feedrate, mm/s (°/s for rotary axes alone), > 0.
    pub feed_v: f64,
    /// Path tolerance, mm, > 0, with mode 4.
    pub tolerance_mm: f64,
    /// For a dwell: time, s, ≥ 0.
    pub dwell_t: f64,
    /// For an arc: signed sweep, radians, not 0.
    pub sweep_rad: f64,
    /// For an arc: centre on the first and second axis of the plane, mm.
    pub center: [f64; 2],
    /// Start of a line or arc: the end of the one before, bit for bit.
    pub start: [f64; AXES],
    /// End of a line or arc.
    pub end: [f64; AXES],
    /// For a curve: first derivative of X, Y, Z by path position, at start and end.
    pub tangents: [[f64; 3]; 2],
    /// For a curve: second derivative, 1/mm.
    pub bends: [[f64; 3]; 2],
    /// For a curve: its length, mm, > 0.
    pub length: f64,
    /// For a curve: how far it is from what it stands for, mm, ≥ 0.
    pub error_mm: f64,
}

impl SegmentRequest {
    /// The record of one piece of a stream.
    #[must_use]
    pub fn new(session: u64, number: u64, item: &StreamItem) -> Self {
        let mut record = Self {
            session,
            number,
            ..bytemuck::Zeroable::zeroed()
        };
        match item {
            StreamItem::Open { asked_ns } => {
                record.kind = RequestKind::Open.code();
                record.asked_ns = *asked_ns;
            }
            StreamItem::End => record.kind = RequestKind::End.code(),
            StreamItem::Item(item) => {
                record.line = item.line;
                match item.kind {
                    ItemKind::Move {
                        segment,
                        rate,
                        mode,
                    } => {
                        record.set_segment(&segment);
                        record.set_rate(rate);
                        record.set_mode(mode);
                    }
                    ItemKind::Dwell(dwell_t) => {
                        record.kind = RequestKind::Dwell.code();
                        record.dwell_t = dwell_t;
                    }
                    ItemKind::Event(of) => {
                        record.kind = RequestKind::Event.code();
                        (record.event_kind, record.event_value) = event::encode(Some(of));
                    }
                }
            }
        }
        record
    }

    fn set_segment(&mut self, segment: &Segment) {
        self.start = segment.start().into();
        self.end = segment.end().into();
        match segment {
            Segment::Line(_) => self.kind = RequestKind::Line.code(),
            Segment::Arc(arc) => {
                self.kind = RequestKind::Arc.code();
                self.plane = plane_code(arc.plane).code();
                self.center = arc.center;
                self.sweep_rad = arc.sweep_rad;
            }
            Segment::Curve(curve) => {
                self.kind = RequestKind::Curve.code();
                self.tangents = curve.tangents.map(Into::into);
                self.bends = curve.bends.map(Into::into);
                (self.length, self.error_mm) = (curve.length, curve.error_mm);
            }
        }
    }

    fn set_rate(&mut self, rate: Rate) {
        // The planner that receives it knows by itself what its joints can do.
        match rate.feed_v() {
            None => self.rapid = 1,
            Some(feed_v) => self.feed_v = feed_v,
        }
    }

    fn set_mode(&mut self, mode: PathMode) {
        let code = match mode {
            PathMode::ExactStop => ModeCode::ExactStop,
            PathMode::ExactPath => ModeCode::ExactPath,
            PathMode::Continuous { tolerance_mm: None } => ModeCode::Continuous,
            PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => {
                self.tolerance_mm = tolerance_mm;
                ModeCode::ContinuousWithin
            }
        };
        self.mode = code.code();
    }

    /// The item of the request.
    ///
    /// # Errors
    ///
    /// The first field that is unknown, not finite, or out of range.
    pub fn item(&self) -> Result<StreamItem, RecordError> {
        let fields = Fields(Self::NAME);
        self.check_finite(fields)?;
        let kind = match fields.code("kind", self.kind)? {
            RequestKind::Open => {
                let asked_ns = self.asked_ns;
                return Ok(StreamItem::Open { asked_ns });
            }
            RequestKind::End => return Ok(StreamItem::End),
            RequestKind::Line => {
                let (start, end) = (AxisVector::from(self.start), AxisVector::from(self.end));
                self.motion(Segment::line(start, end))?
            }
            RequestKind::Arc => self.motion(Segment::Arc(self.arc()?))?,
            RequestKind::Curve => self.motion(Segment::Curve(self.curve()?))?,
            RequestKind::Dwell => {
                fields.range("dwell_t", self.dwell_t, 0.0, f64::MAX)?;
                ItemKind::Dwell(self.dwell_t)
            }
            RequestKind::Event => {
                match event::decode(Self::NAME, self.event_kind, self.event_value)? {
                    Some(event) => ItemKind::Event(event),
                    None => {
                        let (record, field) = (Self::NAME, "event_kind");
                        return Err(RecordError::UnknownCode {
                            record,
                            field,
                            code: 0,
                        });
                    }
                }
            }
        };
        Ok(StreamItem::Item(Item {
            line: self.line,
            block: 0,
            kind,
        }))
    }

    fn check_finite(&self, fields: Fields) -> Result<(), RecordError> {
        fields.all_finite("start", &self.start)?;
        fields.all_finite("end", &self.end)?;
        fields.all_finite("center", &self.center)?;
        fields.all_finite("tangents", self.tangents.as_flattened())?;
        fields.all_finite("bends", self.bends.as_flattened())?;
        fields.finite("length", self.length)?;
        fields.finite("error_mm", self.error_mm)?;
        fields.finite("sweep_rad", self.sweep_rad)?;
        fields.finite("event_value", self.event_value)?;
        fields.finite("feed_v", self.feed_v)?;
        fields.finite("tolerance_mm", self.tolerance_mm)?;
        fields.finite("dwell_t", self.dwell_t)
    }

    fn motion(&self, segment: Segment) -> Result<ItemKind, RecordError> {
        let fields = Fields(Self::NAME);
        let rate = match self.rapid {
            1 => Rate::Rapid,
            0 => {
                fields.range("feed_v", self.feed_v, f64::MIN_POSITIVE, f64::MAX)?;
                Rate::Feed(self.feed_v)
            }
            code => {
                let (record, field) = (Self::NAME, "rapid");
                return Err(RecordError::UnknownCode {
                    record,
                    field,
                    code,
                });
            }
        };
        let mode = match fields.code("mode", self.mode)? {
            ModeCode::ExactStop => PathMode::ExactStop,
            ModeCode::ExactPath => PathMode::ExactPath,
            ModeCode::Continuous => PathMode::Continuous { tolerance_mm: None },
            ModeCode::ContinuousWithin => {
                fields.range(
                    "tolerance_mm",
                    self.tolerance_mm,
                    f64::MIN_POSITIVE,
                    f64::MAX,
                )?;
                PathMode::Continuous {
                    tolerance_mm: Some(self.tolerance_mm),
                }
            }
        };
        Ok(ItemKind::Move {
            segment,
            rate,
            mode,
        })
    }

    fn arc(&self) -> Result<Arc, RecordError> {
        let fields = Fields(Self::NAME);
        fields.range(
            "sweep_rad",
            self.sweep_rad.abs(),
            f64::MIN_POSITIVE,
            f64::MAX,
        )?;
        Ok(Arc {
            start: AxisVector::from(self.start),
            end: AxisVector::from(self.end),
            plane: plane_of(fields.code("plane", self.plane)?),
            center: self.center,
            sweep_rad: self.sweep_rad,
        })
    }

    fn curve(&self) -> Result<Quintic, RecordError> {
        let fields = Fields(Self::NAME);
        fields.range("length", self.length, f64::MIN_POSITIVE, f64::MAX)?;
        fields.range("error_mm", self.error_mm, 0.0, f64::MAX)?;
        Ok(Quintic {
            start: AxisVector::from(self.start),
            end: AxisVector::from(self.end),
            tangents: self.tangents.map(Into::into),
            bends: self.bends.map(Into::into),
            length: self.length,
            error_mm: self.error_mm,
        })
    }
}

const fn plane_code(plane: Plane) -> PlaneCode {
    match plane {
        Plane::Xy => PlaneCode::Xy,
        Plane::Zx => PlaneCode::Zx,
        Plane::Yz => PlaneCode::Yz,
        Plane::Uv => PlaneCode::Uv,
        Plane::Wu => PlaneCode::Wu,
        Plane::Vw => PlaneCode::Vw,
    }
}

const fn plane_of(code: PlaneCode) -> Plane {
    match code {
        PlaneCode::Xy => Plane::Xy,
        PlaneCode::Zx => Plane::Zx,
        PlaneCode::Yz => Plane::Yz,
        PlaneCode::Uv => Plane::Uv,
        PlaneCode::Wu => Plane::Wu,
        PlaneCode::Vw => Plane::Vw,
    }
}

impl Record for SegmentRequest {
    const NAME: &'static str = "glidepath.SegmentRequest.v3";

    fn check(&self) -> Result<(), RecordError> {
        self.item().map(|_| ())
    }
}
