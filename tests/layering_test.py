#!/usr/bin/env python3
"""Enforces the house rules of the source tree (docs/architecture.md), and that breaking one is noticed.

Without arguments: checks the tree this file is in, then itself on planted violations. Exit code 1 if anything is wrong.
"""

import re
import sys
import tempfile
from pathlib import Path

SOURCE_FOLDERS = ("framework", "components", "couplers", "tests", "tools")
ROOMS = ("framework/", "components/", "couplers/")
# Outside headers that take seconds and hundreds of megabytes to compile, or may not meet each other.
HEAVY = re.compile(r"^(Tpetra|Belos|MueLu|Ifpack2|Amesos2|Xpetra|Zoltan2|Teuchos|Kokkos|vtk|gmsh\.h|hdf5\.h|H5"
                   r"|yaml-cpp|umfpack|dmumps|mpi\.h)")
# Outside headers of libraries that are slow to load: only modules, which are opened when they are needed, may name them.
OF_MODULES = re.compile(r"^(Tpetra|Belos|MueLu|Ifpack2|Amesos2|Xpetra|Zoltan2|Teuchos|Kokkos|vtk|gmsh\.h|hdf5\.h|H5)")
# Words of the physics. The framework knows media that are fractured, and the tip of a fracture as an end of its line; what
# goes on there is physics. "elastic" is a kind of operator to it.
WORDS = (r"pressure|displacement|aperture|permeabilit|porosit|viscosit|friction|dilat|traction|darcy|toughness"
         r"|transmissivit|biot|poro|stress|(?<!con)strain|rock|fluid|crack|mechanic|asperit")
PHYSICS = re.compile(rf"\w*({WORDS})\w*|\w*(?<![a-z])slip(?![a-z])\w*|\bpore\b", re.IGNORECASE)
# Types of components, and what else only they know: in texts for users.
TYPES = re.compile(r"\b(mpfa|mpsa|tpfa|rt0|ntpfa|fem|coulomb|contacts?|matrix_(?:flow|heat)|fracture_(?:flow|heat)|fine_fracture"
                   r"|boundary_element|jump_fit|quarter_point|two_level|(?<!as )wells?|heat|temperature)\b", re.IGNORECASE)
