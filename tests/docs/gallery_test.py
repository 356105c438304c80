#!/usr/bin/env python3
"""gallery_test.py: the README begins with the film, and its pictures lead to the gallery; docs/gallery.md has every scene of configs/ with
a picture that exists and that tools/gallery draws, how its file begins, and its commands. Then checks itself."""

import re
import sys

from pages import ROOT

THUMBNAIL = re.compile(r"\[!\[[^\]]+\]\(docs/pictures/gallery/(\w+)\.png\)\]\(docs/gallery\.md#[\w-]+\)")


def problems(readme, scenes, drawn, exists):
    first = re.search(r"!\[[^\]]*\]\(([^)]+)\)", readme)
    if not first or not first[1].endswith(".gif"):
        yield "the first picture of the README is not animated"
    names = [scene.split("/")[-1].removesuffix(".yaml") for scene in scenes]
    shown = THUMBNAIL.findall(readme)
    if len(shown) < 6 or len(shown) != len(set(shown)) or not set(shown) <= set(names):
        yield f"the README does not show six scenes with links to the gallery, but {shown}"
    for scene, name in zip(scenes, names):
        if not exists(f"docs/pictures/gallery/{name}.png"):
            yield f"the picture of {scene} does not exist"
        if f'"{scene.removeprefix("configs/").removesuffix(".yaml")}"' not in drawn:
            yield f"tools/gallery does not draw {scene}"


def problems_of_page(page, scenes, text_of):
    rows = {name: row for row in page.splitlines() for name in re.findall(r"\| !\[(\w+)\]\(pictures/gallery/\1\.png\)", row)}
    for scene in scenes:
        name = scene.split("/")[-1].removesuffix(".yaml")
        row = rows.get(name, "")
        # The first line of a file is not always a whole sentence.
        begin = text_of(scene).splitlines()[0].removeprefix("# ").split(". ")[0]
        for word in (f"](../{scene}): {begin}", f"`sprekk run {scene}`", f"`tools/gallery {name}`"):
            if word not in row:
                yield f"docs/gallery.md does not have {word} (run tools/gallery --page)"


SCENES = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "configs").rglob("*.yaml") if "studies" not in path.parts)
README = (ROOT / "README.md").read_text(encoding="utf-8")
GALLERY = (ROOT / "tools/gallery").read_text(encoding="utf-8")


def exists(path):
    return (ROOT / path).is_file()


for planted in (problems(README, [*SCENES, "configs/tutorial/planted.yaml"], GALLERY, exists),
                problems(README.replace("wings.gif", "wings.png"), SCENES, GALLERY, exists),
                problems(README.replace("docs/gallery.md#", "docs/galleries.md#", 1), SCENES, GALLERY, exists),
                problems(README, SCENES, "", exists), problems(README, SCENES, GALLERY, lambda path: False)):
    assert list(planted), "a planted mistake is not noticed"
PAGE = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")


def text_of(scene):
    return (ROOT / scene).read_text(encoding="utf-8")


for planted in (problems_of_page(PAGE, [*SCENES, "configs/tutorial/planted.yaml"], lambda scene: "# Planted.\n"), problems_of_page(PAGE.replace("`sprekk run configs/tutorial/", "`sprekk run tutorial/"), SCENES, text_of),
                problems_of_page(PAGE, SCENES, lambda scene: "# Planted.\n")):
    assert list(planted), "a planted mistake is not noticed"
found = [*problems(README, SCENES, GALLERY, exists), *problems_of_page(PAGE, SCENES, text_of)]
print(*found, f"{len(SCENES)} scenes, {len(found)} problems", sep="\n")
sys.exit(1 if found else 0)
