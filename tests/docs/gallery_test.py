#!/usr/bin/env python3
"""gallery_test.py: the README begins with the film, and shows every scene of configs/ with a picture that tools/gallery draws. Then
checks itself."""

import re
import sys

from pages import ROOT

THUMBNAIL = re.compile(r"\[!\[[^\]]+\]\((docs/pictures/gallery/\w+\.png)\)\]\((configs/[\w/]+\.yaml)\)<br>`(\w+)`")


def problems(readme, scenes, drawn, exists):
    first = re.search(r"!\[[^\]]*\]\(([^)]+)\)", readme)
    if not first or not first[1].endswith(".gif"):
        yield "the first picture of the README is not animated"
    shown = {scene: (picture, name) for picture, scene, name in THUMBNAIL.findall(readme)}
    for scene in scenes:
        name = scene.split("/")[-1].removesuffix(".yaml")
        if scene not in shown:
            yield f"{scene} has no picture in the README"
        elif shown[scene] != (f"docs/pictures/gallery/{name}.png", name):
            yield f"{scene} has the picture or the name of another scene in the README"
        elif not exists(f"docs/pictures/gallery/{name}.png"):
            yield f"the picture of {scene} does not exist"
        if f'"{scene.removeprefix("configs/").removesuffix(".yaml")}"' not in drawn:
            yield f"tools/gallery does not draw {scene}"


SCENES = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "configs").rglob("*.yaml") if "studies" not in path.parts)
README = (ROOT / "README.md").read_text(encoding="utf-8")
GALLERY = (ROOT / "tools/gallery").read_text(encoding="utf-8")


def exists(path):
    return (ROOT / path).is_file()


for planted in (problems(README, [*SCENES, "configs/tutorial/planted.yaml"], GALLERY, exists),
                problems(README.replace("wings.gif", "wings.png"), SCENES, GALLERY, exists),
                problems(README, SCENES, "", exists), problems(README, SCENES, GALLERY, lambda path: False)):
    assert list(planted), "a planted mistake is not noticed"
found = list(problems(README, SCENES, GALLERY, exists))
print(*found, f"{len(SCENES)} scenes, {len(found)} problems", sep="\n")
sys.exit(1 if found else 0)
