#!/usr/bin/env python3
"""shell_test.py PROGRAM: the manual page is one for man, and completions propose what the program knows."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

program = os.path.abspath(sys.argv[1])
problems = []


def output(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


def expect(what, condition, found=""):
    if not condition:
        problems.append(f"{what}: {found}")


def commands():
    """The names and options of all commands, as --help tells them."""
    listed = output(program, "--help").partition("Subcommands:\n")[2]
    names = re.findall(r"^  ([a-z]+) ", listed, re.MULTILINE)
    return {name: re.findall(r"(?<![\w-])(--?[a-z][a-z-]*)", output(program, name, "--help").partition("Options:")[2])
            for name in names}


def check_manual(folder, known):
    page = Path(folder) / "sprekk.1"
    page.write_text(output(program, "man"), encoding="utf-8")
    name = output("lexgrog", str(page))
    expect("lexgrog", '"sprekk - coupled simulations of fractured porous rock"' in name, name)
    read = subprocess.run(["man", "--warnings", "-l", str(page)], capture_output=True, text=True, check=True,
                          env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "200", "MAN_KEEP_FORMATTING": ""})
    expect("warnings of man", not read.stderr, read.stderr)
    for command, options in known.items():
        expect("the manual page", f"sprekk {command}" in read.stdout, f"lacks {command}")
        for option in options:
            expect("the manual page", option in read.stdout, f"lacks {option} of {command}")
    expect("the manual page", "for example grow" in read.stdout and "1e-" not in read.stdout, "an example is broken")


def proposed(folder, *words):
    """What bash proposes for the last of the words."""
    script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _sprekk; '
              'printf "%s\\n" "${COMPREPLY[@]}"')
    text = output("bash", "-c", script, "bash", str(Path(folder) / "sprekk"), program, *words, cwd=folder)
    return set(text.split("\n")) - {""}


def check_bash(folder, known):
    (Path(folder) / "sprekk").write_text(output(program, "completion", "bash"), encoding="utf-8")
    for file in ("one.yaml", "two words.yaml", "three.txt", "checkpoint.h5", "graph.svg", "study/inner.yaml"):
        (Path(folder) / file).parent.mkdir(exist_ok=True)
        (Path(folder) / file).touch()
    expect("commands", set(known) <= proposed(folder, ""), proposed(folder, ""))
    expect("a command", proposed(folder, "sw") == {"sweep"}, proposed(folder, "sw"))
    for command, options in known.items():
        found = proposed(folder, command, "--")
        expect(f"options of {command}", {o for o in options if o.startswith("--")} == found, found)
    for words, wanted in (
            (("run", ""), {"one.yaml", "two words.yaml", "study"}),
            (("run", "one.yaml", "tw"), {"two words.yaml"}),
            (("run", "study/"), {"study/inner.yaml"}),
            (("run", "one.yaml", "-o", ""), {"study"}),
            (("run", "one.yaml", "--restart", "ch"), {"checkpoint.h5"}),
            (("graph", "one.yaml", "-o", "g"), {"graph.svg"}),
            (("report", ""), {"study"}),
            (("schema", ""), {"scene", "study"}),
            (("completion", "z"), {"zsh"}),
            (("explain", "contact/"), {"contact/augmented_lagrangian", "contact/coulomb", "contact/penalty"}),
            (("explain", "it"), {"iterate"})):
        found = proposed(folder, *words)
        expect(f"after {' '.join(words)!r}", found == wanted, found)


def check_zsh(folder, known):
    text = output(program, "completion", "zsh")
    for command, options in known.items():
        arguments = re.search(rf"^    {command}\) _arguments.*?;;", text, re.MULTILINE | re.DOTALL)
        expect("zsh", arguments is not None, f"lacks {command}")
        for option in options:
            expect("zsh", arguments is not None and f"{option}[" in arguments[0], f"lacks {option} of {command}")
    if shutil.which("zsh") is None:
        print("zsh is not installed: its script was not read by it")
        return
    (Path(folder) / "_sprekk").write_text(text, encoding="utf-8")
    read = subprocess.run(["zsh", "-n", str(Path(folder) / "_sprekk")], capture_output=True, text=True, check=False)
    expect("zsh reads its script", read.returncode == 0 and not read.stderr, read.stderr)


def main():
    known = commands()
    expect("commands of --help", {"run", "check", "sweep", "report", "explain", "man", "completion"} <= set(known), known)
    with tempfile.TemporaryDirectory() as folder:
        check_manual(folder, known)
    with tempfile.TemporaryDirectory() as folder:
        check_bash(folder, known)
    with tempfile.TemporaryDirectory() as folder:
        check_zsh(folder, known)
    for problem in problems:
        print(problem)
    print(f"{len(known)} commands, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
