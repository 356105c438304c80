#!/usr/bin/env python3
"""install_test.py BUILD CMAKE CPACK: what is installed runs from where it is put, also after it has moved, without the
tree that it was built in; and so does what a Debian package holds."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

build, cmake, cpack = sys.argv[1:4]
problems = []
FILES = ("bin/sprekk", "lib/sprekk/sprekk_gmsh.so", "lib/sprekk/sprekk_trilinos.so", "lib/sprekk/sprekk_vtk.so", "lib/sprekk/sprekk_hdf5.so",
         "share/man/man1/sprekk.1", "share/bash-completion/completions/sprekk", "share/zsh/vendor-completions/_sprekk",
         "share/sprekk/scene.schema.json", "share/sprekk/study.schema.json", "share/doc/sprekk/copyright",
         "share/doc/sprekk/examples/tutorial/first_scene.yaml", "share/doc/sprekk/examples/scene.schema.json")


def run(*command, **more):
    """Words of the command, and whether it has ended well. Nothing of the environment of the tests helps it."""
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "OPENBLAS_NUM_THREADS": "1"}, **more)
    return done.stdout + done.stderr, done.returncode == 0


def expect(what, condition, found):
    if not condition:
        problems.append(f"{what}: {found}")


def check_prefix(what, prefix, scratch):
    for file in FILES:
        expect(what, (prefix / file).is_file(), f"lacks {file}")
    program = str(prefix / "bin/sprekk")
    run_path = run("readelf", "-d", program)[0]
    expect(what, "$ORIGIN/../lib/sprekk]" in run_path, run_path)
    expect(what, build not in run_path, "knows the folder of its build")
    scene = str(prefix / "share/doc/sprekk/examples/tutorial/first_scene.yaml")
    results = str(scratch / "results")
    shutil.rmtree(results, ignore_errors=True)
    for command in (("--version",), ("check", scene),  # opens gmsh
                    ("run", scene, "-q", "-o", results, "--set", "time.end=4h", "--set", "solver.type=belos"),  # trilinos
                    ("report", results)):  # vtk
        text, is_fine = run(program, *command, cwd=scratch)
        expect(f"{what}, {command[0]}", is_fine, text)
    hidden = prefix / "lib/hidden"
    (prefix / "lib/sprekk").rename(hidden)
    text, is_fine = run(program, "check", scene)
    expect(f"{what}, without its modules", not is_fine and "cannot open the module sprekk_gmsh.so" in text, text)
    hidden.rename(prefix / "lib/sprekk")


def main():
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        first, moved = scratch / "first", scratch / "moved elsewhere"
        text, is_fine = run(cmake, "--install", build, "--prefix", str(first))
        expect("cmake --install", is_fine, text)
        os.rename(first, moved)
        check_prefix("an installation that has moved", moved, scratch)

        text, is_fine = run(cpack, "-B", str(scratch / "package"), cwd=build)
        expect("cpack", is_fine, text)
        packages = list((scratch / "package").glob("sprekk_*.deb"))
        expect("cpack", len(packages) == 1, packages)
        if packages:
            root = scratch / "root"
            text, is_fine = run("dpkg-deb", "-x", str(packages[0]), str(root))
            expect("dpkg-deb -x", is_fine, text)
            check_prefix("the package", root / "usr", scratch)
            depends = run("dpkg-deb", "-f", str(packages[0]), "Depends")[0]
            for library in ("libgmsh", "libvtk9", "libtrilinos-muelu", "libumfpack", "libhdf5", "libyaml-cpp", "libc6"):
                expect("the package does not ask for", library in depends, library)
            outside = [str(file.relative_to(root)) for file in root.rglob("*")
                       if file.is_file() and not file.relative_to(root).as_posix().startswith("usr/")]
            expect("the package has files outside of /usr", not outside, outside)
    for problem in problems:
        print(problem)
    print(f"{len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
