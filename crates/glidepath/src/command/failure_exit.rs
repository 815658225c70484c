//! The exit code of every failure.

use super::failure::Failure;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::jitter::{CyclictestError, JitterError};
use crate::persistence::error::StateError;
use glidepath_ethercat as ethercat;
use glidepath_hal::HalError;
use glidepath_interpolator as interpolator;
use glidepath_link::SegmentRefusal;
use glidepath_link::mirror::MirrorError;
use glidepath_planner::{self as planner, FeedError, Refusal};

impl Failure {
    /// The exit code.
    #[must_use]
    #[allow(clippy::too_many_lines, reason = "a line for each failure")]
    pub(super) const fn exit(&self) -> Exit {
        match self {
            Self::NoFeedback
            | Self::Stale { .. }
            | Self::Configuration(_)
            | Self::HalConfiguration { .. }
            | Self::Hal(HalError::Joints { .. })
            | Self::State(
                StateError::Damaged(_)
                | StateError::Lost { .. }
                | StateError::Gone { .. }
                | StateError::OtherMachine { .. }
                | StateError::NoFolder,
            ) => Exit::Configuration,
            Self::Unchecked { .. }
            | Self::Refused(Refusal::Unchecked { .. })
            | Self::Planner(planner::RunError::Refused(Refusal::Unchecked { .. }))
            | Self::Feed(FeedError::Refused(Refusal::Unchecked { .. })) => Exit::Unchecked,
            Self::ResumePipe
            | Self::Unanswered { .. }
            | Self::File(FileError::Open { .. } | FileError::Guarded { .. })
            | Self::Catalogue(_)
            | Self::UnknownKey { .. }
            | Self::Wire(_)
            | Self::NotEmulated(_)
            | Self::Mirror(MirrorError::Root { .. })
            | Self::Word(..)
            | Self::NoDevice { .. }
            | Self::Inputs { .. }
            | Self::Var { .. }
            | Self::Foreign { .. }
            | Self::NoFeed
            | Self::UnknownDimension { .. }
            | Self::NotOneCurve { .. }
            | Self::UnknownEvent(_)
            | Self::Jitter(JitterError::Cyclictest(CyclictestError::Absent)) => Exit::Usage,
            // What the machine or its operator ended is no fault of the program.
            Self::Feed(FeedError::RefusedByPlanner {
                refusal:
                    SegmentRefusal::Stopped
                    | SegmentRefusal::Aborted
                    | SegmentRefusal::Busy
                    | SegmentRefusal::ShuttingDown,
                ..
            }) => Exit::Fault,
            Self::Rejected { .. }
            | Self::TooLong { .. }
            | Self::Curve(_)
            | Self::Points { .. }
            | Self::NotCalibrated { .. }
            | Self::CurveBeyond { .. }
            | Self::Refused(_)
            | Self::Planner(planner::RunError::Refused(_) | planner::RunError::Resume(_))
            | Self::Feed(FeedError::Refused(_) | FeedError::RefusedByPlanner { .. }) => {
                Exit::Rejected
            }
            Self::Bus(ethercat::RunError::NotRealTime(_))
            | Self::Jitter(JitterError::NotRealTime(_))
            | Self::Interpolator(interpolator::RunError::NotRealTime(_)) => Exit::NotRealTime,
            Self::Planner(planner::RunError::Interrupted)
            | Self::Feed(
                FeedError::Interrupted | FeedError::CalledOff { .. } | FeedError::NotEnded,
            )
            | Self::Interrupted
            | Self::NoAnswer => Exit::Interrupted,
            Self::File(_)
            | Self::State(_)
            | Self::Signals(_)
            | Self::Terminal(_)
            | Self::NoInterpolator { .. }
            | Self::CommandRefused { .. }
            | Self::NotReturned(_)
            | Self::CutShort { .. }
            | Self::NoService
            | Self::NotServing { .. }
            | Self::ServiceLost { .. }
            | Self::Silent { .. }
            | Self::NotStopped { .. }
            | Self::DoesNotEnd { .. }
            | Self::Interpolator(_)
            | Self::Bus(_)
            | Self::Planner(_)
            | Self::Feed(_)
            | Self::Link(_)
            | Self::Mirror(_)
            | Self::Hal(_)
            | Self::Recording { .. }
            | Self::Server(_)
            | Self::Endpoint(_)
            | Self::Process(_)
            | Self::Jitter(_)
            | Self::Answers(_)
            | Self::Thread(_) => Exit::Fault,
            Self::AtEndOfTravel { .. } => Exit::Short,
            Self::Left { source, .. } => left(source),
            Self::ProcessEnded { exit, .. } | Self::Job { exit, .. } => *exit,
            Self::EndedEarly { source, .. } => source.exit(),
        }
    }
}

/// That of a motion that ended before its program did.
const fn left(source: &planner::RunError) -> Exit {
    match source {
        planner::RunError::Interrupted => Exit::Interrupted,
        _ => Exit::Fault,
    }
}
