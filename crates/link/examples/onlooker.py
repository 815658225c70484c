"""The smallest reader of the mirror in Python: iceoryx2's own package (0.10) and the layout of a record.

    python3 onlooker.py default [ROOT]

The first word is the name of the instance, the second the root of iceoryx2's domain, if the mirror was
given one. Prints what the example in Rust (onlooker.rs) prints, and ends five seconds after the last
setpoint. It is for looking on: any program of the same user can publish there in the mirror's place.
"""

import ctypes
import sys
import time

import iceoryx2 as iox2

Axes = ctypes.c_double * 9


class Event(ctypes.Structure):
    """gp_event of the manual's page of the ABI."""

    _fields_ = [
        ("value", ctypes.c_double),
        ("offset_ns", ctypes.c_uint32),
        ("kind", ctypes.c_uint32),
        ("number", ctypes.c_uint32),
        ("axis", ctypes.c_uint32),
        ("depth_um", ctypes.c_uint32),
        ("phase", ctypes.c_uint32),
    ]


class Setpoint(ctypes.Structure):
    """gp_setpoint of the manual's page of the ABI."""

    _fields_ = [
        *((name, ctypes.c_uint64) for name in (
            "boot_id", "reference", "number", "tick", "scheduled_ns", "apply_ns", "lateness_ns",
            "missed_ticks", "epoch", "sequence")),
        ("fraction", ctypes.c_double),
        *((name, ctypes.c_uint32) for name in (
            "line", "flags", "marks", "state", "event_count", "block", "enable", "home")),
        *((name, ctypes.c_double) for name in ("path_s", "feed_v", "effective_override")),
        *((name, Axes) for name in (
            "position", "velocity", "acceleration", "joint_position", "joint_velocity",
            "joint_acceleration", "away")),
        ("events", Event * 16),
        ("superposed", Axes),
        ("index", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
    ]

    @staticmethod
    def type_name():
        """What iceoryx2 compares, with size and alignment."""
        return "glidepath.SetpointMirror.v6"


def main(instance, root=None):
    """Follows an instance."""
    iox2.set_log_level(iox2.LogLevel.Error)
    config = iox2.config.default()
    if root is not None:
        config.global_cfg.root_path = iox2.Path.new(root)
    node = iox2.NodeBuilder.new().config(config).create(iox2.ServiceType.Ipc)
    name = iox2.ServiceName.new(f"glidepath/{instance}/setpoints")
    # Not open_or_create: what a reader makes has less room than the mirror needs.
    service = node.service_builder(name).publish_subscribe(Setpoint).open()
    setpoints = service.subscriber_builder().create()
    print("ready", flush=True)
    expected, last_seen = None, time.monotonic()
    while time.monotonic() - last_seen < 5:
        sample = setpoints.receive()
        if sample is None:
            time.sleep(0.001)
            continue
        last_seen = time.monotonic()
        setpoint = sample.payload().contents
        if expected is not None and expected[0] == setpoint.boot_id and expected[1] < setpoint.number:
            print(f"gap {expected[1]} to {setpoint.number - 1}")
        expected = (setpoint.boot_id, setpoint.number + 1)
        x, y, z = setpoint.position[:3]
        print(f"{setpoint.number} {setpoint.line} {x} {y} {z}")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        raise SystemExit("usage: onlooker.py INSTANCE [ROOT]")
    main(*sys.argv[1:])
