#!/bin/bash
# Boots a real systemd and runs the installed service in it: systemd_guest.sh says what it shows.
# It takes the release binary: what is installed, and AddressSanitizer cannot map its shadow memory in the unit's sandbox.
# shellcheck source=tests/service/common.sh
source "$(dirname "$0")/common.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Into the prefix /usr whatever the build was configured for: the unit must follow.
DESTDIR=$work/e2e/stage cmake --install "$release_dir" --prefix /usr >/dev/null
cp "$source_dir"/tests/service/{common,systemd_guest}.sh "$source_dir/etc/demo.json" "$work/e2e"

status=0
output=$(E2E_TIMEOUT=100 "$source_dir/tests/support/systemd_boot.sh" "$source_dir/tests/service/systemd_guest.sh" \
    "$work/e2e") || status=$?
printf '%s\n' "$output"
[[ $status -ne 77 ]] || skip "$(tail -n 1 <<<"$output")"
exit "$status"
