//! The ports of the interpolator.

use glidepath_link::{
    Auxiliary, CommandReply, CommandRequest, Feedback, JogDemand, LinkError, Publisher, Server,
    Setpoint, SetpointFrame, Status, Subscriber, Transport,
};

/// The ports of the interpolator.
pub(super) struct Links {
    pub(super) transport: Box<dyn Transport>,
    pub(super) frames: Box<dyn Subscriber<SetpointFrame>>,
    pub(super) setpoints: Box<dyn Publisher<Setpoint>>,
    pub(super) status: Box<dyn Publisher<Status>>,
    pub(super) auxiliary: Box<dyn Publisher<Auxiliary>>,
    pub(super) commands: Box<dyn Server<CommandRequest, CommandReply>>,
    pub(super) demands: Box<dyn Subscriber<JogDemand>>,
    pub(super) feedback: Option<Box<dyn Subscriber<Feedback>>>,
}

impl Links {
    pub(super) fn new(
        transport: Box<dyn Transport>,
        has_feedback: bool,
    ) -> Result<Self, LinkError> {
        Ok(Self {
            frames: transport.frame_source()?,
            setpoints: transport.setpoint_sink()?,
            status: transport.status_sink()?,
            auxiliary: transport.auxiliary_sink()?,
            commands: transport.command_server()?,
            demands: transport.jog_source()?,
            feedback: has_feedback
                .then(|| transport.feedback_source())
                .transpose()?,
            transport,
        })
    }
}
