#!/usr/bin/env python3
"""Every threshold of the sources has a name, and a comment beside it that says why it has this value; the numbers that
docs/numerics/tolerances.md tells are those of the sources.

A number counts as a threshold where it has a decimal point or a power of ten and is none of the few of NO_THRESHOLDS, and, where
it is whole, from SMALLEST_WHOLE on in a comparison, a minimum, a maximum or a clamp. It has a name where it defines a constant or
is the default of a parameter or member. A comment is beside it on its own line, or above it, or above the definitions that are
directly above it; a unit alone is none. Without arguments: checks the tree this file is in, then itself on planted violations.
Exit code 1 if anything is wrong.
"""

import math
import re
import sys
import tempfile
from pathlib import Path

FOLDERS = ("framework", "components", "couplers")
PAGE = "docs/numerics/tolerances.md"
# Numbers of closed forms: halves, and counts.
NO_THRESHOLDS = {-1.0, 0.0, 0.5, 1.0, 2.0, 100.0}
SMALLEST_WHOLE = 10
# Where numbers are data or a drawing's form: (file or folder, why).
EXEMPT = (
    ("framework/picture/", "how a drawing looks"),
    ("framework/report/", "how a page looks"),
    ("framework/compare/difference_page.cpp", "how a page looks"),
    ("framework/schemes/scheme_picture.cpp", "how a drawing looks"),
    ("framework/compare/difference_tables.cpp", "how a text looks"),
    ("framework/converge/convergence.cpp", "how a text looks"),
    ("framework/command_line/", "how texts and the memory are arranged"),
    ("framework/config/describe/explain.cpp", "how a text looks"),
    ("framework/config/input_error.cpp", "how a text looks"),
    ("framework/config/unit.cpp", "units"),
    ("framework/output/hdf5_module/hdf5_module.cpp", "a file's format"),
    ("framework/output/progress.cpp", "how a text looks"),
    ("framework/study/sample_points.cpp", "digits of numbers, and a published table (Joe and Kuo 2008)"),
    ("components/capabilities/usual_ranges.hpp", "published ranges, each with its source; outside of them a scene has a note"),
    ("components/fine_fracture/growth/kink.cpp", "coefficients of a published fit (Amestoy and Leblond 1992)"),
    ("components/fine_fracture/fine_level/quadrature.cpp", "points and weights of quadratures"),
    ("components/poromechanics/fem/gauss_points.hpp", "points and weights of a quadrature"),
)
# Single numbers and constants that decide nothing: (file, name or number as it stands there, why).
EXEMPT_ONES = (
    ("components/poromechanics/fem/plane/face_functions.cpp", "mean_of_own", "the mean of a function over a face"),
    ("components/poromechanics/fem/space/reference_cell.cpp", "orbits", "points and weights of a quadrature"),
    ("framework/config/dimension.cpp", "27", "a count"),
    ("framework/config/expression.cpp", "1e-2", "the size of made-up units, such as no two products of powers are equal"),
    ("framework/linear/direct/mumps_solver.cpp", "its_own_choice", "an option of MUMPS"),
    ("framework/linear/direct/near_singular.cpp", "0x1p-52", "random numbers from whole ones"),
    ("framework/linear/iterative/belos_solver.hpp", "smallest_size", "beginning of a search for the least"),
    ("framework/meshing/plane/distort_mesh.cpp", "4294967296.0", "2^32, the range of the random numbers"),
    ("framework/meshing/gmsh_module/gmsh_model.cpp", "1e-9", "gmsh's own defaults, which a model before may have changed"),
    ("framework/meshing/gmsh_module/gmsh_module.hpp", "random_factor", "gmsh's own default"),
    ("framework/meshing/gmsh_module/gmsh_module.cpp", "three_node_triangle", "gmsh's number of a type"),
    ("framework/meshing/gmsh_module/gmsh_module.cpp", "four_node_tetrahedron", "gmsh's number of a type"),
    ("framework/meshing/msh_file.cpp", "pyramid", "gmsh's number of a type"),
    ("framework/meshing/msh_file.cpp", "volumes", "gmsh's numbers of types"),
    ("framework/meshing/geometry.hpp", "box_sides", "names"),
    ("framework/meshing/spec/space/places.cpp", "places_x", "places at which an expression is tried"),
    ("framework/meshing/spec/space/places.cpp", "places_y", "places at which an expression is tried"),
    ("framework/meshing/msh_file.cpp", "26", "gmsh's number of a type"),
    ("framework/meshing/msh_file.cpp", "28", "gmsh's number of a type"),
    ("framework/meshing/plane/size_field.cpp", "3.0", "the area of an equilateral triangle"),
    ("framework/meshing/plane/unstructured_mesh.cpp", "box_segments", "sides of a rectangle"),
    ("framework/schedule/time_scheme.hpp", "sdirk2_share", "a coefficient of a scheme"),
    ("framework/study/quantiles.hpp", "quantile_shares", "what a table shows"),
    ("framework/study/sample_points.hpp", "most_sobol_dimensions", "the length of a published table"),
    ("framework/output/checkpoint.cpp", "format_version", "a file's format"),
    ("framework/output/output_folder.cpp", "128", "the first byte that is no ASCII character"),
    ("framework/remeshing/overlap.cpp", "most_corners", "corners of two quadrilaterals and of what they share"),
    ("framework/study/comparison.cpp", "plots_by_default", "how a page looks"),
    ("components/poromechanics/start_balance.cpp", "mega", "a unit in a text"),
    ("components/contact/state_of_contact.cpp", "mega", "a unit in a text"),
    ("framework/study/study.cpp", "128", "the first byte that is no ASCII character"),
    ("framework/triangulation/delaunay.hpp", "outer_points", "corners of a square"),
    ("components/fine_fracture/growth/grow_tips.cpp", "1e3", "m to mm in a text"),
    ("components/fine_fracture/growth/mixed_mode.cpp", "1.5", "the stress field at a tip"),
    ("components/fine_fracture/growth/mixed_mode.cpp", "8.0", "the direction of its largest tension in closed form"),
    ("components/fine_fracture/boundary_element/density_integrals.cpp", "4.0", "a derivative"),
    ("components/fine_fracture/boundary_element/density_integrals.cpp", "whole", "exponents"),
    ("components/fine_fracture/boundary_element/density_integrals.cpp", "half", "exponents"),
    ("components/fine_fracture/boundary_element/density_integrals.cpp", "both", "exponents"),
    ("components/fine_fracture/boundary_element/density_integrals.cpp", "points", "a quadrature"),
    ("components/fine_fracture/boundary_element/boundary_model.cpp", "outline_places", "a quadrature"),
    ("components/fine_fracture/quarter_point/mesh/fine_mesh.cpp", "right_angle", "a number of mathematics"),
    ("components/fine_fracture/quarter_point/elasticity/adapt.cpp", "3.0", "the area of an equilateral triangle"),
    ("components/fine_fracture/quarter_point/elasticity/auxiliary_field.cpp", "0.75", "derivatives of a complex potential"),
    ("components/fine_fracture/quarter_point/elasticity/error_estimate.cpp", "degree", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/error_estimate.cpp", "along_rays", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/error_estimate.cpp", "across", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/forces.cpp", "edge_points", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/forces.cpp", "degree", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/forces.cpp", "along_rays", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/forces.cpp", "across", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/interaction_integral.cpp", "along_rays", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/interaction_integral.cpp", "across", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/interaction_integral.cpp", "degree", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/interaction_integral.cpp", "points", "a quadrature"),
    ("components/fine_fracture/quarter_point/elasticity/interaction_integral.hpp", "domains", "a count"),
    ("components/fine_fracture/quarter_point/elasticity/interaction_integral.hpp", "fields", "a count"),
    ("components/fine_fracture/quarter_point/elasticity/stiffness_factors.cpp", "12", "two components of six nodes"),
    ("components/fine_fracture/tips/front_jump.cpp", "1e3", "m to mm in a text"),
    ("components/fine_fracture/tips/growth_ends.cpp", "1e3", "m to mm in a text"),
    ("components/fine_fracture/tips/saved_tips.cpp", "state_size", "a count"),
    ("components/fracture_flow/tpfa/mean_along.cpp", "place", "points of a quadrature"),
    ("components/fine_fracture/growth/viscous_tip.cpp", "place", "points of a quadrature"),
    ("components/fine_fracture/growth/viscous_tip.cpp", "weight", "its weights"),
    ("components/fracture_flow/tpfa/mean_along.cpp", "weight", "its weights"),
    ("components/fracture_flow/tpfa/mean_along.cpp", "0.75", "a substitution in it"),
    ("components/fracture_flow/tpfa/mean_along.hpp", "count", "a quadrature"),
    ("components/matrix_flow/rt0/flux_mass.cpp", "of_corners", "a place in the unit square"),
    ("components/matrix_flow/rt0/flux_mass.cpp", "of_gauss", "points of a quadrature"),
    ("components/poromechanics/mpsa/plane/tip_field.cpp", "1.5", "the power of a term of the field at a tip"),
    ("components/poromechanics/mpsa/plane/tip_field.cpp", "linear_terms", "a count"),
    ("components/poromechanics/mpsa/plane/tip_field.cpp", "place", "points of a quadrature"),
    ("components/poromechanics/mpsa/plane/tip_field.cpp", "weight", "its weights"),
    ("components/poromechanics/mpsa/plane/tip_field.hpp", "terms", "a count"),
)