# What texts of the framework may say nevertheless: (file, text that holds the word, why).
ALLOWED_TEXTS = (
    ("framework/command_line/manual_page.cpp", r"sprekk run first_scene.yaml --set materials.friction=0.9 -o results/rough\n",
     "an example of a call"),
    ("framework/config/dimension.cpp", "temperature", "a name of a unit's dimension"),
    ("framework/config/dimension.cpp", "pressure", "a name of a unit's dimension"),
    ("framework/config/dimension.cpp", "inverse pressure", "a name of a unit's dimension"),
    ("framework/config/dimension.cpp", "pressure gradient", "a name of a unit's dimension"),
    ("framework/config/dimension.cpp", "pressure rate", "a name of a unit's dimension"),
    ("framework/config/dimension.cpp", "viscosity", "a name of a unit's dimension"),
    ("framework/config/dimension.cpp", "stress intensity", "a name of a unit's dimension"),
    ("framework/scene/probe.cpp", "The field, for example pore.pressure.", "an example of a name in a scene"),
    ("framework/schedule/build_schedule.cpp", "a step is a map such as 'solve: [pore, rock]'", "an example of a scene"),
)
# Tests of behaviour instead of one file.
FREE_TESTS = re.compile(r"^tests/(verification|stability|dimension)/|/mpi/")
# What a listing of a folder shows at once.
MOST_FILES = 45
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)
COMMENT = re.compile(r'(R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)
TEXT = re.compile(r'R"\((.*?)\)"|"((?:\\.|[^"\\\n])*)"', re.DOTALL)


# How a type of component or coupler registers itself.
REGISTERED = re.compile(r'Register(?:Component|Coupler|Contact)<[^;"]*?>\s+\w+\(\s*"([^"]+)"')
# Parts of names of types that texts need as words.
ENGLISH = ("contact", "wells", "prescribed", "limited", "penalty")


def sources(root):
    for folder in SOURCE_FOLDERS:
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in (".hpp", ".cpp"):
                yield file.relative_to(root).as_posix(), file.read_text(encoding="utf-8")


def allowed_includes(path):
    """The folders of ours that a file may include from; None where all are allowed."""
    parts = path.split("/")
    if parts[0] == "framework":
        return ("framework/",)
    if parts[0] == "components":
        own = () if len(parts) < 3 else (f"components/{parts[1]}/",)
        return ("framework/", "components/capabilities/") + own
    if parts[0] == "couplers":
        return ("framework/", "components/capabilities/", "couplers/")
    return None


def include_violations(path, includes):
    allowed = allowed_includes(path)
    for header in includes:
        if allowed and header.startswith(SOURCE_FOLDERS) and not header.startswith(allowed):
            yield f"{path} includes {header} (allowed are {', '.join(allowed)})"


def heavy_violations(includes_of):
    """Heavy headers stay in .cpp files, and in headers that only .cpp files of their own folder include."""
    for path, includes in includes_of.items():
        heavy = [header for header in includes if HEAVY.match(header)]
        if not path.endswith(".hpp") or not heavy:
            continue
        for user, headers in includes_of.items():
            is_private = user.endswith(".cpp") and user.rpartition("/")[0] == path.rpartition("/")[0]
            if path in headers and not is_private:
                yield f"{path} brings {heavy[0]} to {user} (a heavy header must stay within .cpp files of one folder)"


def module_violations(path, includes):
    """Libraries that are slow to load are reached by modules (framework/module/module.hpp)."""
    if not path.startswith(ROOMS) or "_module/" in path:
        return
    for header in includes:
        if OF_MODULES.match(header):
            yield f"{path} includes {header} (each start would load its library; it belongs into a module)"


def physics_violations(path, text):
    if not path.startswith("framework/"):
        return
    # Comments may name examples; their line breaks stay, for the line numbers.
    code = COMMENT.sub(lambda match: match.group(1) or "\n" * match.group().count("\n"), text)
    texts = list(TEXT.finditer(code))
    includes = [match.span() for match in INCLUDE.finditer(code)]
    for match in (*PHYSICS.finditer(code), *TYPES.finditer(code)):
        if any(start <= match.start() < end for start, end in includes):
            continue  # include_violations has its say
        line = code.count("\n", 0, match.start()) + 1
        around = [t for t in texts if t.start() < match.start() and match.end() <= t.end()]
        if not around and match.re is TYPES:
            continue  # a name in the code may have another meaning, such as two outlines in contact
        if not around:
            yield f"{path}:{line} names {match.group()} (the framework knows no physics)"
            continue
        said = around[0].group(1) or around[0].group(2)
        if not any(path == file and said == allowed for file, allowed, _ in ALLOWED_TEXTS):
            yield f"{path}:{line} says {match.group()} in a text (the framework knows no physics)"


def types_of_the_tree(root):
    """The names by which components and couplers of this tree register themselves, and of components also what stands
    before and behind the slash, where it is no word of English."""
    names = set()
    for folder in ("components", "couplers"):
        for file in sorted((root / folder).rglob("*.cpp")):
            names.update(REGISTERED.findall(file.read_text(encoding="utf-8")))
    parts = {part for name in names if "/" in name for part in name.split("/")}
    return sorted(names | {part for part in parts if part not in ENGLISH})


def type_violations(path, text, types):
    """No type of a component or coupler is named in the framework, not in a comment either."""
    if not path.startswith("framework/"):
        return
    for name in types:
        for match in re.finditer(rf"(?<![\w/]){re.escape(name)}(?!\w)", text):
            if is_in_include(text, match.start()):
                continue
            yield f"{path}:{text.count(chr(10), 0, match.start()) + 1} names the type {match.group()} (no type is named in the framework)"


def is_in_include(text, at):
    return text[text.rfind("\n", 0, at) + 1:at].lstrip().startswith("#")


def stale_allowances(root):
    """Texts that are allowed and not there any more."""
    for file, allowed, _ in ALLOWED_TEXTS:
        if (root / file).exists() and f'"{allowed}"' not in (root / file).read_text(encoding="utf-8"):
            yield f"tests/layering_test.py allows a text that {file} has no more: {allowed}"


def counterpart_violations(root, path, includes):
    """A test is named after the file it tests, or tests how files of its folder work together and includes them, maybe
    by a helper beside it."""
    if not path.endswith("_test.cpp") or FREE_TESTS.search(path):
        return
    tested = path[len("tests/"):-len("_test.cpp")]
    folder = tested.rpartition("/")[0] + "/"
    has_file = any((root / (tested + ending)).exists() for ending in (".hpp", ".cpp", ""))
    if not has_file and not any(header.startswith((folder, "tests/" + folder)) for header in includes):
        yield f"{path} tests nothing (there is no {tested}.hpp, and it includes nothing of {folder})"


def closure(edges):
    """For each key all that can be reached from it."""
    reachable = {}
    for start in edges:
        seen, waiting = set(), [start]
        while waiting:
            for target in edges.get(waiting.pop(), ()):
                if target not in seen:
                    seen.add(target)
                    waiting.append(target)
        reachable[start] = seen
    return reachable


def file_cycle_violations(includes_of):
    """Files that need each other (a header and its source are one): none could be read alone."""
    edges = {}
    for path, includes in includes_of.items():
        if path.startswith(ROOMS):
            stem = path.rpartition(".")[0]
            edges.setdefault(stem, set()).update({header.rpartition(".")[0] for header in includes} - {stem})
    reachable = closure(edges)
    cycles = {tuple(sorted(other for other in reachable[stem] if stem in reachable.get(other, ())))
              for stem in edges if stem in reachable[stem]}
    for cycle in sorted(cycles):
        yield f"{', '.join(cycle)} include each other"


def cycle_violations(edges):
    """Folders that need each other: neither could be used or tested alone."""
    reachable = closure(edges)
    for folder in sorted(reachable):
        for target in sorted(reachable[folder]):
            if folder < target and folder in reachable.get(target, set()):
                yield f"{folder} and {target} include each other"


def room_violations(root, paths):
    """A folder of the program says at its top what belongs there, and a page shows its files."""
    files_in = {}
    for path in paths:
        if not path.startswith(("tests/", "tools/")) and path.count("/") > 1:
            files_in.setdefault(path.rpartition("/")[0], []).append(path)
    for folder, files in files_in.items():
        if not (root / folder / "README.md").exists():
            yield f"{folder} has no README.md (one or two sentences say what belongs there)"
        if len(files) > MOST_FILES:
            yield f"{folder} has {len(files)} files (at most {MOST_FILES}: divide it)"


def violations(root):
    found = []
    edges = {}
    includes_of = {}
    types = types_of_the_tree(root)
    for path, text in sources(root):
        includes = includes_of[path] = INCLUDE.findall(text)
        found += include_violations(path, includes)
        found += module_violations(path, includes)
        found += physics_violations(path, text)
        found += type_violations(path, text, types)
        found += counterpart_violations(root, path, includes)
        if path.startswith(ROOMS) and path.count("/") > 1:
            folder = path.rpartition("/")[0]
            needed = {header.rpartition("/")[0] for header in includes if header.startswith(ROOMS) and header.count("/") > 1}
            edges.setdefault(folder, set()).update(needed - {folder})
    found += room_violations(root, includes_of)
    found += [*stale_allowances(root), *heavy_violations(includes_of)]
    return found + [*cycle_violations(edges), *file_cycle_violations(includes_of)]


# (file, content, a part of the message that must appear)
PLANTED = (
    ("framework/a/a.cpp", '#include "components/flow/flow.hpp"\n', "framework/a/a.cpp includes components/flow/flow.hpp"),
    ("framework/a/a.cpp", '#include "couplers/biot.hpp"\n', "includes couplers/biot.hpp"),
    ("components/flow/flow.cpp", '#include "components/contact/contact.hpp"\n', "includes components/contact/contact.hpp"),
    ("components/flow/flow.cpp", '#include "couplers/biot.hpp"\n', "includes couplers/biot.hpp"),
    ("components/capabilities/c.hpp", '#include "components/flow/flow.hpp"\n', "includes components/flow/flow.hpp"),
    ("couplers/b.cpp", '# include "components/flow/flow.hpp"\n', "couplers/b.cpp includes components/flow/flow.hpp"),
    ("framework/a/a.hpp", "#include <vtkNew.h>\n", "framework/a/a.hpp brings vtkNew.h to components/capabilities/c.hpp"),
    ("components/flow/flow.hpp", "#include <Tpetra_CrsMatrix.hpp>\n", "brings Tpetra_CrsMatrix.hpp to components/flow/mpfa/mpfa.cpp"),
    ("framework/a/a.cpp", "#include <gmsh.h>\n", "framework/a/a.cpp includes gmsh.h"),
    ("framework/a/a.cpp", "#include <hdf5.h>\n", "framework/a/a.cpp includes hdf5.h"),
    ("couplers/b.cpp", "#include <vtkNew.h>\n", "couplers/b.cpp includes vtkNew.h"),
    ("framework/a/a.hpp", "#include <yaml-cpp/yaml.h>\n", "brings yaml-cpp/yaml.h to components"),
    ("framework/a/a.cpp", "\n\ndouble fluid_pressure = 0;\n", "framework/a/a.cpp:3 names fluid_pressure"),
    ("framework/a/a.cpp", "struct BiotTerm;\n", "names BiotTerm"),
    ("framework/a/a.cpp", "double slip_rate = 0;\n", "names slip_rate"),
    ("framework/a/a.cpp", '// rock\nauto scheme = "fixed_stress";\n', "framework/a/a.cpp:2 says fixed_stress in a text"),
    ("framework/a/a.cpp", 'auto text = R"(of\nthe rock)";\n', "framework/a/a.cpp:2 says rock in a text"),
    ("framework/a/a.cpp", 'auto url = "https://a.b/crack";\n', "says crack in a text"),
    ("framework/a/a.cpp", 'auto text = "pore";  // "pore" is a name\n', "framework/a/a.cpp:1 says pore in a text"),
    ("framework/a/a.cpp", 'auto text = "name a component of type fine_fracture/…";\n', "says fine_fracture in a text"),
    ("framework/a/a.cpp", 'auto text = "such as that of contact.";\n', "says contact in a text"),
    ("framework/a/a.cpp", "\n// as flow/two_point does\n", "framework/a/a.cpp:2 names the type flow/two_point"),
    ("framework/a/a.cpp", "/* two_point */\n", "framework/a/a.cpp:1 names the type two_point"),
    ("framework/a/a.cpp", 'auto text = "of type flow/…";\n', "names the type flow"),
    ("framework/a/a.hpp", "// what the coupler wall_exchange wants\n", "names the type wall_exchange"),
    ("framework/scene/probe.cpp", 'auto text = "The field, for example pore.stress.";\n', "says stress in a text"),
    ("framework/scene/probe.cpp", "// no example\n", "allows a text that framework/scene/probe.cpp has no more"),
    ("tests/framework/a/gone_test.cpp", '#include "framework/b/b.hpp"\n', "tests/framework/a/gone_test.cpp tests nothing"),
    ("framework/b/b.cpp", '#include "framework/a/a.hpp"\n', "framework/a and framework/b include each other"),
    ("components/flow/flow.cpp", '#include "components/flow/mpfa/mpfa.hpp"\n',
     "components/flow/flow, components/flow/mpfa/mpfa include each other"),
    ("framework/a/a.hpp", '#include "framework/a/inner/y.hpp"\n', "framework/a and framework/a/inner include each other"),
    ("components/flow/other.cpp", '#include "components/flow/mpfa/mpfa.hpp"\n', "components/flow and components/flow/mpfa include each other"),
    ("framework/b/private.hpp", '#include "framework/b/b.hpp"\n', "framework/b/b, framework/b/private include each other"),
    ("framework/c/c.cpp", "", "framework/c has no README.md"),
)

CLEAN = {
    "framework/a/a.hpp": '#include "framework/b/b.hpp"\n#include <vector>\n// the pressure of "pore.pressure"\n',
    "framework/a/a.cpp": '#include <umfpack.h>\nconst char* link = "https://a.b/constraint";\n/* traction\n*/\n',
    "framework/a/inner/x.cpp": '#include "framework/a/a.hpp"\n',
    "framework/a/inner/y.hpp": "",
    "framework/scene/probe.cpp": 'auto text = "The field, for example pore.pressure.";\n',
    "framework/b/b.hpp": "",
    "framework/b/private.hpp": "#include <umfpack.h>\n",
    "framework/b/b.cpp": '#include "framework/b/private.hpp"\n',
    "framework/b/x_module/x.cpp": "#include <vtkNew.h>\n",
    "components/capabilities/c.hpp": '#include "framework/a/a.hpp"\n',
    "components/flow/flow.hpp": '#include "components/capabilities/c.hpp"\ndouble pressure = 0;\n',
    "components/flow/mpfa/mpfa.cpp": '#include "components/flow/flow.hpp"\n',
    "components/flow/two_point.cpp": 'const RegisterComponent<TwoPoint,\n    Options> registration(\n    "flow/two_point");\n',
    "couplers/b.cpp": '#include "components/capabilities/c.hpp"\n#include "couplers/helper.hpp"\n'
                      'const RegisterCoupler<Wall, Options> registration("wall_exchange");\n',
    "tests/components/flow/mpfa_test.cpp": '#include "couplers/b.hpp"\n',
    "tests/framework/a/a_test.cpp": '#include "components/flow/flow.hpp"\n',
    "tests/framework/a/together_test.cpp": '#include "framework/a/a.hpp"\n',
    "tests/verification/mandel_test.cpp": "",
    **{f"{folder}/README.md": "What belongs here.\n" for folder in (
        "framework/a", "framework/a/inner", "framework/b", "framework/b/x_module", "framework/scene", "components/capabilities", "components/flow", "components/flow/mpfa")},
}


def write_tree(root, files):
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text, encoding="utf-8")


def self_test():
    """What is wrong with the checker itself."""
    with tempfile.TemporaryDirectory() as folder:
        write_tree(Path(folder), CLEAN)
        yield from (f"self-test: a clean tree is accused: {violation}" for violation in violations(Path(folder)))
    for path, text, message in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            write_tree(Path(folder), {**CLEAN, path: text})
            if not any(message in violation for violation in violations(Path(folder))):
                yield f"self-test: not noticed: {message}"


def main():
    root = Path(__file__).resolve().parent.parent
    found = violations(root) + list(self_test())
    for violation in found:
        print(violation)
    print(f"{sum(1 for _ in sources(root))} files, {len(PLANTED)} planted violations, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
