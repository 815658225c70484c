"""The smallest consumer of setpoints in another language: prints what an interpolator publishes.

    pip install iceoryx2==0.10.0        # the very version that glidepath uses
    python subscribe.py default         # the name of the instance

The field order is that of the record `glidepath.Setpoint.v2` in crates/link/src/record/setpoint.rs.
Ends after five seconds without a setpoint.
"""

import ctypes
import os
import sys
import time

import iceoryx2 as iox2

AXES = ctypes.c_double * 9


class Setpoint(ctypes.Structure):
    _fields_ = [
        (name, ctypes.c_uint64)
        for name in (
            "boot_id", "number", "tick", "scheduled_ns", "apply_ns",
            "lateness_ns", "missed_ticks", "epoch", "sequence",
        )
    ] + [("fraction", ctypes.c_double)] + [
        (name, ctypes.c_uint32)
        for name in ("line", "flags", "marks", "state", "event_kind", "block")
    ] + [
        (name, ctypes.c_double)
        for name in ("event_value", "path_s", "feed_v", "effective_override")
    ] + [
        (name, AXES)
        for name in (
            "position", "velocity", "acceleration",
            "joint_position", "joint_velocity", "joint_acceleration",
        )
    ]

    @staticmethod
    def type_name():
        return "glidepath.Setpoint.v2"


def link_config(instance):
    """Where the instance keeps its files: as `LinkConfig` in crates/link/src/ipc/config.rs."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    if os.path.isabs(runtime) and os.path.isdir(runtime) and os.stat(runtime).st_uid == os.geteuid():
        root = os.path.join(runtime, "glidepath")
    else:
        root = f"/tmp/glidepath-{os.geteuid()}"
    digest = 0x811C9DC5  # FNV-1a
    for byte in os.fsencode(root):
        digest = (digest ^ byte) * 0x01000193 & 0xFFFFFFFF
    directory = os.path.join(root, instance)
    if not os.path.isdir(directory):  # to be made by glidepath, with the right permissions
        sys.exit(f"{directory}: there is no instance {instance!r}; start its interpolator first")
    config = iox2.config.default()
    config.global_cfg.prefix = iox2.FileName.new(f"gp_{instance}_{digest:08x}_")
    config.global_cfg.root_path = iox2.Path.new(directory)
    return config


def main():
    instance = sys.argv[1] if len(sys.argv) > 1 else "default"
    iox2.set_log_level(iox2.LogLevel.Error)
    node = iox2.NodeBuilder.new().config(link_config(instance)).create(iox2.ServiceType.Ipc)
    service = (
        node.service_builder(iox2.ServiceName.new("glidepath/setpoints"))
        .publish_subscribe(Setpoint)
        .open()  # made by the interpolator, never here
    )
    setpoints = service.subscriber_builder().create()
    expected, lost, last_seen = None, 0, time.monotonic()
    while time.monotonic() - last_seen < 5:
        sample = setpoints.receive()
        if sample is None:
            time.sleep(0.001)
            continue
        last_seen = time.monotonic()
        now = sample.payload().contents
        if expected is not None and expected[0] == now.boot_id:
            lost += now.number - expected[1]  # a gap is loss
        expected = (now.boot_id, now.number + 1)
        x, y, z = now.joint_position[:3]
        print(f"tick {now.tick:8} state {now.state} line {now.line:6} at {now.apply_ns} ns: "
              f"{x:10.4f} {y:10.4f} {z:10.4f}  lost {lost}")


if __name__ == "__main__":
    main()
