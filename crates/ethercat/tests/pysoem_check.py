"""Brings emulated drives into operation with SOEM, a master by other people: pysoem_check.py INTERFACE"""

import struct
import sys
import time

import pysoem

OUTPUTS = [0x60400010, 0x607A0020, 0x60600008]
INPUTS = [0x60410010, 0x60640020, 0x60610008, 0x603F0010]


def configure(master, position):
    drive = master.slaves[position]
    for assigned, mapped, entries in ((0x1C12, 0x1600, OUTPUTS), (0x1C13, 0x1A00, INPUTS)):
        drive.sdo_write(assigned, 0, bytes([0]))
        drive.sdo_write(mapped, 0, bytes([0]))
        for sub, entry in enumerate(entries, 1):
            drive.sdo_write(mapped, sub, struct.pack("<I", entry))
        drive.sdo_write(mapped, 0, bytes([len(entries)]))
        drive.sdo_write(assigned, 1, struct.pack("<H", mapped))
        drive.sdo_write(assigned, 0, bytes([1]))


def cycle(master, controls):
    for drive, control in zip(master.slaves, controls):
        status, actual = struct.unpack_from("<Hi", drive.input) if len(drive.input) >= 6 else (0, 0)
        drive.output = struct.pack("<Hib", control, actual, 8)
    master.send_processdata()
    counter = master.receive_processdata(20_000)
    time.sleep(0.002)
    return counter, [struct.unpack("<Hibh", bytes(drive.input)) for drive in master.slaves]


def main():
    master = pysoem.Master()
    master.open(sys.argv[1])
    found = master.config_init()
    print(f"{found} drives:", [(s.name, hex(s.man), hex(s.id)) for s in master.slaves])
    for position in range(found):
        configure(master, position)
    master.config_map()
    master.config_dc()
    assert master.state_check(pysoem.SAFEOP_STATE, 500_000) == pysoem.SAFEOP_STATE
    print("SAFE-OP, refused object:", end=" ")
    try:
        master.slaves[0].sdo_read(0x2345, 0)
    except pysoem.SdoError as error:
        print(hex(error.abort_code))
    master.state = pysoem.OP_STATE
    master.write_state()
    for _ in range(50):
        counter, _ = cycle(master, [0] * found)
    assert master.state_check(pysoem.OP_STATE, 500_000) == pysoem.OP_STATE
    print("OP, working counter", counter, "of", master.expected_wkc)
    assert counter == master.expected_wkc
    seen = []
    for control in [0x06] * 5 + [0x07] * 5 + [0x0F] * 30:
        counter, inputs = cycle(master, [control] * found)
        assert counter == master.expected_wkc
        if not seen or seen[-1] != inputs[0][0]:
            seen.append(inputs[0][0])
    print("statuswords of the first drive:", [hex(word) for word in seen])
    assert all(status & 0x6F == 0x27 for status, *_ in inputs), inputs
    master.state = pysoem.INIT_STATE
    master.write_state()
    print("all", found, "drives were enabled, and are back in INIT")


main()
