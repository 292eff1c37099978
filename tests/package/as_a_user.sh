#!/bin/bash
# Run by clean_debian.sh within the empty Debian, as a user without rights: the commands of
# the user guide with the installed `kedge`.
set -euo pipefail
said() { # said WORDS COMMAND..: runs it, shows its last line; fails if WORDS are not in it
  local words=$1 start=$(date +%s.%N) output
  shift
  output=$("$@" 2>&1) || { echo "FAILED: $*"; echo "$output" | tail -20; exit 1; }
  grep -q -- "$words" <<<"$output" ||
    { echo "FAILED: $*: does not say '$words'"; echo "$output" | tail -20; exit 1; }
  printf '%5.1f s  %s\n' "$(echo "$(date +%s.%N) $start" | awk '{print $1 - $2}')" "$*"
  # warnings of MPI and Python about the system are noise that a user should not see
  if grep -q -i -E "warning|mmap|no such file|not found" <<<"$output"; then
    echo "FAILED: $*: it warns"; echo "$output" | head -20; exit 1
  fi
}
cd
said "^kedge 0" kedge --version
said "mine.prm" kedge init mine footing
said "points" kedge mine.prm --validate
said "finished" kedge mine.prm --strict
said "png" kedge plot output/mine
ls output/mine/pictures
cp /usr/share/kedge/prm/quickstart.prm .
said "PASS energy drift" kedge quickstart.prm --strict
said "PASS momentum" mpirun -n 2 kedge quickstart.prm --strict -o output/two
said "last(history.strain_energy)" kedge sweep quickstart.prm -s "Constants/v = 2, 4" \
  -s "Time/End = 0.1" -q "last(history.strain_energy)"
said "kedge" python3 -c "import kedge; print(kedge.__name__, kedge.__version__)"
