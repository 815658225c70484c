//! The structures that are records of `glidepath-link`, as they are.

use super::structure::{Each, Field, InC, Structure, structure};

use glidepath_link::{
    CodeWords, CommandReply, EVENTS_MOST, EventId, EventRecord, FRAME_REFUSALS, Feedback, LATCHES,
    Latch, Quantiles, Record, Setpoint, Status, Text,
};

structure! {
    /// Quantiles of a time, ns.
    QUANTILES: "gp_quantiles" = Quantiles, "", 32 {
        /// Median.
        p50_ns: u64,
        /// 99 % are no longer.
        p99_ns: u64,
        /// 99.9 % are no longer.
        p999_ns: u64,
        /// The longest.
        max_ns: u64,
    }
}

structure! {
    /// Which event: no two have the same.
    EVENT_ID: "gp_event_id" = EventId, "", 24 {
        /// The life of the interpolator that published it.
        boot_id: u64,
        /// The epoch it happened in.
        epoch: u64,
        /// The sequence of its frame.
        sequence: u64,
    }
}

structure! {
    /// The words of an M code of the machine's own.
    CODE_WORDS: "gp_code_words" = CodeWords, "", 24 {
        /// P; zero where there is none.
        p: f64,
        /// Q; zero where there is none.
        q: f64,
        /// 1 with a P word, 2 with a Q word, 3 with both.
        given: u32,
        /// Must be zero.
        reserved: u32,
    }
}

structure! {
    /// The positions at the last edge of an input.
    LATCH: "gp_latch" = Latch, "", 104 {
        /// Counts the edges from 0.
        count: u64,
        /// When the last one was, ns of CLOCK_MONOTONIC.
        latch_ns: u64,
        /// Joint positions then, as the drives count them, mm or degrees.
        position: Each<f64>,
        /// Which input: a bit of digital_in by its index.
        input: u32,
        /// 1 for a rising edge, 0 for a falling one.
        rising: u32,
        /// A GP_LATCH_.
        kind: u32,
        /// Must be zero.
        reserved: u32,
    }
}

structure! {
    /// An event in the period of a setpoint.
    EVENT: "gp_event" = EventRecord, "", 32 {
        /// Speed (rev/min), tool, M code, value of an output, way of a revolution (mm).
        value: f64,
        /// When it happens: ns after scheduled_ns of its setpoint, up to a period.
        offset_ns: u32,
        /// A GP_EVENT_.
        kind: u32,
        /// Of an output: which; else 0.
        number: u32,
        /// Of a tapped hole: index of the axis; else 0.
        axis: u32,
        /// Of a tapped hole: depth in micrometres; else 0.
        depth_um: u32,
        /// Of a pass of a thread: the angle it begins at, in 2^-24 of a revolution; else 0.
        phase: u32,
    }
}

