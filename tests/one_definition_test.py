#!/usr/bin/env python3
"""No two types of the program have one name. The compiler sees one file at a time, and the linker keeps one of two destructors (or
copies of std::vector) with the same name, so that the other type is treated as if it were the first.

Types in unnamed namespaces are out of it. Without arguments: checks the tree this file is in, then itself on planted files. Exit
code 1 if anything is wrong.
"""

import re
import sys
from pathlib import Path

from documented_types_test import FOLDERS, NAMESPACE, NO_CODE, blank

TYPE = re.compile(r"^\s*(?:template\s*<.*>\s*)?(?:class|struct|union|enum(?:\s+class|\s+struct)?)\s+"
                  r"(?:\[\[.*?\]\]\s*|alignas\(.*?\)\s*)*(?P<name>[\w:]+)(?P<arguments>\s*<[^{}]*?>)?\s*(?:final\s*)?(?::[^:].*)?$", re.DOTALL)


def types(text):
    """(line, full name) of each type that is defined in the text, without those in unnamed namespaces and in functions."""
    code = re.sub(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", blank, NO_CODE.sub(blank, text), flags=re.MULTILINE)
    code = re.sub(r"\b(?:public|protected|private)\s*:(?!:)", blank, code)
    scopes = []  # names; None for what is no scope of types with linkage
    start = 0
    for position, character in enumerate(code):
        if character not in "{};":
            continue
        statement = code[start:position]
        start = position + 1
        if character == "}":
            if scopes:
                scopes.pop()
            continue
        if character == ";":
            continue
        namespace, kind = NAMESPACE.match(statement), TYPE.match(statement)
        if namespace:
            scopes.append(namespace["name"] or None)
        elif kind:
            name = kind["name"] + re.sub(r"\s", "", kind["arguments"] or "")
            if None not in scopes:
                first = position - len(statement.lstrip())
                yield code.count("\n", 0, first) + 1, "::".join(scopes + [name])
            scopes.append(name)
        else:
            scopes.append(None)


def problems(files):
    """files: {path: text}"""
    places = {}
    for path, text in files.items():
        for line, name in types(text):
            places.setdefault(name, []).append(f"{path}:{line}")
    for name, found in places.items():
        if len(found) > 1:
            yield f"{found[1]}: {name} is a type at {found[0]}, too (give one of them another name)"


# (files, names that are there twice)
PLANTED = (
    ({"a.hpp": "namespace sprekk {\nclass Part {\n public:\n  virtual ~Part();\n};\n}\n",
      "b.hpp": "namespace sprekk {\n/// Another.\nstruct Part {\n  int x;\n};\n}\n"}, ["sprekk::Part"]),
    ({"a.hpp": "namespace sprekk::one { struct Part : Base { int x; }; }", "b.hpp": "namespace sprekk::two { struct Part { int x; }; }"}, []),
    ({"a.cpp": "namespace sprekk {\nnamespace {\nstruct Part { int x; };\n}\n}", "b.cpp": "namespace sprekk { namespace { struct Part {}; } }"}, []),
    ({"a.hpp": "namespace s { class A { struct Impl; }; class B { enum class Kind : int { x }; }; }",
      "a.cpp": "namespace s { struct A::Impl { int x; }; struct B::Impl {}; enum class Kind { x }; }"}, []),
    ({"a.hpp": "namespace s { template <class T>\nstruct A { T x; }; template <>\nstruct A<int> { int y; }; }",
      "b.cpp": "namespace s { inline int f() { struct A {}; return 0; } template <> struct A<int> final : B { int z; }; }"}, ["s::A<int>"]),
    ({"a.cpp": "namespace s { enum Kind { a }; }", "b.cpp": "namespace s {\nvoid f();\nenum class Kind { b };\n}"}, ["s::Kind"]),
)


def self_test():
    for files, expected in PLANTED:
        found = [problem.split()[1] for problem in problems(files)]
        if found != expected:
            yield f"self-test: found {found} instead of {expected} in {files}"


def main():
    root = Path(__file__).resolve().parent.parent
    files = {file.relative_to(root).as_posix(): file.read_text(encoding="utf-8")
             for folder in FOLDERS for file in sorted((root / folder).rglob("*")) if file.suffix in (".hpp", ".cpp")}
    count = sum(1 for text in files.values() for _ in types(text))
    found = [*problems(files), *self_test()]
    for problem in found:
        print(problem)
    print(f"{count} types in {len(files)} files, {len(PLANTED)} planted pairs, {len(found)} problems")
    return 1 if found or not count else 0


if __name__ == "__main__":
    sys.exit(main())
