#!/usr/bin/env bash
# Every gate a change has to pass: scripts/check.sh [GATE...]
#   format   clang-format would change no file
#   limits   no file is too long, no word is forbidden, no reference dangles
#   gcc      g++ without a warning, all tests
#   clang    clang++ without a warning, unit tests
#   asan     address and undefined-behaviour sanitizers, unit tests
#   tsan     thread sanitizer, the tests that start threads
#   tidy     clang-tidy on lib and apps
# Without a gate all run, in this order; a failed gate does not stop the next.
set -euo pipefail
. "$(dirname "$0")/setup.sh"

readonly ALL_GATES=(format limits gcc clang asan tsan tidy)

run_gate() {
  case $1 in
    format) scripts/format.sh --check ;;
    limits) check_limits ;;
    gcc) scripts/test.sh --strict ;;
    clang) scripts/test.sh --strict --preset clang --label unit ;;
    asan) scripts/test.sh --strict --preset asan --label unit ;;
    tsan) check_tsan ;;
    tidy) check_tidy ;;
  esac
}

# One line for each breach of a rule of STYLE that no tool checks.
breaches() {
  local file most lines key
  sources | while IFS= read -r file; do
    case $file in *.h) most=150 ;; *) most=500 ;; esac
    lines=$(wc -l <"$file")
    [ "$lines" -le "$most" ] || echo "$file: $lines lines, limit $most"
  done
  sources | xargs grep -nwE 'TODO|FIXME|XXX|NOLINT[A-Z]*' || true
  # [Key99, Sec. 1] or [Key98; Key99]: every key is in the bibliography.
  { sources && find README.md data docs -name '*.md'; } |
    xargs grep -ohE '\[[A-Z][a-z]+[0-9]{2}\b[^]]*\]' |
    grep -oE '\b[A-Z][a-z]+[0-9]{2}\b' | sort --unique |
    while IFS= read -r key; do
      grep -q "{$key,$" docs/references.bib ||
        echo "[$key] is not in docs/references.bib"
    done
}

check_limits() {
  local found
  found=$(breaches)
  if [ -n "$found" ]; then
    echo "$found"
    return 1
  fi
}

# Slow tests too: they are the ones with many points. Counters are on here, so
# that one gate builds them.
check_tsan() {
  configure tsan -DWARNINGS_AS_ERRORS=ON -DDELAUNAY_COUNTERS=ON
  cmake --build --preset tsan --target \
    parallel_insertion_test reconstruct_threads_test closing_test \
    triangulation3_test
  ctest --preset tsan --no-tests=error \
    --tests-regex 'ParallelInsertion|RunTasks|Threads|ForRanges|CountsOnly'
}

# Headers are seen through the sources that include them (.clang-tidy).
check_tidy() {
  configure clang -DWARNINGS_AS_ERRORS=ON >/dev/null
  sources | grep -E '^(lib|apps)/.*\.cpp$' |
    xargs --max-args=1 --max-procs="$(nproc)" \
      clang-tidy -p build/clang --quiet 2>&1 |
    sed -E '/^[0-9]+ (warnings?|errors?)( and [0-9]+ errors?)? generated\.$/d'
}

gates=("${@:-${ALL_GATES[@]}}")
for gate in "${gates[@]}"; do
  [[ " ${ALL_GATES[*]} " == *" $gate "* ]] ||
    die "unknown gate '$gate'; see the first lines of $0"
done
require "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${GATE_PACKAGES[@]}"

summary=
failed=0
for gate in "${gates[@]}"; do
  say "gate $gate"
  start=$SECONDS
  # Not `if run_gate`: a condition would switch off -e inside the gate.
  set +e
  (
    set -e
    run_gate "$gate"
  )
  status=$?
  set -e
  verdict=passed
  if [ $status != 0 ]; then
    verdict=FAILED
    failed=1
  fi
  summary+=$(printf '%-8s%s  %4d s' "$gate" "$verdict" $((SECONDS - start)))
  summary+=$'\n'
done
printf '%s' "$summary"
exit $failed
