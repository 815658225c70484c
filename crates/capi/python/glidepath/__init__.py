"""Setpoints, status, commands, feedback, jogs, segments and the servo of Glidepath.

    import glidepath

    with glidepath.Link("default") as link:
        print(glidepath.State(link.status().state).name)
        with link.setpoints() as setpoints:
            setpoint = setpoints.next()

A handle belongs to the thread that opened it. Fields, units and numbers are those of glidepath.h.
Python is no place for a real-time thread: this is for monitors, tests and tools.
"""

import ctypes
import time

from ._layout import *  # noqa: F401,F403 - constants and records are the interface
from ._layout import (
    AXES,
    Command,
    EventIdRecord,
    FeedbackRecord,
    JogMode,
    JogRecord,
    JointRecord,
    Path,
    Plane,
    ReplyRecord,
    Segment,
    SegmentRecord,
    SegmentRefusal,
    SegmentReplyRecord,
    ServoSettingsRecord,
    ServoStateRecord,
    SetpointRecord,
    StatusRecord,
)
from ._library import Error, Refused, call, plain, text_of

Numbers = ctypes.c_double * AXES
Joints = JointRecord * AXES


def now_ns():
    """Now, by CLOCK_MONOTONIC, ns: the clock of all records."""
    return plain("gp_now_ns")


def version():
    """The version of the library."""
    return plain("gp_version").decode()


def state_text(state):
    """What the machine does in a `State`."""
    return text_of("gp_state_text", int(state))


def fault_text(status):
    """The latched fault of a status in one clause; "" where there is none."""
    return text_of("gp_fault_text", ctypes.byref(status), ctypes.sizeof(status))


def fault_remedy(status):
    """What to do about it; what clears it comes last. "" where there is no fault."""
    return text_of("gp_fault_remedy", ctypes.byref(status), ctypes.sizeof(status))


class _Handle:
    """What is to be closed."""

    _close = None

    def __init__(self):
        self._handle = ctypes.c_void_p()

    def _opened(self, name, *arguments):
        call(name, *arguments, ctypes.byref(self._handle))

    def close(self):
        """Closes it; it may be closed already. In the thread that opened it."""
        if self._handle:
            call(self._close, self._handle)
            self._handle = ctypes.c_void_p()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Link(_Handle):
    """A thread's part in an instance."""

    _close = "gp_close"

    def __init__(self, instance="default"):
        super().__init__()
        from ._layout import ABI, LAYOUT

        self._opened("gp_open_as", instance.encode(), ABI, LAYOUT)

    def status(self, patience=1.0):
        """The first status shown after the call; None if none came within so many seconds."""
        status = StatusRecord()
        size = ctypes.sizeof(status)
        got = call("gp_read_status", self._handle, ctypes.byref(status), size, _ms(patience))
        return status if got else None

    def command(self, kind, value=0.0, joints=0, patience=1.0):
        """Commands (a `Command`); gives the answer, None if there was none in time.

        Raises `Refused` if the interpolator refuses.
        """
        return self._command(
            "gp_command", ctypes.c_uint32(kind), float(value), joints, _ms(patience)
        )

    def acknowledge(self, boot_id, epoch, sequence, done=True, patience=1.0):
        """Says that an event which the machine waits for was done, or has failed."""
        event = EventIdRecord(boot_id, epoch, sequence)
        return self._command("gp_acknowledge", ctypes.byref(event), int(done), _ms(patience))

    def hold(self, patience=1.0):
        """To rest on the path."""
        return self.command(Command.HOLD, patience=patience)

    def resume(self, patience=1.0):
        """On, after a hold or a stop."""
        return self.command(Command.RESUME, patience=patience)

    def abort(self, patience=1.0):
        """To rest on the path, and the end of the program."""
        return self.command(Command.ABORT, patience=patience)

    def _command(self, name, *arguments):
        reply = ReplyRecord()
        size = ctypes.sizeof(reply)
        try:
            got = call(name, self._handle, *arguments, ctypes.byref(reply), size)
        except Refused as refused:
            refused.reply = reply
            raise
        return reply if got else None

    def setpoints(self):
        """A subscriber."""
        return Setpoints(self)

    def feedback(self):
        """A way for what the drives say."""
        return Feedback(self)

    def jog(self):
        """A client that moves the machine by hand."""
        return Jog(self)

    def segments(self, patience=1.0):
        """A stream of segments to a planner that listens, opened."""
        return Segments(self, patience)

    def servo(self, settings=None):
        """A servo; its settings by default are those of `servo_settings`."""
        return Servo(self, settings)