structure! {
    /// What the drives are to do at apply_ns.
    SETPOINT: "gp_setpoint" = Setpoint, Setpoint::NAME, 1240 {
        /// Identifies one life of the interpolator: all counts start again with a new one.
        boot_id: u64,
        /// Counts how often the position was taken from the drives, or given a new meaning, instead
        /// of continuing the one before. Whoever plays setpoints begins anew at a new one, at rest,
        /// and never goes from the position before to the one after.
        reference: u64,
        /// Counts the setpoints of this life from 0, without gaps. A gap seen by a subscriber is
        /// loss.
        number: u64,
        /// Index on the interpolator's time grid. A gap where number has none is a missed tick.
        tick: u64,
        /// When the tick was due, ns of CLOCK_MONOTONIC.
        scheduled_ns: u64,
        /// When the setpoint is to be applied, ns of CLOCK_MONOTONIC: one period after
        /// scheduled_ns, so that the time of delivery does not matter.
        apply_ns: u64,
        /// How late the tick began, ns.
        lateness_ns: u64,
        /// Missed ticks of this life so far.
        missed_ticks: u64,
        /// The trajectory, 0 before the first.
        epoch: u64,
        /// Last frame at or before the present program time, which falls while the motion goes back.
        sequence: u64,
        /// Program time past that frame, in periods, 0 <= f < 1.
        fraction: f64,
        /// Source line, 0 before the first.
        line: u32,
        /// Bits of GP_FLAG_ of the frame sequence.
        flags: u32,
        /// Bits of GP_MARK_.
        marks: u32,
        /// A GP_STATE_.
        state: u32,
        /// How many of events are used.
        event_count: u32,
        /// Block of the program being executed, 0 before the first.
        block: u32,
        /// The joints whose drives are to have power, one bit each, J0 lowest.
        enable: u32,
        /// The joints whose drives are to find their home by themselves, one bit each. Their
        /// positions here are those they report, and nothing to be followed: having found it, they
        /// stay there until their bit is 0.
        home: u32,
        /// Path position since the start of the program, mm.
        path_s: f64,
        /// Rate of path position as executed, mm/s; below 0 while the motion goes back.
        feed_v: f64,
        /// Override as executed, 0 to 2: that of the plan times the rate of program time.
        effective_override: f64,
        /// Axis positions, mm or degrees.
        position: Each<f64>,
        /// Axis velocities, mm/s or degrees/s.
        velocity: Each<f64>,
        /// Axis accelerations, mm/s^2 or degrees/s^2.
        acceleration: Each<f64>,
        /// Joint positions as the drives count them, mm or degrees.
        joint_position: Each<f64>,
        /// Joint velocities, mm/s or degrees/s.
        joint_velocity: Each<f64>,
        /// Joint accelerations, mm/s^2 or degrees/s^2.
        joint_acceleration: Each<f64>,
        /// How far the axes are from the path, mm or degrees, because they were jogged while the
        /// program was held: the positions above are those of the path and this together.
        away: Each<f64>,
        /// What happens in the period from scheduled_ns to apply_ns, in order.
        events: [EventRecord; EVENTS_MOST],
        /// How far the axes are from position by a superposition, mm or degrees: the joints are where both
        /// together ask for.
        superposed: Each<f64>,
        /// The joints whose drives are to keep where they are at the next index pulse of their encoder, one bit
        /// each. What was kept before counts no more while the bit is 0.
        index: u32,
        /// Zero.
        reserved: u32,
    }
}

