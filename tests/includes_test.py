#!/usr/bin/env python3
"""Files include what they use, although precompiled headers (tools/cmake/SprekkPrecompiled.cmake) would compile without: each header
whose names a file uses is included by the file, or by headers that it includes. So sources also compile without precompiled headers,
and in the programs of others.

Without arguments: checks the tree this file is in, then itself on planted files. Exit code 1 if anything is wrong.
"""

import re
import sys
from pathlib import Path

from documented_types_test import public_types

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("framework", "components", "couplers", "tests", "tools")
PRECOMPILED = "tools/cmake/SprekkPrecompiled.cmake"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^">]+)[">]', re.MULTILINE)
NO_CODE = re.compile(r'R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)

# Header: names that come from it.
NAMES = {
    "algorithm": r"std::(?:sort|stable_sort|max|min|minmax|max_element|min_element|find|find_if|any_of|all_of|none_of|fill|copy|transform|reverse"
                 r"|unique|lower_bound|upper_bound|equal_range|count|count_if|clamp|binary_search|rotate|remove_if|replace|ranges::\w+)\s*[(<]",
    "array": r"std::array\b",
    "cmath": r"std::(?:sqrt|cos|sin|tan|acos|asin|atan2?|tanh|pow|exp|log|log10|log2|hypot|isfinite|isnan|floor|ceil|round|lround|cbrt|fmod|ldexp)\(",
    "cstdint": r"std::u?int(?:8|16|32|64|ptr)_t\b",
    "functional": r"std::(?:function|hash|less|greater|plus|reference_wrapper)\s*<",
    "limits": r"std::numeric_limits\b",
    "map": r"std::(?:multi)?map\s*<",
    "memory": r"std::(?:unique_ptr|shared_ptr|weak_ptr|make_unique|make_shared)\b",
    "numbers": r"std::numbers::",
    "numeric": r"std::(?:iota|accumulate|midpoint|partial_sum|inner_product|reduce)\(",
    "optional": r"std::(?:optional|nullopt)\b",
    "set": r"std::(?:multi)?set\s*<",
    "span": r"std::span\b",
    "stdexcept": r"std::(?:runtime_error|logic_error|invalid_argument|out_of_range|length_error|domain_error)\b",
    "string": r"std::(?:string|to_string|stoi|stod)\b",
    "string_view": r"std::string_view\b",
    "vector": r"std::vector\b",
    "utility": r"std::(?:pair|exchange|swap|as_const|move|forward|make_pair)\b",
    "fmt/format.h": r"\bfmt::(?:format|join|to_string)\b",
    "Eigen/Core": r"\bEigen::(?:Vector|Matrix|Array|Map|Ref|Dynamic|Index)\w*\b",
    "Eigen/LU": r"\bEigen::(?:FullPivLU|PartialPivLU)\b",
    "Eigen/SparseCore": r"\bEigen::(?:Sparse(?:Matrix|Vector)|Triplet)\b",
    "gtest/gtest.h": r"^TEST(?:_[FP])?\(",
    "framework/assert.hpp": r"\bSPREKK_(?:ASSERT|EXPECT)\(",
}
NAMES = {header: re.compile(pattern, re.MULTILINE) for header, pattern in NAMES.items()}
# Headers that promise others' names.
ALSO = {
    "string": {"string_view"},
    "map": {"utility"}, "set": {"utility"}, "vector": {"utility"}, "algorithm": {"utility"}, "array": {"utility"}, "optional": {"utility"},
    "memory": {"utility"}, "functional": {"utility"}, "string_view": {"utility"}, "span": {"array"}, "filesystem": {"string"},
    "fstream": {"string"}, "sstream": {"string"}, "iostream": {"string"}, "stdexcept": {"string"}, "system_error": {"stdexcept", "string"},
    "Eigen/LU": {"Eigen/Core"}, "Eigen/SparseCore": {"Eigen/Core"}, "Eigen/Dense": {"Eigen/Core", "Eigen/LU"},
    "Eigen/Eigenvalues": {"Eigen/Core", "Eigen/LU"}, "Eigen/QR": {"Eigen/Core"}, "Eigen/SVD": {"Eigen/Core"},
    "Eigen/Cholesky": {"Eigen/Core"}, "Eigen/Geometry": {"Eigen/Core", "Eigen/LU"}, "Eigen/SparseLU": {"Eigen/Core", "Eigen/SparseCore"},
    "Eigen/SparseCholesky": {"Eigen/Core", "Eigen/SparseCore"}, "gmock/gmock.h": {"gtest/gtest.h"}, "nlohmann/json.hpp": {"string", "vector", "map"},
}


def code(text):
    return NO_CODE.sub(lambda found: " " + "\n" * found.group().count("\n"), text)


class Tree:
    def __init__(self, files):
        """files: {path: text}"""
        self.files = files
        self.direct = {path: [(kind, name) for kind, name in INCLUDE.findall(text)] for path, text in files.items()}
        self.found = {}
        self.names = {}

    def place(self, path, name):
        """The file of ours that `name`, in an include of `path`, is."""
        beside = (Path(path).parent / name).as_posix()
        return name if name in self.files else beside if beside in self.files else None

    def declared(self, path):
        """Names of types and aliases, also of others than of namespaces."""
        if path not in self.names:
            self.names[path] = set(re.findall(r"^\s*(?:class|struct|enum class|using)\s+(\w+)", code(self.files[path]), re.MULTILINE))
        return self.names[path]

    def closure(self, path):
        """All headers that a file gets by its own includes and those of our headers."""
        if path in self.found:
            return self.found[path]
        got, todo, seen = set(), [path], set()
        while todo:
            file = todo.pop()
            if file in seen:
                continue
            seen.add(file)
            for kind, name in self.direct[file]:
                ours = self.place(file, name) if kind == '"' else None
                got.add(ours or name)
                if ours:
                    todo.append(ours)
        for header in list(got):
            got |= ALSO.get(header, set())
        for header in list(got):
            got |= ALSO.get(header, set())
        self.found[path] = got
        return got


def own_types(tree, precompiled):
    """{name: headers} of public types that precompiled headers of ours bring along."""
    headers = {header for start in precompiled if start in tree.files for header in tree.closure(start) | {start} if header in tree.files}
    names = {}
    for header in headers:
        for _, name in public_types(tree.files[header]):
            names.setdefault(name.split("::")[-1], set()).add(header)
    return names


def problems(files, precompiled):
    """files: {path: text}; precompiled: our headers that are"""
    tree = Tree(files)
    types = own_types(tree, precompiled)
    any_type = re.compile(r"(?<!class )(?<!struct )\b(" + "|".join(map(re.escape, sorted(types))) + r")\b") if types else None
    found = []
    for path, text in sorted(files.items()):
        if "_module/" in path:  # compiled without
            continue
        body, got = code(text), tree.closure(path)
        for header, pattern in NAMES.items():
            use = pattern.search(body)
            if use and header not in got and path != header:
                found.append(f"{path}:{body.count(chr(10), 0, use.start()) + 1}: '{use.group().strip()}' without <{header}>")
        if not any_type:
            continue
        declared = set().union(*(tree.declared(file) for file in {path} | got if file in files))
        for name in sorted(set(any_type.findall(body)) - declared):
            if re.search(rf"(?:^|[\s(<,&*])(?:sprekk::)?{name}(?:\s*[&*({{>]|\s+\w)", body):
                found.append(f"{path}: '{name}' without \"{sorted(types[name])[0]}\"")
    return found


def sources(root):
    return {file.relative_to(root).as_posix(): file.read_text(encoding="utf-8")
            for folder in FOLDERS for file in sorted((root / folder).rglob("*")) if file.suffix in (".hpp", ".cpp")}


def check_itself():
    good = {"framework/a.hpp": "#include <vector>\n#include \"framework/b.hpp\"\nstd::vector<Bead> a();\n",
            "framework/b.hpp": "/// A bead.\nstruct Bead {\n  int size;\n};\n",
            "framework/a.cpp": "#include \"framework/a.hpp\"\nstd::vector<Bead> a() { return {}; } // std::map<int, int>\n"}
    assert not problems(good, ["framework/b.hpp"]), problems(good, ["framework/b.hpp"])
    for path, text, word in (("framework/c.cpp", "double f() { return std::sqrt(2.0); }\n", "cmath"),
                             ("framework/c.cpp", "#include \"framework/b.hpp\"\nstd::vector<int> v;\n", "vector"),
                             ("framework/c.cpp", "void f(const Bead& bead);\n", "framework/b.hpp"),
                             ("framework/c.cpp", "void f() { SPREKK_ASSERT(1 > 0); }\n", "framework/assert.hpp")):
        found = problems({**good, path: text}, ["framework/b.hpp"])
        assert len(found) == 1 and word in found[0], (text, found)


def main():
    files = sources(ROOT)
    text = (ROOT / PRECOMPILED).read_text(encoding="utf-8")
    listed = re.findall(r"set\(\w*headers (.*?)\)", text, re.DOTALL)
    standard = {header for block in listed for header in re.findall(r"<([^>]+)>", block)}
    ours = [header for block in listed for header in re.findall(r"\$\{CMAKE_SOURCE_DIR\}/([\w/.]+\.hpp)", block)]
    found = problems(files, ours)
    found += [f"{PRECOMPILED}: <{header}> is precompiled, but this test knows no names of it" for header in sorted(standard - set(NAMES))]
    found += [f"{PRECOMPILED}: {header} is no file" for header in ours if header not in files]
    check_itself()
    for line in found:
        print(line)
    print(f"{len(files)} files, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
