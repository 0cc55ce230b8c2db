#!/usr/bin/python3
"""The JSON Schema that ships: what the program says, good draft 2020-12, and true for the files beside it."""
import json
import unittest

import jsonschema

from support import PROGRAM, ROOT, SCHEMA_FILE, SHIPPED, gateway, read_jsonc, without_comments


def objects(schema):
    """Every schema of an object in it."""
    if "properties" in schema:
        yield schema
    for inner in [*schema.get("properties", {}).values(), *([schema["items"]] if "items" in schema else [])]:
        yield from objects(inner)


class Schema(unittest.TestCase):
    def setUp(self):
        self.schema = json.loads(SCHEMA_FILE.read_text(encoding="utf-8"))

    def test_the_shipped_schema_is_what_the_program_says(self):
        answer = gateway("schema")
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))
        if answer.stdout.encode() != SCHEMA_FILE.read_bytes():
            self.fail(f"{SCHEMA_FILE.name} is not that of this program. Make it again:\n"
                      f"  {PROGRAM} schema > {SCHEMA_FILE.relative_to(ROOT)}")

    def test_it_is_a_schema_of_draft_2020_12(self):
        self.assertEqual(self.schema["$schema"], "https://json-schema.org/draft/2020-12/schema")
        jsonschema.Draft202012Validator.check_schema(self.schema)

    def test_every_object_is_closed_and_every_key_described(self):
        described = list(objects(self.schema))
        self.assertGreaterEqual(len(described), 11)
        for each in described:
            self.assertIs(each["additionalProperties"], False)
            self.assertLessEqual(set(each.get("required", [])), set(each["properties"]))
            for key, inner in each["properties"].items():
                with self.subTest(key):
                    self.assertTrue(inner["description"])
                    self.assertTrue("enum" in inner or "type" in inner)
                    if "default" in inner:
                        jsonschema.validate(inner["default"], inner, jsonschema.Draft202012Validator)

    def test_the_shipped_files_are_valid(self):
        self.assertGreaterEqual(len(SHIPPED), 2)
        validator = jsonschema.Draft202012Validator(self.schema)
        for path in SHIPPED:
            with self.subTest(path.name):
                text = path.read_text(encoding="utf-8")
                config = read_jsonc(text)
                self.assertEqual([e.message for e in validator.iter_errors(config)], [])
                if "$schema" in config:
                    self.assertEqual((path.parent / config["$schema"]).resolve(), SCHEMA_FILE)

    def test_the_commented_out_examples_are_valid_too(self):
        """etc/plc-gateway.json shows a line in comments, which is what its reader will uncomment."""
        text = (ROOT / "etc" / "plc-gateway.json").read_text(encoding="utf-8")
        lines = [line.replace("// ", "", 1) if line.startswith(("  // \"", "  //   ", "  // ]")) else line
                 for line in text.splitlines()]
        config = read_jsonc("\n".join(lines))
        self.assertLessEqual({"lines", "stations", "routes"}, set(config))
        jsonschema.validate(config, self.schema, jsonschema.Draft202012Validator)


class Comments(unittest.TestCase):
    def test_our_reader_of_json_with_comments(self):
        rows = {
            "{} // a": {},
            "/* [ */ [1, // \"\n2]": [1, 2],
            '["//", "/* a */", "\\"//"]': ["//", "/* a */", '"//'],
            "[1/**/,/***/2/* \n */]": [1, 2],
        }
        for text, value in rows.items():
            with self.subTest(text):
                self.assertEqual(read_jsonc(text), value)
        self.assertEqual(without_comments("/*\n*/1").count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
