"""pymodbus as a server: unit 1, or others, with 100 items in each table. Prints "ready", and each item that is written:
  wrote holding 50 1234
usage: pymodbus_server.py tcp|rtu|ascii|rtu-over-tcp|ascii-over-tcp PORT|DEVICE [UNITS, as 1,5]
"""

import asyncio
import sys

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.device import ModbusDeviceIdentification
from pymodbus.framer.ascii_framer import ModbusAsciiFramer
from pymodbus.framer.rtu_framer import ModbusRtuFramer
from pymodbus.framer.socket_framer import ModbusSocketFramer
from pymodbus.server.async_io import ModbusSerialServer, ModbusTcpServer

from peer_servers import INITIAL, SIZE

FRAMERS = {"tcp": ModbusSocketFramer, "rtu": ModbusRtuFramer, "ascii": ModbusAsciiFramer}


class Table(ModbusSequentialDataBlock):
    def __init__(self, name):
        super().__init__(0, [INITIAL[name](at) for at in range(SIZE)])
        self.name = name

    def setValues(self, address, values):
        super().setValues(address, values)
        for at, value in enumerate(values if isinstance(values, list) else [values], address):
            print(f"wrote {self.name} {at} {int(value)}", flush=True)


async def main(framing, where, units="1"):
    unit = ModbusSlaveContext(co=Table("coils"), di=Table("discrete"), hr=Table("holding"), ir=Table("input"),
                              zero_mode=True)
    options = {"context": ModbusServerContext(slaves={int(each): unit for each in units.split(",")}, single=False), "framer": FRAMERS[framing.split("-")[0]],
               "identity": ModbusDeviceIdentification(info_name={"VendorName": "Debian", "ProductCode": "pymodbus",
                                                                 "MajorMinorRevision": "3.0"}),
               "broadcast_enable": True, "ignore_missing_slaves": True}
    if "tcp" in framing:
        server = ModbusTcpServer(address=("127.0.0.1", int(where)), allow_reuse_address=True, **options)
        running = asyncio.create_task(server.serve_forever())
        await server.serving
    else:
        server = ModbusSerialServer(port=where, baudrate=19200, parity="N", timeout=0.001, **options)
        await server.start()
        running = asyncio.create_task(server.serve_forever())
    print("ready", flush=True)
    await running


asyncio.run(main(*sys.argv[1:]))
