#!/usr/bin/python3
"""Schema and `plc-gateway check` refuse and accept the same values, for every key there is."""
import copy
import json
import re
import unittest

import jsonschema

from support import SCHEMA_FILE, Checked, read_jsonc

SCHEMA = json.loads(SCHEMA_FILE.read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

# Correct, and with every key: a new one must be added here.
FULL = {
    "$schema": "plc-gateway.schema.json",
    "gateway": "plant",
    "plcs": [{"name": "a", "model": "FX3U", "program": ["LD M8411", "MOV K0 D8470"],
              "channels": [{"channel": 1, "line": "l"}]},
             {"name": "b", "program_file": "setup.txt"}, {"name": "c", "model": "FP7"}],
    "lines": [{"name": "l", "device": "/dev/ttyS0", "protocol": "modbus-rtu", "baud_rate": 9600, "data_bits": 8,
               "parity": "none", "stop_bits": 2, "low_latency": False,
               "rs485": {"enabled": True, "rts_on_send": True, "rts_after_send": False, "rx_during_tx": False,
                         "delay_before_send_ms": 1, "delay_after_send_ms": 1},
               "response_timeout_ms": 300, "learn_timeout": True, "least_timeout_ms": 30, "forward_cache_ms": 100,
               "retries": 1, "turnaround_delay_ms": 50, "gap_us": 0, "silence_ms": 20},
              {"name": "m", "host": "localhost", "port": 1503, "protocol": "modbus-tcp", "role": "client",
               "max_outstanding": 4, "local_echo": "off"},
              {"name": "n", "device": "/dev/ttyS1", "role": "server",
               "units": [{"unit": 1, "plc": "a", "channel": 2, "line": "", "line_unit": 0}]},
              {"name": "o", "device": "/dev/ttyS2", "protocol": "general-purpose", "general_purpose": {
                  "start_code": "stx", "end_code": "etx", "end_silence_us": 0, "abandon_ms": 100, "send_wait_ms": 0,
                  "received": [{"name": "raw", "plc": "a", "device": "D200", "count": 10, "ready": "M0",
                                "when_full": "stop"}],
                  "messages": [{"name": "weighing", "pattern": "{state:text(2)},{weight:number}kg", "plc": "a",
                                "longest_silence_ms": 1000, "answer_to": "ask", "fields": [
                                    {"name": "weight", "device": "D210", "type": "int32", "decimals": 1,
                                     "word_order": "high-first"},
                                    {"name": "state", "device": "D212", "type": "text", "characters": 2}]}],
                  "sends": [{"name": "ask", "text": "W", "period_ms": 500, "answer": True, "response_timeout_ms": 100},
                            {"name": "tell", "plc": "a", "device": "D220", "count": 10, "trigger": "M1"}],
                  "dds_sends": True, "status": {"plc": "a", "device": "D230", "reset": "M2"}}},
              {"name": "w", "device": "/dev/ttyS4", "protocol": "mewtocol-com"},
              {"name": "p", "device": "/dev/ttyS3", "protocol": "mewtocol7-com", "role": "server",
               "units": [{"unit": 300, "plc": "c", "channel": 0, "line": "", "line_unit": 0}],
               "mewtocol": {"commands": "all", "expansion": True, "several_frames": True, "rest_kept_ms": 1000,
                            "max_contacts": 80, "max_words": 16,
                            "dialect": {"item": "D001", "scope": "G0", "address_digits": 8, "count_digits": 5,
                                        "base": "decimal", "words": "low-byte-first", "before_words": "",
                                        "before_error": "", "before_piece": "", "dt": "DT", "ld": "LD", "wx": "WX",
                                        "wy": "WY", "wr": "WR", "wl": "WL"}}}],
    "stations": [{"name": "s", "line": "l", "unit": 1, "response_timeout_ms": 100, "retries": 0,
                  "merge": "adjacent", "max_registers": 60, "max_bits": 500,
                  "status": {"plc": "b", "device": "D500", "order": "ABCD"}},
                 {"name": "t", "line": "l", "unit": 2}, {"name": "p", "line": "w", "unit": 7}],
    "routes": [{"name": "r", "station": "s", "table": "input", "first": 0, "count": 2, "plc": "a", "device": "D100",
                "direction": "read", "period_ms": 500},
               {"name": "q", "station": "p", "source": "DT100", "count": 2, "plc": "a", "device": "D300",
                "on_loss": "value", "loss_value": [1, 2], "status": {"plc": "b", "device": "D510", "order": "CDAB"}},
               {"name": "u", "station": "s", "table": "holding", "first": 9, "plc": "a", "device": "D310",
                "direction": "write", "upstream": {"longest_silence_ms": 5000, "safe": [0]}},
               {"name": "v", "from": {"plc": "a", "device": "D100"}, "count": 2, "plc": "b", "device": "D100"}],
    "points": [{"name": "boiler.temp", "plc": "a", "device": "D100", "type": "int32", "order": "CDAB", "scale": 0.1,
                "offset": -40, "unit": "Cel", "min": -40, "max": 120, "outside": "reject", "deadband": 0.5,
                "longest_silence_ms": 30000, "writable": False},
               {"name": "boiler.on", "plc": "a", "device": "D110", "type": "bool", "bit": 3, "writable": True},
               {"name": "boiler.level", "plc": "a", "device": "D112", "min": 0, "max": 3000, "deadband_percent": 1},
               {"name": "boiler.tag", "plc": "a", "device": "D120", "type": "text", "characters": 10}],
    "modbus_tcp": [{"listen": "127.0.0.1", "port": 1502, "units": [{"unit": 1, "plc": "a"}, {"unit": 2, "line": "m", "line_unit": 3, "plc": "", "channel": 1}],
                    "framing": "tcp", "other_units": "a", "max_clients": 10, "idle_timeout_s": 60, "max_outstanding": 8}],
    "plc_links": [{"name": "k", "plc": "c", "station": 1, "block": 0, "max_station": 4, "relay_words": 64,
                   "register_words": 128, "relay_first": 0, "relay_count": 4, "register_first": 0,
                   "register_count": 4}],
    "dds": {"enabled": True, "writes": True, "domain": 3, "interface": "lo", "peers": ["10.0.0.1"],
            "partition": "plant", "member": "m", "longest_silence_ms": 500, "status_silence_ms": 5000, "partitions": ["plant2"], "lease_ms": 3000,
            "cyclone_config": "",
            "topics": {**{name: {"enabled": True, "reliability": "best-effort", "history": "keep-last",
                                 "extensibility": "final", "deadline_ms": 100_000}
                          for name in ("register_block", "point", "port_status", "device_status", "gateway_status")},
                       **{name: {"enabled": False, "reliability": "reliable", "history": "keep-last",
                                 "extensibility": "final", "depth": 1000} for name in ("event", "serial_message")}},
            "blocks": [{"plc": "a", "device": "D0", "count": 4, "writable": True}]},
    "standby": {"priority": 100, "hand_back": True, "lease_ms": 500, "line_silence_ms": 2000, "listen_ms": 2000,
                "hand_back_after_ms": 5000},
    "log": {"level": "info"},
    "control": {"socket": "control.sock"},
    "state": {"folder": "state"},
}
FILES = {"setup.txt": "LD M8411\n"}

# What the reader says, and no cross-check.
READER = re.compile(r"expected (a text|a whole number|a number|true or false|one of|an array)|is (empty|no |longer)|too short"
                    r"|has no")


def pointer(path):
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)


