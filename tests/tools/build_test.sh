#!/usr/bin/env bash
# What tools/build says: with a ninja that only prints. One line for a pipe, progress for a terminal, nothing when there is
# nothing to do, and the compiler's words when it fails.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/programs" "$scratch/tree/tools" "$scratch/tree/build/release"
cp "$root/tools/build" "$root/tools/environment.sh" "$scratch/tree/tools/"
printf '#!/bin/sh\nexit 0\n' >"$scratch/tree/tools/install"
printf '#!/bin/sh\nexit 0\n' >"$scratch/programs/cmake"
cat >"$scratch/programs/ninja" <<'END'
#!/bin/sh
[ "$NINJA_STATUS" = "[%f/%t %e] " ] || echo "wrong status"
cat "$NINJA_SAYS"
[ ! -e "$NINJA_SAYS.fails" ]
END
chmod +x "$scratch/programs/"* "$scratch/tree/tools/"*
export PATH=$scratch/programs:$PATH NINJA_SAYS=$scratch/says
unset SPREKK_BUILD

failures=0
expect() {  # expect WHAT WANTED FOUND
  [ "$2" = "$3" ] && return
  failures=$((failures + 1))
  printf '%s\n  wanted: %q\n  found:  %q\n' "$1" "$2" "$3"
}
build() { "$scratch/tree/tools/build" sprekk 2>&1; }
on_terminal() { script -qec "$scratch/tree/tools/build sprekk" /dev/null | sed 's/\x1b\[K/|/g' | tr -d '\r\n'; }

printf '[0/1 0.010] Re-checking globbed directories...\nninja: no work to do.\n' >"$NINJA_SAYS"
expect "nothing to do" "" "$(build)"
expect "nothing to do, on a terminal" "" "$(on_terminal)"

printf '%s\n' '[1/2 0.100] Re-running CMake...' '[1/300 2.000] Building CXX a.o' '[100/300 200.500] Building CXX b.o' \
  '[298/300 400.000] Linking CXX c' >"$NINJA_SAYS"
expect "a build" "building sprekk …" "$(build)"
expect "a build on a terminal" "|building sprekk: 1 of 300|building sprekk: 100 of 300, about 7 min left|building sprekk: 298 of 300, about 2 s left|" \
  "$(on_terminal)"

printf '%s\n' '[1/300 2.000] Building CXX a.o' 'FAILED: b.o' 'b.cpp:1: error: no' >"$NINJA_SAYS"
touch "$NINJA_SAYS.fails"
status=0
build >"$scratch/said" || status=$?
expect "a failed build" $'building sprekk …\nFAILED: b.o\nb.cpp:1: error: no' "$(grep -v '^tools/build:' "$scratch/said")"
expect "its exit code" 1 "$status"

echo "$failures failed"
[ "$failures" -eq 0 ]