class Setpoints(_Handle):
    """Setpoints as they come."""

    _close = "gp_setpoints_close"

    def __init__(self, link):
        super().__init__()
        self._opened("gp_setpoints_open", link._handle)

    def next(self):
        """The next one that has arrived; None if there is no more yet."""
        setpoint = SetpointRecord()
        size = ctypes.sizeof(setpoint)
        return setpoint if call("gp_next", self._handle, ctypes.byref(setpoint), size) else None

    def latest(self):
        """The last one that has arrived, or None, and how many arrived before it."""
        setpoint, skipped = SetpointRecord(), ctypes.c_uint64()
        got = call(
            "gp_latest",
            self._handle,
            ctypes.byref(setpoint),
            ctypes.sizeof(setpoint),
            ctypes.byref(skipped),
        )
        return (setpoint if got else None), skipped.value


class Feedback(_Handle):
    """A servo stack's way to the interpolator."""

    _close = "gp_feedback_close"

    def __init__(self, link):
        super().__init__()
        self._opened("gp_feedback_open", link._handle)

    def send(self, feedback: FeedbackRecord):
        """Sends what the drives say; `boot_id` and `number` are filled in on the way."""
        call("gp_feedback_send", self._handle, ctypes.byref(feedback), ctypes.sizeof(feedback))


class Jog(_Handle):
    """Moves the machine by hand, as long as somebody says so."""

    _close = "gp_jog_close"

    def __init__(self, link):
        super().__init__()
        self._opened("gp_jog_open", link._handle)

    def send(self, jog: JogRecord):
        """Asks for something new; `client`, `number` and `sent_ns` are filled in on the way."""
        call("gp_jog_send", self._handle, ctypes.byref(jog), ctypes.sizeof(jog))

    def keep(self):
        """Says that the client lives and wants what it wanted: every 50 ms or more often."""
        call("gp_jog_keep", self._handle)

    def is_followed(self, status: StatusRecord):
        """Whether what was asked for last moves the machine by this status, or was the last that did."""
        size = ctypes.sizeof(status)
        return call("gp_jog_is_followed", self._handle, ctypes.byref(status), size) == 1

    def move(self, velocities, by_joint=False):
        """At these velocities, mm/s or degrees/s, for as long as it is kept."""
        self.send(_jog(JogMode.CONTINUOUS, velocities, by_joint))

    def step(self, distances, velocity=0.0, by_joint=False):
        """By these distances, mm or degrees, once; 0 is as fast as jogging may be."""
        self.send(_jog(JogMode.INCREMENTAL, distances, by_joint, velocity))

    def let_go(self):
        """To rest."""
        self.send(JogRecord())


def _jog(mode, values, by_joint, velocity=0.0):
    """`values` are a number for each axis, or a dictionary by index."""
    pairs = values.items() if isinstance(values, dict) else enumerate(values)
    value, mask = Numbers(), 0
    for index, number in pairs:
        value[index] = number
        mask |= (1 << index) if number else 0
    return JogRecord(
        mode=mode, mask=mask, by_joint=int(by_joint), velocity_v=velocity, value=value
    )


