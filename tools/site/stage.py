#!/usr/bin/python3
"""stage.py TAGS FOLDER: gathers what the site is made of in FOLDER: the pages of docs/ with the README, the changes and how to
contribute, and a page with the text of each other file of the repository that they link to. Links are turned accordingly, and
headers that are named in `…` link to their page of the API reference (TAGS: the tag file of Doxygen)."""

import os
import posixpath
import re
import shutil
import sys
import xml.etree.ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = {"README.md": "index.md", "CONTRIBUTING.md": "CONTRIBUTING.md", "CHANGELOG.md": "CHANGELOG.md"}
FENCE = re.compile(r"^(```.*?^```)$", re.DOTALL | re.MULTILINE)
LANGUAGES = {".yaml": "yaml", ".py": "python", ".hpp": "cpp", ".cpp": "cpp", ".csv": "text", ".sh": "bash", "": "text", ".cff": "yaml"}


def pages():
    """{path in the repository: path in the site}"""
    found = {path: place for path, place in PAGES.items() if (ROOT / path).exists()}
    for file in sorted((ROOT / "docs").rglob("*.md")):
        path = str(file.relative_to(ROOT))
        found[path] = path.removeprefix("docs/")
    return found


def headers_of(tags):
    """{path of a header: its page below api/}"""
    found = {}
    for compound in xml.etree.ElementTree.parse(tags).getroot().iter("compound"):
        if compound.get("kind") == "file":
            path = os.path.relpath(compound.findtext("path") + compound.findtext("name"), ROOT)
            found[path] = "api/" + compound.findtext("filename")
    return found


class Site:
    def __init__(self, headers, folder):
        self.headers = headers
        self.folder = folder
        self.pages = pages()
        self.files = set()  # other files of the repository that pages link to

    def place(self, path):
        """Where the site has a file of the repository."""
        if path in self.pages:
            return self.pages[path]
        if path.startswith("docs/") and not (ROOT / path).is_dir() and Path(path).suffix in (".png", ".svg", ".gif"):
            self.copy(path, path.removeprefix("docs/"))
            return path.removeprefix("docs/")
        self.files.add(path)
        return f"source/{path}.md"

    def copy(self, path, place):
        (self.folder / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / path, self.folder / place)

    def link(self, page, target):
        """What a link in a page of the repository is in the site."""
        if re.match(r"[a-z]+:|#", target):
            return target
        path, mark, anchor = target.partition("#")
        path = posixpath.normpath(posixpath.join(posixpath.dirname(page), path))
        if not (ROOT / path).exists():
            sys.exit(f"{page} links to {target}, which does not exist")
        return posixpath.relpath(self.place(path), posixpath.dirname(self.pages[page]) or ".") + mark + anchor

    def prose(self, page, text):
        def header(match):
            path = match[1]
            if path not in self.headers:
                return match[0]
            return f"[`{path}`]({posixpath.relpath(self.headers[path], posixpath.dirname(self.pages[page]) or '.')})"

        text = re.sub(r"^\$\$.+?\$\$$", r"\n\g<0>\n", text, flags=re.DOTALL | re.MULTILINE)  # a formula is a paragraph of its own
        text = re.sub(r"(?<!\[)`((?:framework|components|couplers)/[\w/]+\.hpp)`", header, text)
        text = re.sub(r"\]\(([^)\s]+)\)", lambda m: m[0] if m[1].startswith(("api/", "../api/")) else f"]({self.link(page, m[1])})", text)
        return re.sub(r'(<img[^>]*\bsrc=")([^"]+)"', lambda m: f'{m[1]}{self.link(page, m[2])}"', text)

    def code(self, block):
        """A fence without the words that only the tests of the pages read; a file keeps its name as the title."""
        first, _, rest = block.partition("\n")
        language, *words = first[3:].split() or [""]
        title = next((f' title="{word.partition("=")[2]}"' for word in words if word.startswith(("file=", "from="))), "")
        return f"```{language or 'text'}{title}\n{rest}"

    def write_pages(self):
        for path, place in self.pages.items():
            parts = FENCE.split((ROOT / path).read_text(encoding="utf-8"))
            text = "".join(self.code(part) if part.startswith("```") else self.prose(path, part) for part in parts)
            (self.folder / place).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / place).write_text(text, encoding="utf-8")

    def write_files(self):
        for path in sorted(self.files):
            target = self.folder / f"source/{path}.md"
            target.parent.mkdir(parents=True, exist_ok=True)
            if (ROOT / path).is_dir():
                names = sorted(p.name for p in (ROOT / path).iterdir() if not p.name.startswith((".", "__")))
                text = "\n".join(f"- `{name}`" for name in names)
            else:
                language = LANGUAGES.get(Path(path).suffix, "text")
                text = f"````{language}\n{(ROOT / path).read_text(encoding='utf-8')}\n````"
            target.write_text(f"# {path}\n\n{text}\n", encoding="utf-8")


def main():
    tags, folder = sys.argv[1], Path(sys.argv[2])
    site = Site(headers_of(tags), folder)
    site.write_pages()
    site.write_files()
    (folder / "api.md").write_text("# API reference\n\nEvery declaration of the headers, with its comment, made by Doxygen: "
                                   "[open the reference](api/index.html), or go to its [files](api/files.html), its [classes]"
                                   "(api/annotated.html) or its [namespaces](api/namespaces.html).\n\nPages link to it where they name a "
                                   "header. [Architecture](architecture.md) says what the folders are for.\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