# Comments and texts; apostrophes within numbers are no texts.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<![0-9])\'(?:\\.|[^\'\\])\'', re.DOTALL)
NUMBER = re.compile(r"(?<![\w.'])(?:0x1p[-+]?\d+|\d[\d']*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")
RANGE = re.compile(r"\.range\s*=\s*(?:\{[^}]*\}|[\w:]+\([^()]*\))")
TYPE = r"(?:double|int|long|unsigned|hsize_t|auto|std::size_t|std::array(?:<[^=;]*?>)?)"
CONSTANT = re.compile(rf"\bconstexpr\s+(?:{TYPE}\s+(?P<list>\w+(?:\[\])?\s*(?:=|\{{)[^;]*)|\w+\s+(?P<array>\w+\[\]\s*=[^;]*));")
MEMBER = re.compile(r"^[ \t]*(?:std::optional<double>|double|int|long|std::size_t)\s+(?P<list>\w+\s*=\s*[^;()]*);", re.MULTILINE)
ARGUMENT = re.compile(r"[(,]\s*(?:double|int|long|std::size_t)\s+(?P<list>\w+\s*=\s*[^,();]*)(?=[,)])")
COMPARED = re.compile(r"(?<= [<>] )(\d[\d']*)(?![\w.'])|(?<= [<>]= )(\d[\d']*)(?![\w.'])|(?<![\w.'])(\d[\d']*)(?= [<>]=? )"
                      r"|\b(?:min|max|clamp)\((?:[^()]|\([^()]*\))*?(?<=[(, ])(\d[\d']*)(?=[,)])")


