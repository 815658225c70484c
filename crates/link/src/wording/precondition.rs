//! The preconditions of commands that can be unmet, each with its text: why a command is not
//! possible as things are.

/// A precondition of a command that is not met: why the command is not possible as things are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum UnmetPrecondition {
    /// A hold of joints on their way home.
    HomingNotHeld,
    /// What would move the axes while a job is prepared.
    JobHasMachine,
    /// The way back without a program.
    NoPathBack,
    /// The way forward without a program.
    NoPathForward,
    /// A resume of what is not held.
    NothingHeld,
    /// A resume at a feed override of 0 of what is not held.
    NoFeed,
    /// The same at a rapid override of 0.
    NoRapid,
    /// A step of what is not held.
    NoStep,
    /// A stop at the end of a block without one.
    NoBlock,
    /// The axes were jogged away from a held path.
    Away,
    /// A reset without a fault.
    NoFault,
    /// A reset while the motion still comes to rest.
    NotAtRestYet,
    /// A reset while a joint with power is not where it is to be.
    StaysApart,
    /// A command to drives that are not there.
    Simulated,
    /// A return where no program is held.
    NoPathToReturn,
    /// A return to a path on which the axes are.
    OnPath,
    /// A return while the axes move.
    Moving,
    /// Power while a fault is latched.
    FaultLatched,
    /// Power where it is there, or asked for.
    PowerAsked,
    /// Power of drives that do not say where they are.
    NoPosition,
    /// Power of drives that say a place that the mechanism cannot be at.
    NoPose,
    /// Power of a drive with a fault.
    DriveFault,
    /// What changes where joints are, while something moves or may.
    NotAtRest,
    /// A number that is no position of a joint.
    NoSuchPosition,
    /// A joint that the machine does not have.
    NoSuchJoint,
    /// The second joint of an axis.
    SecondJoint,
    /// A joint that nobody reports.
    Unreported,
    /// A search for home without power.
    NeedsPower,
    /// A search for home of a joint that has none.
    NoHome,
    /// A search for home while there is one.
    HomingAlready,
    /// A jog while the machine does something else.
    NoJogNow,
    /// A jog while axes are moved by hand already.
    ByHand,
    /// What would move the axes, asked for before the machine was stopped.
    StoppedSince,
    /// An answer to an event of an interpolator that has ended.
    OtherLife,
    /// A second answer.
    Answered,
    /// An answer to what the drives answer.
    ByFeedback,
    /// An answer before the event.
    TooEarly,
    /// An answer to an event behind the one that is awaited.
    EarlierEvent,
    /// An answer where nothing is asked.
    NoEvent,
    /// An answer to something else.
    AnotherEvent,
}

