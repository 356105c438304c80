#!/usr/bin/env python3
"""docs/pictures/include_graph.py: draws include_graph.svg, which folder of the sources includes headers of which (by dot), without the
arrows that follow from others. A folder with source files of its own counts with the folders in it. Fails where folders, or files
(a header and its source are one), include one another in a circle.
--check: draws nothing, and fails where the picture is not that of the sources, too."""

import graphlib
import html
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ROOMS = {"framework": "#e8eef2", "components": "#f9e8d9", "couplers": "#e3f0e3"}
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def sources():
    for room in ROOMS:
        for file in sorted((ROOT / room).rglob("*")):
            if file.suffix in (".hpp", ".cpp"):
                yield file.relative_to(ROOT)


def folder(path):
    """The outermost folder below its room that has source files of its own."""
    parts = path.split("/")[:-1]
    for depth in range(2, len(parts)):
        place = ROOT.joinpath(*parts[:depth])
        if any(place.glob("*.[hc]pp")):
            return "/".join(parts[:depth])
    return "/".join(parts)


def includes():
    """{folder: folders of which it includes headers}"""
    graph = {}
    for file in sources():
        own = folder(file.as_posix())
        headers = INCLUDE.findall((ROOT / file).read_text(encoding="utf-8"))
        graph.setdefault(own, set()).update(folder(header) for header in headers if header.startswith(tuple(room + "/" for room in ROOMS)))
    return {place: targets - {place} for place, targets in graph.items()}


def file_includes():
    """{file without its ending: those of which it includes headers}"""
    graph = {}
    for file in sources():
        own = file.as_posix().rpartition(".")[0]
        headers = INCLUDE.findall((ROOT / file).read_text(encoding="utf-8"))
        graph.setdefault(own, set()).update(header.rpartition(".")[0] for header in headers)
    return {own: targets - {own} for own, targets in graph.items()}


def refuse_circle(graph, what):
    try:
        tuple(graphlib.TopologicalSorter(graph).static_order())
    except graphlib.CycleError as error:
        sys.exit(f"{what} include one another in a circle: " + " -> ".join(reversed(error.args[1])))


def reached(graph, start):
    seen, waiting = set(), list(graph.get(start, ()))
    while waiting:
        place = waiting.pop()
        if place not in seen:
            seen.add(place)
            waiting += graph.get(place, ())
    return seen


def without_what_follows(graph):
    """The arrows that are not the sum of others (the transitive reduction of a graph without circles)."""
    return {place: [to for to in targets if not any(to in reached(graph, other) for other in targets if other != to)]
            for place, targets in graph.items()}


def dot(graph):
    lines = ["digraph includes {", '  graph [rankdir=BT, nodesep=0.15, ranksep=0.45, fontname="Helvetica", fontsize=13, style="rounded,filled", pencolor="#b0b8bf"];',
             '  node [shape=box, style="rounded,filled", fillcolor=white, color="#8a949c", fontname="Helvetica", fontsize=11, margin="0.09,0.04"];',
             '  edge [color="#5c6770", arrowsize=0.6];']
    for room, colour in ROOMS.items():
        lines += [f'  subgraph "cluster_{room}" {{', f'    label="{room}"; fillcolor="{colour}";']
        for place in sorted(graph):
            if place == room or place.startswith(room + "/"):
                name = place.removeprefix(room + "/").replace("/", "/\\n", 1) if place != room else f"(in {room}/)"
                lines.append(f'    "{place}" [label="{name}"];')
        lines.append("  }")
    lines += [f'  "{place}" -> "{to}";' for place, targets in sorted(without_what_follows(graph).items()) for to in sorted(targets)]
    return "\n".join(lines + ["}"])


def shown(picture):
    """Folders and arrows of a drawn picture."""
    return {html.unescape(title) for title in re.findall(r"<title>([^<]+)</title>", picture)} - {"includes", *(f"cluster_{room}" for room in ROOMS)}


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    graph = includes()
    refuse_circle(graph, "folders")
    refuse_circle(file_includes(), "files")
    picture = HERE / "include_graph.svg"
    if sys.argv[1:]:
        arrows = {f"{place}->{to}" for place, targets in without_what_follows(graph).items() for to in targets}
        if shown(picture.read_text(encoding="utf-8")) != arrows | set(graph):
            sys.exit("include_graph.svg is not that of the sources: run docs/pictures/include_graph.py and commit it")
        return
    drawn = subprocess.run(["dot", "-Tsvg"], input=dot(graph), text=True, check=True, stdout=subprocess.PIPE).stdout
    picture.write_text(drawn, encoding="utf-8")
    print(f"{len(graph)} folders, {sum(map(len, graph.values()))} pairs that include, no circle")


main()
