#!/usr/bin/python3
"""Validates documents against a JSON Schema by python3-jsonschema: validate.py SCHEMA DOCUMENTS

DOCUMENTS has one document a line, {"json": value}, {"yaml": text} or {"yaml 1.1": text}. Prints a line for each: "right",
or "wrong" and the first complaint. YAML is read as editors read it, by version 1.2's core schema, or as PyYAML alone
does, by 1.1; what is no YAML is wrong. Fails if the schema itself is not right, or a default or an example in it is not.
"""
import json
import re
import sys

import jsonschema
import yaml


class Reader(yaml.CSafeLoader):
    """PyYAML's reader with the scalars of YAML 1.2 (section 10.3.2), and keys that are text as JSON's are."""

    def construct_object(self, node, deep=False):
        if isinstance(node, yaml.MappingNode):
            for key, _ in node.value:
                key.tag = "tag:yaml.org,2002:str"
        return super().construct_object(node, deep)


NUMBER = r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)"
SCALARS = (
    ("null", "~|null|Null|NULL|", ["~", "n", "N", ""]),
    ("bool", "true|True|TRUE|false|False|FALSE", list("tTfF")),
    ("int", "[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", list("-+0123456789")),
    ("float", NUMBER, list("-+0123456789.")),
)


def whole(_, node):
    return int(node.value, 0 if node.value[:2] in ("0x", "0o") else 10)


def number(_, node):
    return float(node.value.replace(".inf", "inf").replace(".nan", "nan"))


Reader.yaml_implicit_resolvers = {}
for tag, pattern, first in SCALARS:
    Reader.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile("^(?:" + pattern + ")$"), first)
Reader.add_constructor("tag:yaml.org,2002:int", whole)
Reader.add_constructor("tag:yaml.org,2002:float", number)


def read(document):
    if "json" in document:
        return document["json"]
    if "yaml" in document:
        return yaml.load(document["yaml"], Reader)
    return yaml.safe_load(document["yaml 1.1"])


def check_values(part, definitions):
    """Validates defaults and examples against their own schemas."""
    if isinstance(part, list):
        for item in part:
            check_values(item, definitions)
    elif isinstance(part, dict):
        if isinstance(part.get("examples"), list):
            values = part["examples"] + ([part["default"]] if "default" in part else [])
            for value in values:
                jsonschema.Draft7Validator({**part, "definitions": definitions}).validate(value)
        for key, item in part.items():
            if key not in ("examples", "default", "enum", "const"):
                check_values(item, definitions)


def main(schema_file, documents_file):
    with open(schema_file, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    check_values(schema, schema["definitions"])
    validator = jsonschema.Draft7Validator(schema)
    with open(documents_file, encoding="utf-8") as file:
        for line in file:
            document = json.loads(line)
            try:
                value = read(document)
            except yaml.YAMLError as error:
                print("wrong", str(error).split("\n")[0])
                continue
            error = next(validator.iter_errors(value), None)
            if error is None:
                print("right")
            else:
                print("wrong", list(error.absolute_path), error.message[:100].replace("\n", " "))


main(*sys.argv[1:])
