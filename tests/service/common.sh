# shellcheck shell=bash disable=SC2034  # sourced by the tests of this folder
# What the service tests share: paths, checks, and the way to say why a test cannot run here.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
release_dir=${PLCGW_BUILD_DIR:-$source_dir/build/release}  # another build, to try something out
gateway=$release_dir/daemon/plc-gateway
cache_dir=${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/plc-gateway-test  # may be deleted at any time

# Ends the test as skipped. CTest hides a skipped test's output, so test.sh prints the reasons at its end.
skip() {
    echo "SKIPPED: $1"
    echo "$(basename "$0" .sh): $1" >>"${PLCGW_SKIP_REASONS:-/dev/null}"
    exit 77
}

fail() {
    echo "FAILED: $1"
    exit 1
}

# check SENTENCE COMMAND...: the command must succeed.
check() {
    local sentence=$1
    shift
    "$@" || fail "$sentence"
    echo "ok: $sentence"
}

# within SECONDS COMMAND...: the command must succeed in time; it is tried ten times a second.
within() {
    local tries=$(($1 * 10))
    shift
    until "$@"; do
        ((tries-- > 0)) || return 1
        sleep 0.1
    done
}