def blank(match):
    """As long, with the same line breaks."""
    return re.sub(r"[^\n]", " ", match.group())


def code_of(text):
    code = NO_CODE.sub(lambda match: blank(match) if match.group()[0] in "/'" else '"' + blank(match)[2:] + '"', text)
    code = re.sub(r"^\s*#.*$", blank, code, flags=re.MULTILINE)
    return RANGE.sub(blank, code)


def split(text):
    """At commas outside of brackets."""
    parts, depth, start = [], 0, 0
    for i, character in enumerate(text):
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return [part.strip() for part in (*parts, text[start:])]


NAMES = {"pi": math.pi, "sqrt2": math.sqrt(2), "sqrt3": math.sqrt(3)}


def value_of(expression):
    """Of a C++ expression of numbers: a number, or None."""
    if re.fullmatch(r"0x1p[-+]?\d+", expression.strip()):
        return float.fromhex(expression.strip())
    text = re.sub(r"\bstd::numbers::(\w+)", r"\1", expression.strip().replace("'", ""))
    text = re.sub(r"std::numeric_limits<double>::epsilon\(\)", repr(sys.float_info.epsilon), text)
    text = re.sub(r"std::size_t\{(\d+)\}|hsize_t\{(\d+)\}", lambda match: match.group(1) or match.group(2), text)
    text = re.sub(r"(?<=\d)[UL]+\b", "", text)
    if not re.fullmatch(r"[-+*/().\deE\s<]*", re.sub(r"\b(pi|sqrt2|sqrt3)\b", "", text)):
        return None
    try:
        # A quotient of whole numbers is whole.
        if re.fullmatch(r"\s*\d+\s*/\s*\d+\s*", text):
            text = text.replace("/", "//")
        return float(eval(text, {"__builtins__": {}}, NAMES))  # figures and signs alone, as matched above
    except (SyntaxError, ValueError, TypeError, ZeroDivisionError):
        return None