structure! {
    /// What the interpolator does and how well. Counts are of this life of it.
    STATUS: "gp_status" = Status, Status::NAME, 1904 {
        /// Identifies one life of the interpolator.
        boot_id: u64,
        /// When this was true, ns of CLOCK_MONOTONIC. A reader takes an old one for a dead
        /// interpolator.
        updated_ns: u64,
        /// Interpolation period, ns.
        period_ns: u64,
        /// Last tick on the time grid.
        tick: u64,
        /// The present or last epoch, 0 before the first.
        epoch: u64,
        /// Frames of the epoch accepted so far: the sequence of the next one expected.
        frames_received: u64,
        /// Frames of the epoch whose instant has come: one more than the sequence executed last.
        frames_executed: u64,
        /// Frames accepted but not yet reached.
        queue_depth: u32,
        /// Most frames it can hold.
        queue_capacity: u32,
        /// Its process.
        pid: u32,
        /// A GP_STATE_.
        state: u32,
        /// A GP_END_.
        end_of_epoch: u32,
        /// The GP_FAULT_ that is latched.
        fault: u32,
        /// Source line of the latched fault, 0 if it has none.
        fault_line: u32,
        /// Axis of the latched fault, as its index plus one, 0 if it has none.
        fault_axis: u32,
        /// Joint of the latched fault, as its index plus one, 0 if it has none.
        fault_joint: u32,
        /// The drive's own number of its fault, 0 if there is none.
        drive_fault: u32,
        /// Sequence of the frame the latched fault is about.
        fault_sequence: u64,
        /// What was measured at the latched fault, in units of the limit it broke.
        fault_value: f64,
        /// The limit that was broken.
        fault_limit: f64,
        /// Source line being executed, 0 before the first.
        line: u32,
        /// Bits of GP_GRANT_.
        grants: u32,
        /// Block of the program being executed, 0 before the first.
        block: u32,
        /// 1 if the machine rests at the end of every block, 0 if not.
        single_block: u32,
        /// The program of the present or last epoch.
        program: u64,
        /// Where the machine stood when that program began, mm or degrees. A planner that goes on
        /// with the program in a new epoch changes neither.
        program_start: Each<f64>,
        /// Axis positions as last commanded, mm or degrees.
        position: Each<f64>,
        /// How far the axes are from the path.
        away: Each<f64>,
        /// A GP_POWER_.
        power: u32,
        /// A GP_MODE_.
        mode: u32,
        /// The joints that the machine has, one bit each, J0 lowest.
        joints: u32,
        /// The joints whose drives say that they have power.
        enabled: u32,
        /// The joints that know where they are.
        homed: u32,
        /// The joints whose drives report a fault.
        drive_faults: u32,
        /// That of the last setpoint.
        reference: u64,
        /// How old the oldest feedback of a joint is, ns; 0 if none is configured, UINT64_MAX
        /// before the first.
        feedback_age_ns: u64,
        /// Joint positions as the drives reported them last, in the machine's own count, mm or
        /// degrees.
        joint_actual: Each<f64>,
        /// What was commanded of each joint for the moment of its last feedback, less what it
        /// reported, mm or degrees.
        following_error: Each<f64>,
        /// The largest magnitude of that since power came on.
        following_peak: Each<f64>,
        /// Sequence of the frame whose event is awaited; means something if the next field does.
        awaited_sequence: u64,
        /// Since when it is awaited, ns of CLOCK_MONOTONIC; 0 if nothing is.
        awaited_since_ns: u64,
        /// The event's number, as in a setpoint.
        awaited_value: f64,
        /// The event's code, as in a setpoint; 0 if nothing is awaited.
        awaited_kind: u32,
        /// Its source line.
        awaited_line: u32,
        /// Its words, where it is an M code of the machine's own.
        awaited_words: CodeWords,
        /// Where the axes really were when the probe found what it looked for in this epoch, mm or
        /// degrees.
        contact: Each<f64>,
        /// A GP_CONTACT_.
        contact_kind: u32,
        /// 1 if the last epoch was left before the event of its block was done: an M code that nobody
        /// answered, or a program stop that nobody let pass. 0 if not, and while one is open.
        unanswered: u32,
        /// Path position, mm.
        path_s: f64,
        /// Path position of the first setpoint of the block, mm.
        block_path_s: f64,
        /// Rate of path position, mm/s.
        feed_v: f64,
        /// Feed override as commanded; below 0 if the motion is to go back along the path.
        feed_override: f64,
        /// Rapid override as commanded.
        rapid_override: f64,
        /// Part of their speed that jogs have, as commanded, 0 to 1.
        jog_override: f64,
        /// Override as executed.
        effective_override: f64,
        /// What an input makes of both overrides, -1 to 1; below 0 it turns the motion round. 1 where
        /// none slows programs down.
        adaptive_feed: f64,
        /// Ticks run.
        ticks: u64,
        /// Ticks that were not run because the one before took until after them.
        missed_ticks: u64,
        /// Ticks that began late, within their period.
        late_ticks: u64,
        /// Setpoints handed to the transport.
        setpoints_published: u64,
        /// Setpoints lost inside the interpolator.
        setpoints_lost: u64,
        /// Stops in reserve that were begun: for want of frames, or because no later stop was
        /// found.
        reserve_stops: u64,
        /// Ticks in which a motion that had begun slowed or stood for want of frames.
        starved_ticks: u64,
        /// Commands served.
        commands_served: u64,
        /// Commands refused, among those served.
        commands_refused: u64,
        /// Frames refused, by cause: GP_FAULT_FRAME_ in order.
        frames_refused: [u64; FRAME_REFUSALS],
        /// How late ticks began.
        lateness: Quantiles,
        /// How long the work of a tick took, before and at its deadline.
        work: Quantiles,
        /// How long the host took to wake the thread before a tick.
        latency: Quantiles,
        /// From the deadline of a tick to its setpoint published: whoever subscribes has it.
        response: Quantiles,
        /// The number of the job that a planner has told of last, 0 for none.
        job_number: u64,
        /// The number that the next epoch has to have. An abort uses it up.
        next_epoch: u64,
        /// A GP_JOB_.
        job_stage: u32,
        /// 1 if the job begins held, 0 if not.
        job_held: u32,
        /// The last error, for people.
        last_error: Text,
        /// The last thing that happened (a change of state, missed ticks, ...), for people.
        last_event: Text,
        /// What the program said last to people: MSG, DEBUG, the comment of a stop; empty before that.
        message: Text,
        /// The job that a planner has told of last, and what is being done for it, for people.
        job: Text,
        /// Why that job does not begin, for people; empty if it may.
        job_end: Text,
        /// The client of the jog whose demand was followed last; 0 before the first.
        jog_client: u64,
        /// The number of that demand.
        jog_number: u64,
        /// Speed of the spindle as it was measured last, rev/s, negative if it turns backwards; means
        /// something if GP_SPINDLE_SPEED is set.
        spindle_v: f64,
        /// Bits of GP_SPINDLE_.
        spindle_flags: u32,
        /// A GP_SUPERPOSITION_.
        superposition: u32,
        /// How far the axes are from position by a superposition, mm or degrees.
        superposed: Each<f64>,
        /// A GP_FREEZE_REASON_: why the superposition is frozen.
        freeze_reason: u32,
        /// 1 if the job that a planner has told of last is a stream of segments, 0 if not.
        job_stream: u32,
        /// Spindle override as commanded.
        spindle_override: f64,
        /// Load of the spindle as it was measured last: the magnitude of its torque as a part of its rated one;
        /// means something if GP_SPINDLE_LOAD is set.
        spindle_load: f64,
    }
}