def at(config, path):
    for step in path:
        config = config[step]
    return config


def walk(schema, config, path=()):
    """(path, schema) of every value in the configuration."""
    yield path, schema
    if "properties" in schema:
        for key, value in config.items():
            yield from walk(schema["properties"][key], value, (*path, key))
    elif "items" in schema:
        for i, value in enumerate(config):
            yield from walk(schema["items"], value, (*path, i))


def is_leaf(schema):
    return "properties" not in schema and "items" not in schema


def wrong_values(schema):
    if "enum" in schema:
        return ["nonsense", schema["enum"][0].swapcase(), "", 0, None, True, [], {}]
    if schema["type"] == "boolean":
        return [0, 1, "true", None, [], {}]
    if schema["type"] == "integer":
        return [schema["minimum"] - 1, schema["maximum"] + 1, str(schema["minimum"]), schema["minimum"] + 0.5, None,
                True, [], {}, 1e300, -1e300, 2**64, -2**63]
    if schema["type"] == "number":
        return [schema["minimum"] - abs(schema["minimum"]) - 1, schema["maximum"] * 2, "1", None, True, [], {}]
    if schema["type"] == "string":
        short = [] if schema.get("minLength", 0) == 0 else ["x" * (schema["minLength"] - 1)]
        return [0, 1.5, None, False, ["x"], {"x": "x"}, "x" * (schema["maxLength"] + 1), *short]
    return [0, "x", None, True, {} if schema["type"] == "array" else []]