def numbers_of(expression):
    """The values of a constant: of a list each."""
    if not expression.strip().startswith("{"):
        return [value_of(expression)]
    return [value_of(part) for part in re.sub(r"[{}]", "", expression).split(",")]


def is_exempt(path, name=None):
    return any(path.startswith(start) for start, _ in EXEMPT) or any(
        path == file and name == other for file, other, _ in EXEMPT_ONES)


def declarations(path, code):
    """(name, expression, start, end, kind) of constants, and of members, arguments and variables with a default."""
    for kind in (CONSTANT, MEMBER, ARGUMENT):
        for match in kind.finditer(code):
            for part in split(match.groupdict().get("array") or match.group("list")):
                declared = re.match(r"(\w+)(?:\[\])?\s*(?:=\s*)?(.*)", part, re.DOTALL)
                if declared:
                    yield declared.group(1), declared.group(2), match.start(), match.end(), kind


def is_threshold(expression):
    """Whether a constant is defined by numbers that may be thresholds: not by other constants, and not 0, 1 or −1."""
    literals = [value_of(literal) for literal in NUMBER.findall(expression)]
    is_derived = re.search(r"[a-z_]\w*", re.sub(r"\bstd::size_t\b|std::numbers::\w+|std::numeric_limits<double>::epsilon|[\d.]e[-+]?\d|0x1p|hsize_t", "", expression))
    return any(literal not in (NO_THRESHOLDS if is_derived else (0, 1)) for literal in literals)


def raw_numbers(path, code):
    """(line, number) of thresholds without a name."""
    # A variable in a function is no name for a threshold, a member in a header is.
    named = [(start, end) for _, _, start, end, kind in declarations(path, code) if kind is CONSTANT or path.endswith(".hpp")]

    def has_name(at):
        return any(start <= at < end for start, end in named)

    for match in NUMBER.finditer(code):
        literal = match.group()
        if re.search(r"[.ep]", literal, re.IGNORECASE) and value_of(literal) not in NO_THRESHOLDS and not has_name(match.start()):
            yield code.count("\n", 0, match.start()) + 1, literal
    for match in COMPARED.finditer(code):
        literal = next(group for group in match.groups() if group)
        if int(literal.replace("'", "")) >= SMALLEST_WHOLE and not has_name(match.start()):
            yield code.count("\n", 0, match.start()) + 1, literal


def parameters(root, folder):
    """What sections of scenes name in the files of a folder: the reference tells their values."""
    text = "".join(file.read_text(encoding="utf-8") for file in sorted((root / folder).glob("*.?pp")))
    return set(re.findall(r'\(\s*"\w+",\s*(?:\w+\.)*(\w+)\b', text))


def numbers_of_cell(cell):
    """Values of the page: "1e-9, 15°, 1/4 and 64 ε". Units are after a space and do not count, degrees become radians."""
    values = []
    for part in re.split(r", |; | and ", cell.replace("−", "-").replace("·", "*")):
        part = re.sub(r"(?<=\d),(?=\d{3})", "", part.strip())
        match = re.match(r"(?P<base>[-+]?[\d.]+(?:e[-+]?\d+)?)(?:/(?P<over>\d+)|\^(?P<power>-?\d+))?", part)
        if not match:
            values.append(None)
            continue
        rest = part[match.end():].strip()
        unit = sys.float_info.epsilon if rest.startswith("ε") else math.pi / 180 if rest.startswith("°") else 1
        values.append(float(match["base"]) ** int(match["power"] or 1) / int(match["over"] or 1) * unit)
    return values


NAMED_IN = re.compile(r"((?:`\w+`(?:, )?)+) in ((?:`[\w./]+`(?: and )?)+)")


