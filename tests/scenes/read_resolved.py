#!/usr/bin/python3
"""Reads resolved scenes by PyYAML, by YAML 1.1, and compares what it gets with what carom gets.

read_resolved.py FILE: a line for each scene, {"name": name, "text": YAML, "values": value}. Prints how many values are the same.
"""
import json
import sys

import yaml


def same(a, b, path):
    """How many values are the same below a path. Fails at the first other one."""
    if isinstance(a, dict) or isinstance(a, list):
        assert type(a) is type(b) and len(a) == len(b), (path, a, b)
        keys = a.keys() if isinstance(a, dict) else range(len(a))
        assert keys == (b.keys() if isinstance(b, dict) else range(len(b))), (path, list(keys))
        return sum(same(a[key], b[key], f"{path}.{key}") for key in keys)
    if isinstance(a, (int, float)) and not isinstance(a, bool):
        assert isinstance(b, (int, float)) and not isinstance(b, bool) and float(a) == float(b), (path, a, b)
    else:
        assert type(a) is type(b) and a == b, (path, a, b)
    return 1


count = 0
for line in open(sys.argv[1], encoding="utf-8"):
    scene = json.loads(line)
    count += same(scene["values"], yaml.safe_load(scene["text"]), scene["name"])
print(f"{count} values")