def right_values(schema):
    if "enum" in schema:
        return schema["enum"]
    if schema["type"] == "boolean":
        return [True, False]
    if schema["type"] == "integer":
        return [schema["minimum"], schema["maximum"], float(schema["maximum"]), schema["maximum"] - 1]
    if schema["type"] == "number":
        return [schema["minimum"], schema["maximum"], schema["maximum"] / 3]
    if schema["type"] == "string":
        return ["x" * max(1, schema.get("minLength", 0)), "x" * schema["maxLength"]]
    return [[]] if schema["type"] == "array" else []


def schema_pointers(config):
    return {pointer(error.absolute_path) for error in VALIDATOR.iter_errors(config)}


class EveryKey(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.values = list(walk(SCHEMA, FULL))[1:]

    def check(self, config):
        return Checked(json.dumps(config, indent=1), FILES)

    def test_the_full_configuration_is_correct_and_full(self):
        self.assertEqual(schema_pointers(FULL), set())
        self.assertEqual(self.check(FULL).lines, [])
        for path, schema in walk(SCHEMA, FULL):
            if "properties" in schema and isinstance(path[-1:][0] if path else "", str):
                self.assertEqual(set(at(FULL, path)), set(schema["properties"]), pointer(path))
            if "items" in schema and "properties" in schema["items"]:
                keys = set().union(*at(FULL, path))
                self.assertEqual(keys, set(schema["items"]["properties"]), pointer(path))

    def test_each_key_has_one_mistake_for_each_wrong_value(self):
        """All keys are wrong at once: as many mistakes as keys, and no other."""
        leaves = [(path, wrong_values(schema)) for path, schema in self.values if is_leaf(schema)]
        self.assertGreater(len(leaves), 60)
        for turn in range(max(len(values) for _, values in leaves)):
            config = copy.deepcopy(FULL)
            for path, values in leaves:
                at(config, path[:-1])[path[-1]] = values[turn % len(values)]
            expected = sorted(pointer(path) for path, _ in leaves)
            with self.subTest(turn):
                self.assertEqual(sorted(schema_pointers(config)), expected)
                self.assertEqual(sorted(self.check(config).pointers), expected)

    def test_each_container_has_one_mistake(self):
        """All of one depth at once."""
        containers = [(path, wrong_values(schema)) for path, schema in self.values if not is_leaf(schema)]
        self.assertGreater(len(containers), 20)
        for depth in sorted({len(path) for path, _ in containers}):
            level = [(path, values) for path, values in containers if len(path) == depth]
            for turn in range(len(level[0][1])):
                config = copy.deepcopy(FULL)
                for path, values in level:
                    at(config, path[:-1])[path[-1]] = values[turn]
                expected = sorted(pointer(path) for path, _ in level)
                with self.subTest(depth=depth, turn=turn):
                    self.assertEqual(sorted(schema_pointers(config)), expected)
                    self.assertEqual(sorted(self.check(config).pointers), expected)

    def test_the_reader_takes_what_the_schema_takes(self):
        leaves = [(path, right_values(schema)) for path, schema in self.values if is_leaf(schema)]
        for turn in range(max(len(values) for _, values in leaves)):
            config = copy.deepcopy(FULL)
            for path, values in leaves:
                at(config, path[:-1])[path[-1]] = values[turn % len(values)]
            with self.subTest(turn):
                self.assertEqual(schema_pointers(config), set())
                lines = [line for line in self.check(config).lines if READER.search(line.split(": ", 1)[-1])]
                # These are texts to the schema, and more to the cross-checks.
                of_texts = re.compile(r"/(model|device|listen|peers/0) .*expected|program/\d+ unknown|"
                                      r"fields/\d+ does not fit|pattern is wrong")
                self.assertEqual([line for line in lines if not of_texts.search(line)], [])

    def test_required_keys(self):
        """One is missing in every row that has any, then the next one."""
        rows = [(path, schema["required"]) for path, schema in walk(SCHEMA, FULL) if "required" in schema]
        self.assertGreater(len(rows), 8)
        for turn in range(max(len(keys) for _, keys in rows)):
            config = copy.deepcopy(FULL)
            missing = {pointer(path): keys[turn % len(keys)] for path, keys in rows}
            for path, keys in rows:
                del at(config, path)[keys[turn % len(keys)]]
            with self.subTest(turn):
                self.assertEqual(schema_pointers(config), set(missing))
                checked = self.check(config)
                self.assertEqual(sorted(checked.pointers), sorted(missing))
                for mistake, line in zip(checked.mistakes, checked.lines):
                    self.assertIn(f'{mistake["pointer"]} has no "{missing[mistake["pointer"]]}"', line)

    def test_optional_keys(self):
        """Without all of them, lists and objects apart, the file can still be read."""
        config = copy.deepcopy(FULL)
        for path, schema in reversed(list(walk(SCHEMA, FULL))):
            for key in set(schema.get("properties", {})) - set(schema.get("required", [])):
                if not isinstance(at(config, path).get(key), (list, dict)):
                    at(config, path).pop(key, None)
        self.assertEqual(schema_pointers(config), set())
        # What a line or unit needs depends on what it is: that is for the cross-checks.
        self.assertEqual([line for line in self.check(config).lines if READER.search(line.split(": ", 1)[-1])], [])

    def test_unknown_keys(self):
        """One in every object at once."""
        config = copy.deepcopy(FULL)
        expected = []
        for path, schema in walk(SCHEMA, FULL):
            if "properties" in schema:
                at(config, path)["an/unknown key"] = {"a": 1}
                expected.append(path)
        self.assertEqual(schema_pointers(config), {pointer(path) for path in expected})
        checked = self.check(config)
        self.assertEqual(len(checked.mistakes), len(expected))
        for line in checked.lines[:-1]:
            self.assertIn("/an~1unknown key is no known key: known are ", line)


RIGHT = {
    "nothing": "{}",
    "comments": "// one\n{ /* two */ \"log\": { \"level\": \"info\" } // three\n}",
    "empty lists": '{"plcs": [], "lines": [], "stations": [], "routes": [], "modbus_tcp": [], "dds": {"blocks": []}}',
    "a PLC for every unit": '{"plcs": [{"name": "a"}], "modbus_tcp": [{"other_units": "a"}]}',
    "a server on each of two addresses": """{"plcs": [{"name": "a"}], "modbus_tcp": [
        {"listen": "127.0.0.1", "other_units": "a"}, {"listen": "127.0.0.2", "other_units": "a"}]}""",
    "whole floats": '{"dds": {"domain": 7.0, "longest_silence_ms": 1e3}}',
    "a name of 64 bytes": '{"gateway": "' + "a" * 64 + '"}',
    "a name in other letters": '{"gateway": "Werk Süd"}',
    "no DDS": '{"dds": {"enabled": false}}',
    "any interface": '{"dds": {"interface": ""}}',
    "a bare line": '{"lines": [{"name": "l", "device": "/dev/serial/by-id/usb-x"}]}',
    "a broadcast": """{"plcs": [{"name": "a"}], "lines": [{"name": "l", "device": "/dev/ttyS0"}],
        "stations": [{"name": "all", "line": "l", "unit": 0}],
        "routes": [{"name": "r", "station": "all", "table": "holding", "first": 65535, "plc": "a", "device": "CN200",
                    "direction": "write"}]}""",
}

WRONG = {
    "an array": "[]",
    "a text": '"a"',
    "null": "null",
    "a list that is an object": '{"plcs": {"name": "a"}}',
    "a list that is null": '{"plcs": null}',
    "a row that is a text": '{"plcs": ["a"]}',
    "a nameless PLC": '{"plcs": [{}]}',
    "an empty name": '{"plcs": [{"name": ""}]}',
    "a name of 65 letters": '{"gateway": "' + "a" * 65 + '"}',
    "a program that is one text": '{"plcs": [{"name": "a", "program": "LD M8411"}]}',
    "an unknown key": '{"plc": []}',
    "a key in capitals": '{"PLCS": []}',
    "a quoted number": '{"dds": {"domain": "0"}}',
    "a fraction": '{"dds": {"domain": 0.5}}',
    "a quoted boolean": '{"dds": {"enabled": "false"}}',
    "parity in capitals": '{"lines": [{"name": "l", "device": "d", "parity": "None"}]}',
    "three stop bits": '{"lines": [{"name": "l", "device": "d", "stop_bits": 3}]}',
    "one and a half stop bits": '{"lines": [{"name": "l", "device": "d", "stop_bits": 1.5}]}',
    "TCP port 0": '{"plcs": [{"name": "a"}], "modbus_tcp": [{"port": 0, "other_units": "a"}]}',
    "unit 1000": '{"lines": [{"name": "l", "device": "d"}], "stations": [{"name": "s", "line": "l", "unit": 1000}]}',
    "a peer that is no text": '{"dds": {"peers": [1]}}',
}

# JSON Schema cannot say these: an editor stays silent, `check` does not.
ONLY_CHECK = {
    "unit 248": '{"lines": [{"name": "l", "device": "d"}], "stations": [{"name": "s", "line": "l", "unit": 248}]}',
    "a line without a port": '{"lines": [{"name": "l"}]}',
    "a line with an empty port": '{"lines": [{"name": "l", "device": ""}]}',
    "a TCP line without a host": '{"lines": [{"name": "l", "protocol": "modbus-tcp"}]}',
    "a server line that serves nobody": '{"lines": [{"name": "l", "device": "d", "role": "server"}]}',
    "a unit that leads nowhere": '{"modbus_tcp": [{"units": [{"unit": 1}]}]}',
    "a channel on a server line": '{"plcs": [{"name": "a", "channels": [{"channel": 2, "line": "l"}]}], "lines": '
                                  '[{"name": "l", "device": "d", "role": "server", "units": [{"unit": 1, "plc": "a"}]}]}',
    "a channel that an FX3S lacks": '{"plcs": [{"name": "a", "model": "FX3S"}], "lines": [{"name": "l", "device": "d", '
                                    '"role": "server", "units": [{"unit": 1, "plc": "a", "channel": 2}]}]}',
    "a key that stands twice": '{"gateway": "a", "gateway": "b"}',
    "64 letters in more bytes": '{"gateway": "' + "ü" * 64 + '"}',
    "a line break in a name": '{"gateway": "a\\nb"}',
    "a PLC that does not exist": '{"modbus_tcp": [{"other_units": "a"}]}',
    "an unknown model": '{"plcs": [{"name": "a", "model": "S7"}]}',
    "two PLCs of one name": '{"plcs": [{"name": "a"}, {"name": "a"}]}',
    "a server on a host name": '{"plcs": [{"name": "a"}], "modbus_tcp": [{"listen": "localhost", "other_units": "a"}]}',
    "a server without a PLC": '{"modbus_tcp": [{}]}',
    "a peer that is a host name": '{"dds": {"peers": ["plant-b"]}}',
    "7 data bits": '{"lines": [{"name": "l", "device": "d", "data_bits": 7}]}',
    "a general-purpose line that does nothing": '{"lines": [{"name": "l", "device": "d", "protocol": '
                                                '"general-purpose"}]}',
    "a pattern with a mistake": '{"plcs": [{"name": "a"}], "lines": [{"name": "l", "device": "d", "protocol": '
                                '"general-purpose", "general_purpose": {"messages": [{"name": "m", "plc": "a", '
                                '"pattern": "W{x:numbr}"}]}}]}',
    "a word that is no instruction": '{"plcs": [{"name": "a", "program": ["HELLO"]}]}',
}


class Snippets(unittest.TestCase):
    def test_right_for_both(self):
        for name, text in RIGHT.items():
            with self.subTest(name):
                self.assertEqual(schema_pointers(read_jsonc(text)), set())
                self.assertEqual(Checked(text).lines, [])

    def test_wrong_for_both(self):
        for name, text in WRONG.items():
            with self.subTest(name):
                self.assertNotEqual(schema_pointers(read_jsonc(text)), set())
                checked = Checked(text)
                self.assertEqual(checked.status, 1)
                self.assertEqual(len(checked.mistakes), 1, checked.lines)

    def test_only_check_knows(self):
        for name, text in ONLY_CHECK.items():
            with self.subTest(name):
                self.assertEqual(schema_pointers(read_jsonc(text)), set())
                checked = Checked(text)
                self.assertEqual(checked.status, 1)
                self.assertEqual(len(checked.mistakes), 1, checked.lines)


if __name__ == "__main__":
    unittest.main()
