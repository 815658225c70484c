"""The package against an instance, which the test of the library runs. The argument is its name.

Whoever plays the interpolator accepts every command but to resume.
"""

import ctypes
import math
import sys
import threading
import time
import unittest

import glidepath
from glidepath import _library

INSTANCE = sys.argv.pop() if len(sys.argv) > 1 else "default"


def elsewhere(body):
    """What a function gives in another thread, or raises."""
    result = []

    def run():
        try:
            result.append(body())
        except Exception as error:
            result.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return result[0]


class Instance(unittest.TestCase):
    def setUp(self):
        self.link = glidepath.Link(INSTANCE)

    def tearDown(self):
        self.link.close()

    def fails(self, code, body, *arguments):
        with self.assertRaises(glidepath.Error) as caught:
            body(*arguments)
        self.assertEqual(caught.exception.code, code)
        self.assertTrue(str(caught.exception))
        return caught.exception

    def test_status(self):
        before = glidepath.now_ns()
        status = self.link.status()
        self.assertGreater(status.updated_ns, before - 10_000_000)
        self.assertEqual(status.state, glidepath.State.HELD)
        self.assertEqual(status.period_ns, 4_000_000)
        self.assertEqual(status.feed_override, 1.5)
        self.assertEqual(status.last_event.decode(), "held by the operator")
        self.assertEqual(status.message.decode(), "turn the part over")

    def test_texts_of_states_and_faults(self):
        for state in glidepath.State:
            self.assertGreater(len(glidepath.state_text(state)), 8)
        held = "held at rest on the path; `glidepath resume` goes on"
        self.assertEqual(glidepath.state_text(glidepath.State.HELD), held)
        self.fails(glidepath.ErrorCode.ARGUMENT, glidepath.state_text, 99)
        status = self.link.status()
        self.assertEqual((glidepath.fault_text(status), glidepath.fault_remedy(status)), ("", ""))
        status.fault = glidepath.Fault.MISSED_TICKS
        status.fault_line = 12
        self.assertEqual(glidepath.fault_text(status), "too many ticks were missed, line 12")
        self.assertTrue(glidepath.fault_remedy(status).endswith("`glidepath reset`"))
        status.fault = 4711
        self.fails(glidepath.ErrorCode.RECORD, glidepath.fault_remedy, status)

    def test_commands(self):
        self.assertEqual(self.link.hold().refusal, 0)
        for kind in ("ABORT", "RESET", "STEP", "ENABLE", "DISABLE", "RETURN", "PING"):
            self.link.command(glidepath.Command[kind])
        self.link.command(glidepath.Command.FEED_OVERRIDE, 0.5)
        self.link.command(glidepath.Command.SINGLE_BLOCK, 1)
        self.link.command(glidepath.Command.HOME, joints=0b101)
        self.link.command(glidepath.Command.SET_POSITION, -12.5, joints=2)
        self.assertEqual(self.link.acknowledge(7, 8, 9).message.decode(), "that event")

    def test_a_refusal_has_its_answer(self):
        refused = self.fails(glidepath.ErrorCode.REFUSED, self.link.resume)
        self.assertIsInstance(refused, glidepath.Refused)
        self.assertEqual(refused.reply.refusal, glidepath.Refusal.WRONG_STATE)
        self.assertEqual(str(refused), "refused: it is not held")

    def test_arguments_out_of_range_are_named(self):
        wrong = self.fails(
            glidepath.ErrorCode.RECORD, self.link.command, glidepath.Command.FEED_OVERRIDE, 7
        )
        self.assertIn("value", str(wrong))
        self.fails(glidepath.ErrorCode.RECORD, self.link.command, 999)
        self.fails(glidepath.ErrorCode.RECORD, self.link.command, glidepath.Command.HOME, 0, 1 << 9)
        self.fails(
            glidepath.ErrorCode.ARGUMENT, self.link.command, glidepath.Command.ACKNOWLEDGE
        )
        self.fails(glidepath.ErrorCode.ARGUMENT, glidepath.Link, "no/instance")

    def test_where_no_interpolator_runs(self):
        with glidepath.Link("nobody-here") as link:
            self.fails(glidepath.ErrorCode.NO_SERVER, link.hold)
            self.fails(glidepath.ErrorCode.NO_SERVER, link.status)

    def test_latest_skips(self):
        with self.link.setpoints() as setpoints:
            time.sleep(0.1)
            latest, skipped = setpoints.latest()
            self.assertGreater(skipped, 3)
            following = None
            while following is None:
                following = setpoints.next()
            self.assertEqual(following.number, latest.number + 1)
            self.assertEqual(following.joint_position[0], latest.joint_position[0])
            told = following.events[: following.event_count]
            self.assertEqual([event.offset_ns for event in told], [0, 1_000_001, 4_000_000])
            self.assertEqual([event.number for event in told], [0, 1, 2])
            analog = glidepath.Event.ANALOG_OUTPUT
            self.assertEqual({event.kind for event in told}, {analog})
            self.assertEqual(told[1].value, float(following.number))

    def test_handles_belong_to_their_thread(self):
        with self.link.setpoints() as setpoints:
            for body in (self.link.hold, self.link.close, setpoints.next, setpoints.close):
                error = elsewhere(body)
                self.assertIsInstance(error, glidepath.Error)
                self.assertEqual(error.code, glidepath.ErrorCode.THREAD)
            setpoints.latest()
        self.link.hold()

    def test_a_servo_may_be_handed_over(self):
        servo = self.link.servo()
        now = glidepath.now_ns
        self.assertEqual(elsewhere(servo.state).code, glidepath.ErrorCode.THREAD)
        servo.release()
        taken = elsewhere(lambda: (servo.state().armed, servo.release()))
        self.assertEqual(taken, (1, None))
        servo.stop(now())
        self.assertEqual(servo.state().stopped, glidepath.Stopped.ASKED)
        servo.close()
        servo.close()

    def play(self, servo, seconds):
        end, joints = glidepath.now_ns() + round(seconds * 1e9), None
        while glidepath.now_ns() < end:
            while servo.receive(glidepath.now_ns()):
                pass
            joints = servo.demand(glidepath.now_ns())
            time.sleep(0.001)
        return joints

    def test_a_servo_begins_where_its_drives_stand(self):
        with self.link.setpoints() as setpoints:
            told = None
            while told is None:
                told = setpoints.next()
        place = told.joint_position[0]
        window = [0.1] + [math.inf] * 8
        with self.link.servo() as servo:
            servo.rearm_at([place + 0.2] + [0.0] * 8, window)
            self.assertIsNone(self.play(servo, 0.05))
            servo.rearm_at([place + 0.05] + [0.0] * 8, window)
            self.assertEqual(self.play(servo, 0.05)[0].position, place)
            servo.stop(glidepath.now_ns())
            self.assertFalse(servo.state().armed)
            self.fails(
                glidepath.ErrorCode.ARGUMENT, servo.rearm_at, [math.nan] * 9, window
            )

    def test_settings_are_judged(self):
        settings = glidepath.servo_settings()
        self.assertEqual(settings.patience_ns, 12_000_000)
        self.assertTrue(math.isinf(settings.jump[8].velocity))
        settings.stop[4].jerk = 0.0
        self.fails(glidepath.ErrorCode.ARGUMENT, self.link.servo, settings)
        settings.stop[4].jerk = 1e4
        settings.jump[0].velocity = math.nan
        self.fails(glidepath.ErrorCode.ARGUMENT, self.link.servo, settings)

    def test_feedback_is_judged(self):
        with self.link.feedback() as sink:
            feedback = glidepath.FeedbackRecord(joints=1, sample_ns=glidepath.now_ns())
            sink.send(feedback)
            feedback.position[0] = math.nan
            wrong = self.fails(glidepath.ErrorCode.RECORD, sink.send, feedback)
            self.assertIn("position[0]", str(wrong))

    def test_null_and_other_handles_are_refused(self):
        setpoint = glidepath.SetpointRecord()
        size = ctypes.sizeof(setpoint)
        argument = glidepath.ErrorCode.ARGUMENT
        self.fails(argument, _library.call, "gp_next", None, ctypes.byref(setpoint), size)
        other = self.link._handle
        self.fails(argument, _library.call, "gp_next", other, ctypes.byref(setpoint), size)
        with self.link.setpoints() as setpoints:
            self.fails(argument, _library.call, "gp_next", setpoints._handle, None, size)
            self.fails(
                glidepath.ErrorCode.ABI,
                _library.call,
                "gp_next",
                setpoints._handle,
                ctypes.byref(setpoint),
                size - 8,
            )
        self.assertEqual(_library.call("gp_close", None), 0)

    def test_another_abi_is_refused(self):
        from glidepath._layout import ABI, LAYOUT

        for abi, layout in ((ABI + 1, LAYOUT), (ABI, LAYOUT ^ 1)):
            handle = ctypes.c_void_p()
            refused = self.fails(
                glidepath.ErrorCode.ABI,
                _library.call,
                "gp_open_as",
                INSTANCE.encode(),
                abi,
                layout,
                ctypes.byref(handle),
            )
            self.assertIn("header", str(refused))
            self.assertIsNone(handle.value)


if __name__ == "__main__":
    result = unittest.main(exit=False, argv=sys.argv[:1]).result
    if not result.wasSuccessful():
        raise SystemExit(1)
    print(result.testsRun, "tests passed")
