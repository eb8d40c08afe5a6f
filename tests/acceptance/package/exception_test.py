"""What a host is told of a unit in an emulator that traps once it drives, and resets.

Usage: exception_test.py SONOGLIDE UNIT SOURCE   SOURCE is where it traps.
"""

import pathlib
import re
import subprocess
import sys

SONOGLIDE, UNIT, SOURCE = sys.argv[1:]
EMULATOR = ("qemu-system-arm", "-machine", "mps2-an386", "-nic", "user,restrict=on", "-display", "none",
            "-monitor", "none", "-serial", "pty", "-icount", "shift=5", "-kernel", UNIT)


def connect(device, command):
    return subprocess.run((SONOGLIDE, "connect", device), input=command + "\n", text=True, stdout=subprocess.PIPE,
                          check=False).stdout


with subprocess.Popen(EMULATOR, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True) as emulator:
    try:
        device = re.search(r"/dev/\S+", emulator.stdout.readline())[0]
        connect(device, "restart")  # the reset may take the answer away
        log = connect(device, "log")
    finally:
        emulator.kill()
told = re.search("exception 3 before the reset: program counter (0x[0-9a-f]+),.* fault status 0x00010000, ", log)
assert told, log
place = subprocess.run(("arm-none-eabi-addr2line", "-e", UNIT, told[1]), text=True, stdout=subprocess.PIPE,
                       check=True).stdout
trap = 1 + ['"udf ' in line for line in pathlib.Path(SOURCE).read_text().splitlines()].index(True)
assert f"/{pathlib.Path(SOURCE).name}:{trap}" in place, place
