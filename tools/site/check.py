#!/usr/bin/env python3
"""check.py FOLDER: the pages of a site work from the file system without a network. Links lead to files, and headings, that are
there; scripts, styles, pictures and fonts are local. Prints what is wrong; the exit code is 1 then."""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

REMOTE = re.compile(r"(?:[a-z]+:)?//", re.IGNORECASE)
LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "embed": "src", "object": "data", "link": "href"}
NOT_LOADED = {"canonical", "next", "prev", "edit"}  # what a <link> may name without that a browser fetches it


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.assets, self.styles = set(), [], [], []
        self.in_style = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names.update(values[key] for key in ("id", "name") if values.get(key))
        self.in_style = tag == "style"
        if values.get("style"):
            self.styles.append(values["style"])
        if tag in LOADED and values.get(LOADED[tag]) and values.get("rel") not in NOT_LOADED:
            self.assets.append(values[LOADED[tag]])
        if tag in ("a", "area") and values.get("href"):
            self.links.append(values["href"])

    def handle_data(self, data):
        if self.in_style:
            self.styles.append(data)

    def handle_endtag(self, tag):
        self.in_style = False


def loaded_by_style(text):
    return [target for target in re.findall(r"""(?:url\(|@import\s+(?!url\())\s*["']?([^"')\s;]+)""", text) if not target.startswith("data:")]


def problems(folder):
    pages = {file.resolve(): Page(file.read_text(encoding="utf-8")) for file in sorted(folder.rglob("*.html"))}
    for file, page in pages.items():
        assets = page.assets + [target for style in page.styles for target in loaded_by_style(style)]
        for target in assets + page.links:
            if REMOTE.match(target):
                if target in assets:
                    yield file, f"loads {target} from a network"
                continue
            path, _, anchor = target.partition("#")
            if re.match(r"[a-z]+:", target):
                continue
            linked = (file.parent / unquote(path.partition("?")[0])).resolve() if path else file
            if not linked.is_file():
                yield file, f"links to {target}, which does not exist"
            elif anchor and linked in pages and unquote(anchor) not in pages[linked].names | {"__comments"}:
                yield file, f"links to {target}, which has no such place"
    for file in sorted(folder.rglob("*.css")):
        for target in loaded_by_style(file.read_text(encoding="utf-8")):
            if REMOTE.match(target):
                yield file, f"loads {target} from a network"
            elif not target.startswith(("#", "data:")) and not (file.parent / re.split(r"[?#]", target)[0]).exists():
                yield file, f"names {target}, which does not exist"


def main():
    folder = Path(sys.argv[1])
    found = sorted({(str(file.relative_to(folder.resolve()) if file.is_absolute() else file.relative_to(folder)), text)
                    for file, text in problems(folder)})
    for file, text in found:
        print(f"{file} {text}")
    if not any(folder.rglob("*.html")):
        sys.exit(f"{folder} has no pages")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main())