impl UnmetPrecondition {
    /// Every precondition.
    pub const ALL: &'static [Self] = &[
        Self::HomingNotHeld,
        Self::JobHasMachine,
        Self::NoPathBack,
        Self::NoPathForward,
        Self::NothingHeld,
        Self::NoFeed,
        Self::NoRapid,
        Self::NoStep,
        Self::NoBlock,
        Self::Away,
        Self::NoFault,
        Self::NotAtRestYet,
        Self::StaysApart,
        Self::Simulated,
        Self::NoPathToReturn,
        Self::OnPath,
        Self::Moving,
        Self::FaultLatched,
        Self::PowerAsked,
        Self::NoPosition,
        Self::NoPose,
        Self::DriveFault,
        Self::NotAtRest,
        Self::NoSuchPosition,
        Self::NoSuchJoint,
        Self::SecondJoint,
        Self::Unreported,
        Self::NeedsPower,
        Self::NoHome,
        Self::HomingAlready,
        Self::NoJogNow,
        Self::ByHand,
        Self::StoppedSince,
        Self::OtherLife,
        Self::Answered,
        Self::ByFeedback,
        Self::TooEarly,
        Self::EarlierEvent,
        Self::NoEvent,
        Self::AnotherEvent,
    ];

    /// The text: why, and behind a semicolon what to do; short enough for a record.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::HomingNotHeld => {
                "joints on their way home are not held; `glidepath abort` ends it"
            }
            Self::JobHasMachine => {
                "a job has the machine, and is being prepared; `glidepath abort` ends it"
            }
            Self::NoPathBack => "no program runs, so there is no path to go back along",
            Self::NoPathForward => "no program runs, and each one begins forward by itself",
            Self::NothingHeld => "nothing is held; `glidepath status` says what the machine does",
            Self::NoFeed => {
                "nothing is held, but the feed override is 0 %; `glidepath override 100` goes on"
            }
            Self::NoRapid => {
                "nothing is held, but the rapid override is 0 %; `glidepath override --rapid 100` goes on"
            }
            Self::NoStep => {
                "nothing is held; a step goes on after a hold, a program stop or the end of a block"
            }
            Self::NoBlock => "no program runs, so there is no block to stop at the end of",
            Self::Away => "the axes are away from the path; return first with `glidepath return`",
            Self::NoFault => "no fault is latched, so there is nothing to clear",
            Self::NotAtRestYet => {
                "a fault is latched, and the motion has not come to rest yet; ask again in a moment"
            }
            Self::StoppedSince => {
                "the machine was stopped after this was asked for; ask again if it is to move"
            }
            Self::StaysApart => {
                "a joint is still too far from where it is to be; `glidepath disable`, `glidepath reset`, \
                 `glidepath enable`"
            }
            Self::Simulated => {
                "no feedback is configured, so the drives are simulated, always on and homed"
            }
            Self::NoPathToReturn => "no program is held, so there is no path to return to",
            Self::OnPath => "the axes are on the path, so there is nowhere to return to",
            Self::Moving => "the axes are moving; return when they are at rest",
            Self::FaultLatched => "a fault is latched; clear it first with `glidepath reset`",
            Self::PowerAsked => "the drives are on, or were asked to be",
            Self::NoPosition => {
                "the drives do not say where they are; start `glidepath ethercat --drives drives.toml` or `glidepath servo`"
            }
            Self::NoPose => {
                "the drives say where no pose of the mechanism is; tell where the joints are with \
                 set-position, or mend the configuration"
            }
            Self::DriveFault => "a drive reports a fault; mend that first",
            Self::NotAtRest => {
                "the machine has to be at rest without a program; `glidepath abort` ends one"
            }
            Self::NoSuchPosition => "no position of a joint; it is within 1e6 mm or degrees",
            Self::NoSuchJoint => "the machine has no such joint",
            Self::SecondJoint => "it is the second joint of its axis, and goes with the first",
            Self::Unreported => {
                "nobody says where the joint is; start `glidepath ethercat --drives drives.toml` or `glidepath servo`"
            }
            Self::NeedsPower => {
                "the drives have to be on, and are not; `glidepath enable` switches them on"
            }
            Self::NoHome => "not all of these joints have a home to find",
            Self::HomingAlready => "joints are on their way home; `glidepath abort` ends it",
            Self::NoJogNow => {
                "axes are jogged while no program runs, or one is held; `glidepath hold` holds it"
            }
            Self::ByHand => {
                "another client jogs, or the axes are on their way back to the path; ask again when they rest"
            }
            Self::OtherLife => "the interpolator was started again after that event",
            Self::Answered => "that event was answered already",
            Self::ByFeedback => "the drives' feedback answers that event, and nobody else",
            Self::TooEarly => {
                "it is too early; answer when `glidepath status` says that the machine is awaiting"
            }
            Self::EarlierEvent => {
                "it is too early; the machine waits for another event before that one"
            }
            Self::NoEvent => "no event is awaited",
            Self::AnotherEvent => "another event is awaited; `glidepath status` says which",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Text;

    #[test]
    fn objections_have_texts_of_their_own_that_fit_into_a_reply() {
        for (i, precondition) in UnmetPrecondition::ALL.iter().enumerate() {
            let text = precondition.text();
            assert_eq!(Text::new(text).as_str(), text);
            // One sentence: what to do is behind the only stop in it.
            assert!(text.matches([';', ':']).count() <= 1, "{text}");
            for other in &UnmetPrecondition::ALL[..i] {
                assert_ne!(text, other.text());
                assert_ne!(precondition, other);
            }
        }
    }
}
