#!/usr/bin/env python3
"""Every public class, struct, enum and union in a header of the program has a sentence (`///`) directly above it, and no such comment
has a word in angle brackets, which Doxygen takes for a tag (tools/docs fails).

Without arguments: checks the tree this file is in, then itself on planted headers. Exit code 1 if anything is wrong.
"""

import re
import sys
from pathlib import Path

FOLDERS = ("framework", "components", "couplers")
# What is no code: comments, raw strings, strings, characters. Digits may be separated by ' (1'000).
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((?:.*?)\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)
TYPE = re.compile(r"^\s*(?:template\s*<.*>\s*)?(?:requires\s+[^;]*\s)?(?P<kind>class|struct|union|enum(?:\s+class|\s+struct)?)\s+"
                  r"(?:\[\[.*?\]\]\s*|alignas\(.*?\)\s*)*(?P<name>[\w:]+)[^()=]*$", re.DOTALL)
NAMESPACE = re.compile(r"^\s*(?:inline\s+)?namespace\b\s*(?P<name>[\w:]*)")
ACCESS = re.compile(r"\b(public|protected|private)\s*:(?!:)")
# A word in angle brackets that Doxygen would take for a tag.
TAG = re.compile(r"(?:^|\s)<[A-Za-z]\w*>")
# Namespaces that nobody outside of the header uses.
INTERNAL = ("", "detail", "internal")


def blank(match):
    """The same lines and columns without their text."""
    return re.sub(r"[^\n]", " ", match.group())


def public_types(text):
    """(line, name) of each public type that is defined in the text of a header; the line, from 0, is the first of its
    declaration, with `template`."""
    code = NO_CODE.sub(blank, text)
    code = re.sub(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", blank, code, flags=re.MULTILINE)
    scopes = []  # [whether what is declared here is public]
    start = 0
    for position, character in enumerate(code):
        if character not in "{};:":
            continue
        statement = code[start:position]
        if character == ":":
            access = ACCESS.fullmatch(statement.strip() + ":")
            if access and scopes:
                scopes[-1] = access.group(1) == "public"
                start = position + 1
            continue
        if character == "{":
            # A base's or an argument's braces are not the start of a scope, but end as if they were one.
            public = all(scopes)
            kind = TYPE.match(statement)
            namespace = NAMESPACE.match(statement)
            if kind and public:
                first = start + len(statement) - len(statement.lstrip())
                yield code.count("\n", 0, first), kind["name"]
            if kind:
                scopes.append(kind["kind"] != "class")
            else:
                scopes.append(bool(namespace) and namespace["name"] not in INTERNAL)
        elif character == "}" and scopes:
            scopes.pop()
        start = position + 1


def undocumented(path, text):
    lines = text.split("\n")
    for line, name in public_types(text):
        if line == 0 or not lines[line - 1].lstrip().startswith("///"):
            yield f"{path}:{line + 1}: {name} has no sentence (write what it is as /// directly above it)"


# (header, the types without a sentence)
PLANTED = (
    ("struct Bare {};\n", ["Bare"]),
    ("/// What it is.\nstruct Told {};\n", []),
    ("/// What it is.\ntemplate <typename T>\nclass Told {};\n", []),
    ("template <typename T = std::vector<int>>\nclass Bare : public Base<T> {\n};\n", ["Bare"]),
    ("// A plain comment.\nenum class Bare : unsigned char { a, b };\n", ["Bare"]),
    ("/// What it is.\n\nstruct Apart {};\n", ["Apart"]),
    ("class Declared;\nenum class Later : int;\nstruct Declared make(struct Other& x);\n", []),
    ("/// What it is.\nclass Outer {\n  struct Hidden {};\n public:\n  struct Shown {};\n private:\n  struct AlsoHidden {};\n};\n",
     ["Shown"]),
    ("namespace sprekk {\nnamespace {\nstruct Hidden {};\n}\nstruct Shown {};\n}\n", ["Shown"]),
    ("namespace sprekk::detail::x {\n/// Told.\nstruct Told {\n  enum Kind { a };\n};\n}\n", ["Kind"]),
    ("inline int f() {\n  struct Local {};\n  return 1'000;\n}\nstruct Shown {};\n", ["Shown"]),
    ('const char* text = "struct A {";\n/* struct B { */\n// struct C {\n#define X struct D {\nstruct Shown final {};\n', ["Shown"]),
)


def odd_tags(path, text):
    for number, line in enumerate(text.splitlines(), 1):
        comment = re.search(r"///<?(.*)", line)
        tag = TAG.search(re.sub(r"`[^`]*`|\"[^\"]*\"", "", comment.group(1))) if comment else None
        if tag:
            yield f"{path}:{number} has {tag.group().strip()} in a comment (Doxygen takes it for a tag) put it in backticks"


def self_test():
    if list(odd_tags("planted.hpp", "/// Of `<a>` and \"a <b>\", x <y, std::vector<int>.\nint a;  ///< m\n")):
        yield "self-test: a comment without tags is accused"
    if len(list(odd_tags("planted.hpp", "/// The header <random>.\nint a;  ///< of <map>\n"))) != 2:
        yield "self-test: not noticed: a tag in a comment"
    for text, expected in PLANTED:
        found = [message.split()[1] for message in undocumented("planted.hpp", text)]
        if found != expected:
            yield f"self-test: found {found} instead of {expected} in:\n{text}"


def main():
    root = Path(__file__).resolve().parent.parent
    found, tags, types = [], [], 0
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*.hpp")):
            text = file.read_text(encoding="utf-8")
            types += sum(1 for _ in public_types(text))
            found += undocumented(file.relative_to(root).as_posix(), text)
            tags += odd_tags(file.relative_to(root).as_posix(), text)
    missing = len(found)
    found += tags
    found += self_test()
    for problem in found:
        print(problem)
    print(f"{types} public types, {missing} without a sentence; {len(PLANTED)} planted headers, {len(found)} problems")
    return 1 if found or not types else 0


if __name__ == "__main__":
    sys.exit(main())