def told(text):
    """(line, name, value, end of the path) of each number of the page: of the cells "1e-2, 0.9" and "`closed`, `near` in `a.cpp`"."""
    for line, row in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in row.strip().strip("|").split("|")]
        for at in range(1, len(cells)):
            found = [(names, place) for names, places in NAMED_IN.findall(cells[at]) for place in re.findall(r"`([\w./]+)`", places)]
            values = numbers_of_cell(cells[at - 1]) if found else []
            for names, place in found:
                for k, name in enumerate(re.findall(r"`(\w+)`", names)):
                    yield line, name, values[k] if len(values) > 1 and k < len(values) else values[0], place


def are_same(a, b):
    return a is not None and b is not None and math.isclose(a, b, rel_tol=1e-9)


# A definition, in the run of those that one comment may stand above.
DEFINITION = re.compile(r"^\s*(?:(?:static|inline)\s+)*(?:constexpr\b|(?:std::optional<double>|double|int|long|std::size_t)\s+\w+\s*=)")


def has_comment(lines, first, last):
    """Whether one of more than a word is beside the definition in these lines."""
    own = " ".join(line.partition("//")[2] for line in lines[first : last + 1])
    end = first
    while end > 0 and DEFINITION.match(lines[end - 1]):
        end -= 1
    begin = end
    while begin > 0 and lines[begin - 1].lstrip().startswith("//"):
        begin -= 1
    return any(len(re.findall(r"[\w^]+", text)) > 1 for text in (own, " ".join(lines[begin:end])))


def violations(root):
    found = []
    files = sorted(file.relative_to(root).as_posix() for top in FOLDERS for file in (root / top).rglob("*.?pp"))
    exempt = set()
    keys_of = {}
    defined = {}  # (path, name): values
    for path in files:
        text = (root / path).read_text(encoding="utf-8")
        code, lines = code_of(text), text.splitlines()
        exempt.update((path, name) for name, *_ in declarations(path, code))
        exempt.update((path, literal) for literal in NUMBER.findall(code))
        for line, literal in raw_numbers(path, code):
            if not is_exempt(path, literal):
                found.append(f"{path}:{line} has the number {literal} without a name (give it one, and a comment beside it)")
        for name, expression, start, end, kind in declarations(path, code):
            defined.setdefault((path, name), []).extend(numbers_of(expression))
            if not is_threshold(expression) or is_exempt(path, name) or (kind is not CONSTANT and not path.endswith(".hpp")):
                continue
            folder = path.rpartition("/")[0]
            if kind is not CONSTANT and name in keys_of.setdefault(folder, parameters(root, folder)):
                continue
            statement = start + len(code[start:end]) - len(code[start:end].lstrip())
            first, last = code.count("\n", 0, statement), code.count("\n", 0, end)
            if kind is ARGUMENT:  # the comment is that of the function
                while first > 0 and lines[first - 1].strip() and not re.search(r"^\s*//|[;{}]\s*$", lines[first - 1]):
                    first -= 1
            if not has_comment(lines, first, last):
                found.append(f"{path}:{first + 1} {name} = {expression.strip()} has no comment that says why (a part of what, why this value)")
    for line, name, value, place in told((root / PAGE).read_text(encoding="utf-8")):
        values = [values for (path, other), values in defined.items() if other == name and ("/" + path).endswith("/" + place)]
        if len(values) != 1:
            found.append(f"{PAGE}:{line} names {name} in {place}, of which there are {len(values)}")
        elif not any(are_same(value, other) for other in values[0]):
            found.append(f"{PAGE}:{line} says {value} of {name} in {place}, which is {', '.join(str(other) for other in values[0])}")
    return found + [f"tests/thresholds_test.py exempts {name} of {file}, which is not there" for file, name, _ in EXEMPT_ONES
                    if root == Path(__file__).resolve().parent.parent and (file, name) not in exempt]


