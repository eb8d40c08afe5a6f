#!/usr/bin/env python3
"""Holds the JSON Schema of scenes to what the reader says.

Usage: check_scenes.py FILE
FILE: {"schema": ..., "cases": [{"name": ..., "accepted": true or false, "scene": ...}, ...]}
Prints every case on which the schema says otherwise. Exit code 0: none.
"""
import json
import sys

try:
    import jsonschema
except ImportError:
    sys.exit("the Python module jsonschema is missing; tools/setup test installs it")


def main(path):
    with open(path, encoding="utf-8") as file:
        content = json.load(file)
    jsonschema.Draft4Validator.check_schema(content["schema"])
    validator = jsonschema.Draft4Validator(content["schema"])
    differing = 0
    for case in content["cases"]:
        error = next(validator.iter_errors(case["scene"]), None)
        if (error is None) != case["accepted"]:
            differing += 1
            print(case["name"], "is refused: " + error.message if error else "is accepted")
    print(len(content["cases"]), "cases,", differing, "differ")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
