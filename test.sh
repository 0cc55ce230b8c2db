#!/bin/bash
# Tests plc-gateway: installs the missing packages, builds (debug, ASan and UBSan, warnings are errors), runs all of CTest.
# usage: ./test.sh [--quick] [--only REGEX]
#        ./test.sh --bench [NAME | OPTION]...
#   --quick        leave out the tests that are labelled slow
#   --only REGEX   run the tests whose name matches, and what they need
#   --bench        benchmarks of the release build instead, on emulated serial lines: tests/bench/README.md;
#                  --bench --help lists them and their options
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage() {
    sed -n '2,8s/^# //p' "${BASH_SOURCE[0]}"
}

# Everything behind --bench is the benchmarks' own.
run_benchmarks() {
    cd "$root"
    scripts/install-packages.sh test
    export CCACHE_BASEDIR=$root CCACHE_COMPILERCHECK=content CCACHE_SLOPPINESS=locale
    cmake --preset release
    cmake --build --preset release --target bench_programs
    exec /usr/bin/python3 -B tests/bench/bench.py "$@"
}

selection=()
while [[ $# -gt 0 ]]; do
    case $1 in
    -h | --help)
        usage
        exit 0
        ;;
    --quick) selection+=(--label-exclude '^slow$') ;;
    --bench)
        shift
        run_benchmarks "$@"
        ;;
    --only)
        [[ $# -ge 2 ]] || { usage >&2; exit 2; }
        selection+=(--tests-regex "$2")
        shift
        ;;
    *)
        usage >&2
        exit 2
        ;;
    esac
    shift
done

# The tests that cannot run here say why, in this file, so that it shows at the end.
PLCGW_SKIP_REASONS=$(mktemp)
export PLCGW_SKIP_REASONS
trap 'rm -f "$PLCGW_SKIP_REASONS"' EXIT

cd "$root"
scripts/install-packages.sh test
# ccache: let other folders, and the container that docker/Dockerfile builds in, share what was compiled.
export CCACHE_BASEDIR=$root CCACHE_COMPILERCHECK=content CCACHE_SLOPPINESS=locale
cmake --preset debug
cmake --build --preset debug
status=0
ctest --preset debug --parallel 2 --no-tests=error "${selection[@]}" || status=$?
[[ ! -s $PLCGW_SKIP_REASONS ]] || sed 's/^/Skipped: /' "$PLCGW_SKIP_REASONS"
exit "$status"
