#!/usr/bin/env python3
"""The schemas that editors use: valid JSON, the ones beside the scenes are those of the program, every scene and study names its
own for editors, and where Python knows JSON schemas, the scenes of configs/ fulfil them and those with misspelt keys do not."""
import copy
import json
import os
import pathlib
import re
import subprocess
import sys

program, configs = sys.argv[1], pathlib.Path(sys.argv[2])
texts = {name: subprocess.run([program, "schema", name], check=True, capture_output=True, text=True).stdout
         for name in ("scene", "study")}
schema, study_schema = (json.loads(texts[name]) for name in ("scene", "study"))
assert schema["type"] == "object"
for name, text in texts.items():
    kept = configs / f"{name}.schema.json"
    assert kept.read_text(encoding="utf-8") == text, f"{kept} is out of date: run `sprekk schema {name} > {kept}`"

# What editors look for, see docs/editor.md.
modeline = re.compile(r"^# yaml-language-server: \$schema=(\S+)$", re.MULTILINE)
files = sorted(configs.rglob("*.yaml"))
assert files
for path in files:
    named = modeline.findall(path.read_text(encoding="utf-8"))
    wanted = configs / ("study.schema.json" if "studies" in path.parts else "scene.schema.json")
    relative = os.path.relpath(wanted, path.parent)
    assert named == [relative], f"{path} must end with the line '# yaml-language-server: $schema={relative}'"
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
    for spoil in (lambda scene: scene.update(schedule=[{"solv": ["pore"]}]),
                  lambda scene: scene.update(schedule=[{"solve": ["pore"], "stabilise": "none"}]),
                  lambda scene: scene.update(schedule=[{"solve": ["pore"], "newton": {"at_mots": 3}}]),
                  lambda scene: scene.update(schedule={"iterate": {"steps": [{"solve": []}], "until": {"relativ": 1}}}),
                  lambda scene: scene.update(schedule=[{"iterate": {"steps": [{"subcycle": {"count": 2}}]}}]),
                  lambda scene: scene.update(schedule=[{"when": "t > 1", "step": {"solve": ["pore"]}}]),
                  lambda scene: scene.update(schedule=[{"grow": "tips", "settle": ["rock"], "update": "later"}]),
                  lambda scene: scene.update(schedule=[])):
        broken = copy.deepcopy(scene)
        spoil(broken)
        assert not validator.is_valid(broken), (path, broken["schedule"])
nested = [{"iterate": {"until": {"relative": 1e-8, "at_most": 60}, "steps": [
    {"solve": ["pore", "conduit"], "stabilize": "fixed_stress"},
    {"when": "t > 1", "steps": {"subcycle": {"count": 4, "steps": [{"solve": "rock", "solver": {"type": "mumps"}}]}}}]}},
    {"grow": "tips", "settle": ["rock", "contact"], "update": "repeat_step"}]
scene["schedule"] = nested
assert not list(validator.iter_errors(scene)), "a nested schedule"

jsonschema.Draft202012Validator.check_schema(study_schema)
study_validator = jsonschema.Draft202012Validator(study_schema)
studies = sorted(configs.glob("*/studies/*.yaml"))
assert studies
for path in studies:
    study = yaml.safe_load(path.read_text())
    problems = [error.message for error in study_validator.iter_errors(study)]
    assert not problems, (path, problems)
    study["no_such_key"] = 1
    assert not study_validator.is_valid(study), path
print(f"{len(studies)} studies and {len(scenes)} scenes fulfil their schemas")