# (file, content, a part of the message that must appear, or None where nothing is wrong)
PLANTED = (
    ("framework/a/a.cpp", "bool f(double x) { return x < 1e-7; }\n", "framework/a/a.cpp:1 has the number 1e-7 without a name"),
    ("framework/a/a.cpp", "\n// 1e-7\ndouble f(double x) { return std::max(x, 0.3); }\n", "framework/a/a.cpp:3 has the number 0.3"),
    ("framework/a/a.cpp", "double f(double x) {\n  const double least = 1e-7 * x;\n  return least;\n}\n", "the number 1e-7"),
    ("framework/a/a.cpp", "bool f(int n) { return n > 40; }\n", "framework/a/a.cpp:1 has the number 40"),
    ("framework/a/a.cpp", "int f(int n) { return std::min(n, 1'000); }\n", "has the number 1'000"),
    ("framework/a/a.cpp", "constexpr double far = 1e9;\n", "framework/a/a.cpp:1 far = 1e9 has no comment"),
    ("framework/a/a.cpp", "constexpr double far = 1e9;  // m\n", "framework/a/a.cpp:1 far = 1e9 has no comment"),
    ("framework/a/a.cpp", "// Of nothing here.\nint f();\nconstexpr double far = 1e9;\n", "framework/a/a.cpp:3 far = 1e9 has no comment"),
    ("framework/a/a.cpp", "constexpr double small = 1e-7, far = 1e9;\n", "far = 1e9 has no comment"),
    ("framework/a/a.cpp", "constexpr double angle = 20 * std::numbers::pi / 180;\n", "angle = 20 * std::numbers::pi / 180 has no comment"),
    ("framework/a/a.cpp", "constexpr std::array parts = {0.3, 0.6};\n", "parts = {0.3, 0.6} has no comment"),
    ("framework/a/a.cpp", "constexpr double small = 1e-8;  // of an edge\n", "tolerances.md:3 says 1e-07 of small in a.cpp, which is 1e-08"),
    ("framework/a/a.cpp", "constexpr double other = 2;  // of an edge\n", "tolerances.md:3 names small in a.cpp, of which there are 0"),
    ("framework/a/a.hpp", "struct Options {\n  double least = 0.2;\n};\n", "framework/a/a.hpp:2 least = 0.2 has no comment"),
    ("framework/a/a.hpp", "void f(double least = 0.2);\n", "framework/a/a.hpp:1 least = 0.2 has no comment"),
    (PAGE, "| key | 1e-7 | `small` in `gone.cpp` |\n", "tolerances.md:1 names small in gone.cpp, of which there are 0"),
    (PAGE, "| key | tiny | `small` in `a.cpp` |\n", "says None of small"),
    ("framework/a/b.cpp", "const char* text = \"x < 1e-7\";  // x > 40\ntemplate <class T> void g(std::array<T, 64> x);\n", None),
    ("framework/a/b.cpp", "double f(double a, double b) { return 0.5 * (a + b) - 2.0 * 1.0; }\n", None),
    ("framework/a/b.cpp", "/// Of an edge: round-off.\nconstexpr double one = 1e-7;\nconstexpr double other = 3;\n", None),
    ("framework/a/b.hpp", 'struct Options {\n  double least = 0.2;\n};\n// spec.quantity("least", least, {});\n', None),
    ("framework/a/b.hpp", "/// As long as no edge.\nvoid f(int a,\n       double least = 0.2);\n", None),
    ("framework/a/b.cpp", "spec.quantity(x, {.range = between(0.1, 1.55), .doc = \"\"});\n", None),
)
CLEAN = {
    PAGE: "| key | default | in the sources |\n|---|---|---|\n| key | 1e-7 | `small` in `a.cpp` |\n",
    "framework/a/a.cpp": "constexpr double small = 1e-7;  // of an edge: round-off\n",
}


def self_test():
    """What is wrong with the checker itself."""
    for path, text, message in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            for file, content in {**CLEAN, path: text}.items():
                (Path(folder) / file).parent.mkdir(parents=True, exist_ok=True)
                (Path(folder) / file).write_text(content, encoding="utf-8")
            found = violations(Path(folder))
            if message is None:
                yield from (f"self-test: accused without reason: {violation}" for violation in found)
            elif not any(message in violation for violation in found):
                yield f"self-test: not noticed: {message} (but {found})"


def main():
    root = Path(__file__).resolve().parent.parent
    found = violations(root) + list(self_test())
    for violation in found:
        print(violation)
    print(f"{len(PLANTED)} planted cases, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
