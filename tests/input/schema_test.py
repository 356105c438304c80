#!/usr/bin/env python3
"""The schema that editors use: valid JSON, and where Python knows JSON schemas, one that the scenes of configs/ fulfil
and that scenes with misspelt keys do not."""
import copy
import json
import pathlib
import subprocess
import sys

program, configs = sys.argv[1], pathlib.Path(sys.argv[2])
schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
assert schema["type"] == "object"
try:
    import jsonschema
    import yaml
except ImportError:
    print("the schema is JSON; without the Python modules jsonschema and yaml no scene was validated")
    sys.exit(0)

jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
scenes = sorted(configs.glob("*/*.yaml"))
assert scenes
for path in scenes:
    scene = yaml.safe_load(path.read_text())
    problems = [error.message for error in validator.iter_errors(scene)]
    assert not problems, (path, problems)
    for section in ("geometry", "time"):
        broken = copy.deepcopy(scene)
        broken[section]["no_such_key"] = 1
        assert not validator.is_valid(broken), (path, section)
print(f"{len(scenes)} scenes fulfil the schema")
