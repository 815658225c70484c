"""Follows the setpoints of an instance, and writes them to a file as they are.

    python3 follow.py default 1000 setpoints.bin
"""

import sys
import time

import glidepath


def follow(instance, count, path):
    with glidepath.Link(instance) as link, link.setpoints() as setpoints, open(path, "wb") as file:
        print("ready", flush=True)
        received, lost, before = 0, 0, None
        heard = time.monotonic()
        while received < count:
            setpoint = setpoints.next()
            if setpoint is None:
                time.sleep(0.001)
                if time.monotonic() - heard > 10:
                    raise SystemExit(f"{received} setpoints, then none for ten seconds")
                continue
            heard = time.monotonic()
            if before is not None and before.boot_id == setpoint.boot_id:
                lost += setpoint.number - before.number - 1  # A gap is loss.
            before = setpoint
            received += 1
            file.write(bytes(setpoint))
    print(f"{received} received, {lost} lost")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit("usage: follow.py INSTANCE COUNT FILE")
    follow(sys.argv[1], int(sys.argv[2]), sys.argv[3])
