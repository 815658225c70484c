"""Setpoints, status, commands, feedback and the servo of Glidepath.

    import glidepath

    with glidepath.Link("default") as link:
        print(glidepath.State(link.status().state).name)
        with link.setpoints() as setpoints:
            setpoint = setpoints.next()

A handle belongs to the thread that opened it. Fields, units and numbers are those of glidepath.h.
Python is no place for a real-time thread: this is for monitors, tests and tools.
"""

import ctypes

from ._layout import *  # noqa: F401,F403 - constants and records are the interface
from ._layout import (
    AXES,
    Command,
    EventIdRecord,
    FeedbackRecord,
    JointRecord,
    ReplyRecord,
    ServoSettingsRecord,
    ServoStateRecord,
    SetpointRecord,
    StatusRecord,
)
from ._library import Error, Refused, call, plain

Numbers = ctypes.c_double * AXES
Joints = JointRecord * AXES


def now_ns():
    """Now, by CLOCK_MONOTONIC, ns: the clock of all records."""
    return plain("gp_now_ns")


def version():
    """The version of the library."""
    return plain("gp_version").decode()


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