class Segments(_Handle):
    """A stream of segments, which the machine follows as they come."""

    _close = "gp_segments_close"

    def __init__(self, link, patience=1.0):
        super().__init__()
        self.patience = patience
        self._opened("gp_segments_open", link._handle)
        try:
            reply = self._accepted(SegmentRecord(kind=Segment.OPEN))
        except BaseException:
            self.close()
            raise
        #: Where the next segment starts.
        self.position = list(reply.position)
        self._line = 0

    def send(self, segment: SegmentRecord):
        """Sends a piece; gives the answer, None if there is none in time. Raises `Refused`.

        `session` and `number` are filled in on the way. Without an answer: the same once more.
        """
        reply = SegmentReplyRecord()
        try:
            got = call(
                "gp_segments_send",
                self._handle,
                ctypes.byref(segment),
                ctypes.sizeof(segment),
                _ms(self.patience),
                ctypes.byref(reply),
                ctypes.sizeof(reply),
            )
        except Refused as refused:
            refused.reply = reply
            raise
        return reply if got else None

    def _accepted(self, segment):
        """Sends a piece, and waits for room where there is none."""
        while True:
            try:
                reply = self.send(segment)
            except Refused as refused:
                if refused.reply.refusal != SegmentRefusal.NO_CREDIT:
                    raise
                time.sleep(0.005)
                continue
            if reply is None:
                raise TimeoutError(f"the planner has not answered in {self.patience} s")
            return reply

    def _move(self, kind, end, feed, tolerance, line, **fields):
        self._line = line or self._line + 1
        mode = Path.CONTINUOUS
        if tolerance is not None:
            mode = Path.CONTINUOUS_WITHIN if tolerance > 0.0 else Path.EXACT_STOP
        target = list(self.position)
        pairs = end.items() if isinstance(end, dict) else enumerate(end)
        for index, number in pairs:
            target[index] = number
        self._accepted(
            SegmentRecord(
                kind=kind,
                line=self._line,
                rapid=int(feed is None),
                mode=mode,
                feed_v=feed or 0.0,
                tolerance_mm=tolerance or 0.0,
                start=Numbers(*self.position),
                end=Numbers(*target),
                **fields,
            )
        )
        self.position = target

    def line_to(self, end, feed=None, tolerance=None, line=0):
        """To `end`: a number for each axis, or a dictionary by index. `feed` is mm/s; without it
        the move is rapid. `tolerance` is mm at the corners; 0 stops exactly, None is the
        machine's."""
        self._move(Segment.LINE, end, feed, tolerance, line)

    def arc_to(self, end, center, sweep, feed, plane=Plane.XY, tolerance=None, line=0):
        """An arc around `center`, on the two axes of the plane, by `sweep` radians."""
        center = (ctypes.c_double * 2)(*center)
        fields = {"plane": plane, "center": center, "sweep_rad": sweep}
        self._move(Segment.ARC, end, feed, tolerance, line, **fields)

    def dwell(self, seconds, line=0):
        """At rest for so long."""
        self._line = line or self._line + 1
        self._accepted(SegmentRecord(kind=Segment.DWELL, line=self._line, dwell_t=seconds))

    def end(self):
        """No more will come: the machine comes to rest at the end of what was sent."""
        self._accepted(SegmentRecord(kind=Segment.END))


def servo_settings():
    """The settings to begin with."""
    settings = ServoSettingsRecord()
    call("gp_servo_settings_default", ctypes.byref(settings), ctypes.sizeof(settings))
    return settings


class Servo(_Handle):
    """Plays setpoints by their time, and stops by itself."""

    _close = "gp_servo_close"

    def __init__(self, link, settings=None):
        super().__init__()
        settings = settings or servo_settings()
        size = ctypes.sizeof(settings)
        self._opened("gp_servo_open", link._handle, ctypes.byref(settings), size)

    def receive(self, now):
        """A setpoint that has arrived; None if there is no more yet."""
        setpoint = SetpointRecord()
        size = ctypes.sizeof(setpoint)
        got = call("gp_servo_receive", self._handle, now, ctypes.byref(setpoint), size)
        return setpoint if got else None

    def demand(self, now):
        """What the joints are to do at a time; None for staying where they are."""
        joints = Joints()
        size = ctypes.sizeof(joints)
        got = call("gp_servo_demand", self._handle, now, ctypes.byref(joints), size)
        return joints if got else None

    def stop(self, now):
        """The joints to rest, within their own limits."""
        call("gp_servo_stop", self._handle, now)

    def rearm(self):
        """Plays setpoints again, from the next on."""
        call("gp_servo_rearm", self._handle)

    def rearm_at(self, actual, window):
        """Plays setpoints again, from one at rest that is within `window` of `actual`."""
        actual, window = Numbers(*actual), Numbers(*window)
        call("gp_servo_rearm_at", self._handle, ctypes.byref(actual), ctypes.byref(window))

    def state(self):
        """What it does, and what arrived so far."""
        state = ServoStateRecord()
        call("gp_servo_read_state", self._handle, ctypes.byref(state), ctypes.sizeof(state))
        return state

    def release(self):
        """Gives it to the next thread that uses it."""
        call("gp_servo_release", self._handle)


def _ms(seconds):
    return max(0, min(round(seconds * 1000), 0xFFFFFFFF))
