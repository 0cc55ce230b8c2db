"""PLC links between gateways: link relays and link registers that the FP7s of several processes share.

The MODBUS map of an FP7 (8.2) shows WL and LD as input registers, for reading only. What a station sends therefore comes
from a panel, an FX3U of the same gateway: clients write D0-D7 and M0-M15 there, and routes over MODBUS TCP take D0-D3
to the link registers, D4-D7 to the words of link relays, and M0-M15 to one more word of link relays.
"""

import subprocess

from support import PATIENCE, InteropTest, binary, holds, main, wait_for

WL, LD = 0x0000, 0x07D0  # input registers
FP7, PANEL = 1, 9        # unit ids
RELAYS, BITS = 4, 4      # the send area: four words, and behind them the contacts


def sends(station, first, **more):
    """A station of the link with five words of WL and four LD from `first` on."""
    return {"station": station, "relay_first": first, "relay_count": 5, "register_first": first, "register_count": 4,
            **more}


class PlcLinkTest(InteropTest):
    def start(self, name, link, dds_blocks=(), **more):
        """A gateway with an FP7 of that name and its panel."""
        first = link.get("relay_first", 0)
        block = link.get("block", 0)
        wl, ld = 64 * block + first, 128 * block + first
        routes = [("registers", "holding", 0, 4, f"LD{ld}"), ("relays", "holding", 4, RELAYS, f"WL{wl}"),
                  ("contacts", "coil", 0, 16, f"L{wl + BITS}0")]
        configuration = {
            **self.configuration(), "gateway": name,
            "plcs": [{"name": name, "model": "FP7"}, {"name": "panel"}],
            "lines": [{"name": "self", "host": "127.0.0.1", "protocol": "modbus-tcp"}],
            "stations": [{"name": "panel", "line": "self", "unit": PANEL}],
            "routes": [{"name": route, "station": "panel", "table": table, "first": start, "count": count, "plc": name,
                        "device": device, "period_ms": 10} for route, table, start, count, device in routes],
            "plc_links": [{"name": "cell", "plc": name, **link}],
            "control": {"socket": str(self.folder / f"{name}.sock")},
            **more}
        configuration["dds"]["blocks"] = [{"plc": name, "device": device, "count": count}
                                          for device, count in dds_blocks]
        server = configuration["modbus_tcp"][0]
        server["units"] = [{"unit": FP7, "plc": name}, {"unit": PANEL, "plc": "panel"}]
        configuration["lines"][0]["port"] = server["port"]
        self.folder_of(name).mkdir(exist_ok=True)
        return self.run_again(name, configuration)

    def folder_of(self, name):
        return self.folder / name

    def run_again(self, name, configuration):
        # Each gateway has a configuration file of its own.
        shared, self.folder = self.folder, self.folder_of(name)
        try:
            gateway = self.start_gateway(configuration)
        finally:
            self.folder = shared
        gateway.configuration = configuration
        gateway.fp7 = gateway.client(FP7)
        gateway.panel = gateway.client(PANEL)
        return gateway

    def expect(self, gateway, first, values):
        wait_for(lambda: f"{values}, but it is {gateway.fp7.input(first, len(values))}",
                 lambda: gateway.fp7.input(first, len(values)) == values)

    def heard(self, gateway, text):
        wait_for(f"{gateway.configuration['gateway']} says: {text}", lambda: text in gateway.log)

    def test_words_and_contacts_of_each_station_appear_in_all_others(self):
        gateways = [self.start("one", sends(1, 0)), self.start("two", sends(2, 10)), self.start("three", sends(3, 20))]
        for number, gateway in enumerate(gateways, 1):
            gateway.panel.write_registers(0, [number * 1000 + i for i in range(8)])
            gateway.panel.write_coils(0, [i == number for i in range(16)])
        for gateway in gateways:
            for number in (1, 2, 3):
                first = 10 * (number - 1)
                self.expect(gateway, LD + first, [number * 1000 + i for i in range(4)])
                self.expect(gateway, WL + first, [number * 1000 + 4 + i for i in range(4)] + [1 << number])
        gateways[0].panel.write_coil(15, 1)
        gateways[0].panel.write_coil(1, 0)
        for gateway in gateways[1:]:
            self.expect(gateway, WL + BITS, [0x8000])
        for gateway in gateways:
            self.assertNotIn("refused", gateway.log)

    def test_a_killed_station_leaves_its_words_and_comes_back(self):
        one, two = self.start("one", sends(1, 0)), self.start("two", sends(2, 10))
        one.panel.write_registers(0, [7] * 8)
        self.expect(two, LD, [7] * 4)
        one.kill()
        self.heard(two, "station 1 of gateway one")
        wait_for("two gives it up", lambda: "is gone: its words stay as they were" in two.log)
        holds("the words stay", lambda: two.fp7.input(LD, 4) == [7] * 4, 0.5)

        two.panel.write_registers(0, [9] * 8)
        again = self.run_again("one", one.configuration)
        self.expect(again, LD + 10, [9] * 4)  # what was written while it was away
        self.expect(two, LD, [0] * 4)         # switched on again with nothing in its memory
        again.panel.write_registers(0, [8] * 8)
        self.expect(two, LD, [8] * 4)
        self.assertNotIn("refused", two.log)

    def test_a_station_that_is_started_again_at_once_is_taken_in_at_once(self):
        one, two = self.start("one", sends(1, 0)), self.start("two", sends(2, 10))
        one.panel.write_registers(0, [7] * 8)
        self.expect(two, LD, [7] * 4)
        one.kill()
        again = self.run_again("one", one.configuration)
        again.panel.write_registers(0, [8] * 8)
        self.expect(two, LD, [8] * 4)
        self.assertNotIn("refused", two.log)

    def test_a_station_that_ends_is_missed(self):
        one, two = self.start("one", sends(1, 0)), self.start("two", sends(2, 10))
        self.heard(two, "station 1 of gateway one")
        one.stop()
        self.heard(two, "is gone: its words stay as they were")

    def test_a_station_that_overlaps_is_refused(self):
        one, two = self.start("one", sends(1, 0)), self.start("two", sends(2, 10))
        one.panel.write_registers(0, [7] * 8)
        two.panel.write_registers(0, [9] * 8)
        self.expect(one, LD + 10, [9] * 4)
        three = self.start("three", sends(3, 13))
        three.panel.write_registers(0, [3] * 8)
        why = "is refused: relay_first sends WL13-WL17, which overlaps with WL10-WL14 of station 2"
        self.heard(one, why)
        self.heard(two, why)
        self.expect(three, LD, [7] * 4)  # station 1 is in nobody's way
        holds("its words come in nowhere", lambda: one.fp7.input(LD + 10, 7) == [9] * 4 + [0] * 3, 0.5)
        holds("nor over our own", lambda: two.fp7.input(LD + 10, 7) == [9] * 4 + [0] * 3, 0.5)
        self.assertEqual(one.log.count(why), 1)

    def test_a_station_number_twice_is_refused(self):
        one, two = self.start("one", sends(1, 0)), self.start("two", sends(1, 10))
        two.panel.write_registers(0, [9] * 8)
        self.heard(one, "station 1 of gateway two")
        self.heard(two, "station 1 of gateway one")
        self.heard(one, "is refused: it is the number of this PLC, one")
        holds("nothing comes", lambda: one.fp7.input(LD + 10, 4) == [0] * 4, 0.5)

    def links_of(self, name):
        """plc-gateway plc-link, and how often blanks follow each other does not matter."""
        done = subprocess.run([binary("PLC_GATEWAY"), "plc-link", "--socket", self.folder / f"{name}.sock"], text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [" ".join(line.split()) for line in done.stdout.splitlines()]

    def test_the_command_shows_the_stations(self):
        one = self.start("one", sends(1, 0))
        self.assertEqual(self.links_of("one"), ["cell: one is station 1 of 16, sends WL0-WL4, LD0-LD3",
                                                "no other station was heard"])
        two, three = self.start("two", sends(2, 10)), self.start("three", sends(3, 13))
        self.heard(one, "is refused")
        lines = self.links_of("one")
        self.assertEqual(len(lines), 3)
        self.assertRegex(lines[1], r"^2 two \(.*\) WL10-WL14, LD10-LD13 active for [0-9.]+ s, heard 0\.[0-9] s ago$")
        self.assertRegex(lines[2], r"^3 three \(.*\) WL13-WL17, LD13-LD16 refused for [0-9.]+ s, heard 0\.[0-9] s ago: "
                                   r"relay_first sends WL13-WL17, which overlaps with WL10-WL14 of station 2$")
        three.stop()
        two.kill()
        self.heard(one, "is gone")
        wait_for("both are gone", lambda: [line.split(" gone for ")[0].split()[0] for line in self.links_of("one")[1:]
                                           if " gone for " in line] == ["2", "3"])

    def test_a_plc_program_finds_the_mode_the_station_and_the_areas(self):
        """PMGET of COM.1 (10.3.2), the contacts of 4.1, and the channel reset Y10."""
        one = self.start("one", sends(3, 7, max_station=5), dds_blocks=[("UM100", 26), ("UM150", 7)])
        two = self.start("two", sends(1, 20, max_station=5))
        watch = one.watch()
        # PLC link, station 3, 115200 bit/s, 8 bits, odd, 1 stop bit; block 0, 5 stations, 64 and 128 words, from 7 on.
        watch.expect("one.UM100", values=[9, 3, 9, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 64, 128, 7, 5, 7, 4, 0, 0, 0, 0])
        watch.expect("one.UM150", values=[9, 485, 0, 0, 0, 0, 0])
        self.assertEqual(one.fp7.discrete(0, 0x20), [0] * 0x20)  # neither general-purpose nor a master
        two.panel.write_registers(0, [6] * 8)
        self.expect(one, LD + 20, [6] * 4)
        one.fp7.write_coil(0x10, 1)
        self.assertEqual(one.fp7.discrete(0x10), [1])
        self.heard(one, "channel reset, the stations are taken in anew")
        one.fp7.write_coil(0x10, 0)
        self.assertEqual(one.fp7.discrete(0x10), [0])
        two.panel.write_registers(0, [7] * 8)
        self.expect(one, LD + 20, [7] * 4)
        self.assertEqual(one.log.count("station 1 of gateway two"), 2)

    def test_block_1_takes_the_words_of_block_0(self):
        one, two = self.start("one", sends(1, 0)), self.start("two", sends(2, 10, block=1))
        one.panel.write_registers(0, [7] * 8)
        two.panel.write_registers(0, [9] * 8)
        self.expect(two, LD + 128, [7] * 4)
        self.expect(two, WL + 64, [7] * 4)
        self.expect(one, LD + 10, [9] * 4)
        self.expect(one, WL + 10, [9] * 4)


if __name__ == "__main__":
    main()
