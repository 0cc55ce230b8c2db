"""What an engineer writes with pymodbus: reads the given blocks round and round as fast as it goes, until SIGTERM.

usage: pymodbus_loop.py DEVICE BAUD UNIT FIRST:COUNT...
"""

import sys

from pymodbus.client import ModbusSerialClient


def main(device, baud, unit, *blocks):
    # 11 bits as with even parity, which this pyserial cannot set on a pty.
    client = ModbusSerialClient(port=device, baudrate=int(baud), parity="N", stopbits=2, timeout=3)
    if not client.connect():
        sys.exit(f"cannot open {device}")
    pairs = [[int(number) for number in block.split(":")] for block in blocks]
    while True:
        for first, count in pairs:
            answer = client.read_holding_registers(first, count, int(unit))
            if answer.isError():
                print(answer, file=sys.stderr, flush=True)


main(*sys.argv[1:])
