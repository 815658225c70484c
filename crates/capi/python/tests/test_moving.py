"""Jogs and segments against an instance, which the test of the library runs, and which looks at what
arrived. The argument is its name."""

import math
import sys
import time

import glidepath


def jog(link):
    # The interpolator keeps the last four demands: each is to be seen.
    with link.jog() as hand:
        try:
            hand.keep()
        except glidepath.Error as error:
            assert error.code == glidepath.ErrorCode.ARGUMENT, error
        else:
            raise SystemExit("nothing could be kept, and was")
        for ask in (
            lambda: hand.move([5.0, 0.0, -2.0]),
            hand.keep,
            lambda: hand.step({0: 0.25}, velocity=3.0, by_joint=True),
            hand.let_go,
            lambda: hand.step([-0.25]),
        ):
            ask()
            time.sleep(0.05)
        # Nobody follows here: what another client is told is no result of this one.
        assert not hand.is_followed(glidepath.StatusRecord(jog_client=1, jog_number=4))
        try:
            hand.send(glidepath.JogRecord(mode=1, velocity_v=math.nan))
        except glidepath.Error as error:
            assert error.code == glidepath.ErrorCode.RECORD, error
            assert "velocity_v" in str(error), error
        else:
            raise SystemExit("what is no number was sent")
    time.sleep(0.05)


def stream(link):
    with link.segments(patience=10.0) as stream:
        x, y = stream.position[:2]
        stream.line_to([x + 10.0])
        stream.line_to({0: x + 10.0, 1: y + 10.0}, feed=25.0, tolerance=0.01)
        try:
            stream.line_to({0: 1e6}, feed=25.0)
        except glidepath.Refused as refused:
            assert refused.reply.refusal == glidepath.SegmentRefusal.SOFT_LIMIT, refused
            assert "beyond" in str(refused), refused
        else:
            raise SystemExit("what leaves the machine was accepted")
        half = math.pi
        stream.arc_to({1: y}, center=(x + 10.0, y + 5.0), sweep=-half, feed=10.0)
        stream.dwell(0.5)
        stream.end()


def nobody():
    with glidepath.Link("nobody-here") as link:
        try:
            link.segments()
        except glidepath.Error as error:
            assert error.code == glidepath.ErrorCode.NO_SERVER, error
        else:
            raise SystemExit("somebody was there")


if __name__ == "__main__":
    with glidepath.Link(sys.argv[1]) as link:
        jog(link)
        stream(link)
    nobody()
    print("3 tests passed")