structure! {
    /// What a servo stack knows of the joints it drives, at one moment.
    FEEDBACK: "gp_feedback" = Feedback, Feedback::NAME, 904 {
        /// Identifies one life of the stack: another stack, or the same started again, has another.
        boot_id: u64,
        /// Counts the records of this life, without gaps. A gap seen by a reader is loss.
        number: u64,
        /// When the positions were measured, ns of CLOCK_MONOTONIC.
        sample_ns: u64,
        /// The reference of the setpoint that the stack plays; 0 before the first.
        reference: u64,
        /// The number of that setpoint.
        setpoint_number: u64,
        /// The joints that this is about, one bit each, J0 lowest. What is said below of others
        /// means nothing.
        joints: u32,
        /// The joints that have power and follow setpoints.
        enabled: u32,
        /// The joints that know where they are: absolute encoders, or those that found their home.
        homed: u32,
        /// The joints that look for their home by themselves.
        homing: u32,
        /// The joints whose drives report a fault.
        fault: u32,
        /// The joints that stand at their lower limit switch.
        limit_low: u32,
        /// The joints that stand at their upper limit switch.
        limit_high: u32,
        /// The joints that stand at their home switch.
        home_switch: u32,
        /// Joint positions as the drives count them, mm or degrees.
        position: Each<f64>,
        /// Joint velocities, mm/s or degrees/s.
        velocity: Each<f64>,
        /// A GP_DRIVE_ each.
        drive_state: Each<u32>,
        /// The drives' own numbers of their faults, 0 for none.
        fault_code: Each<u32>,
        /// Digital inputs, one bit each.
        digital_in: u64,
        /// Analog inputs, in whatever unit they have.
        analog_in: [f64; 8],
        /// Angle of the spindle since some start, in revolutions, never wrapped.
        spindle_angle: f64,
        /// Speed of the spindle, rev/s, negative if it turns backwards.
        spindle_v: f64,
        /// Index pulses of the spindle so far.
        spindle_index_count: u64,
        /// Bits of GP_SPINDLE_.
        spindle_flags: u32,
        /// A GP_LOSS_: what the stack has lost, for which it does not obey any more. What it stopped for
        /// that it tells until a fault of the interpolator is reset, or another interpolator is there.
        loss: u32,
        /// Of setpoints, how long none came, s. Of a device, its place in the line from 0, or -1 where
        /// none says that it is missing. Of a spindle the number of its fault, 0 without power. Of
        /// a gear its number, 0 where nobody said which one is to be in. 0 otherwise.
        loss_value: f64,
        /// The inputs that are latched.
        latch: [Latch; LATCHES],
        /// The joints whose drives are ready to keep where they are at the next index pulse, one bit each: of
        /// those in index of gp_setpoint alone, and not before they have forgotten what they kept. One that was ready and
        /// is not any more is not ready again before its bit there was 0.
        index_armed: u32,
        /// Those of them that have kept it since.
        index_kept: u32,
        /// Where these were at the index pulse, as the drives count, mm or degrees.
        index_position: Each<f64>,
        /// Load of the spindle: the magnitude of its torque as a part of its rated one.
        spindle_load: f64,
    }
}

structure! {
    /// The answer to a command.
    REPLY: "gp_reply" = CommandReply, CommandReply::NAME, 152 {
        /// The life of the interpolator that answers.
        boot_id: u64,
        /// The number of the request.
        number: u64,
        /// A GP_REFUSAL_, 0 if the command was accepted.
        refusal: u32,
        /// The GP_STATE_ when the answer was given.
        state: u32,
        /// More about a refusal, for people.
        message: Text,
    }
}
