#!/bin/bash
# Installs the Debian packages that are missing for a purpose; does nothing, and needs no rights, when none is missing.
# usage: scripts/install-packages.sh build|run|demo|test
set -euo pipefail

usage() {
    sed -n '2,3s/^# //p' "$0"
    exit 2
}

# The installed packages, and what they provide: NodeSource's nodejs, for one, is npm as well.
installed() {
    # shellcheck disable=SC2016  # dpkg-query's variables
    dpkg-query --show --showformat='${db:Status-Status}, ${binary:Package}, ${Provides}\n' |
        sed -n '/^installed, /{s///; s/ ([^)]*)//g; s/:[a-z0-9]*,/,/; s/, */\n/g; p}'
}

missing_of() {
    printf '%s\n' "$@" | grep -vxFf <(installed) || true
}

# Root installs by itself, others through sudo; who has neither is told the command.
as_root=()
may_install() {
    [[ $EUID -eq 0 ]] && return
    command -v sudo >/dev/null || return
    as_root=(sudo)
    # Without a terminal nobody can type a password.
    sudo --non-interactive true 2>/dev/null || [[ -t 0 ]]
}

apt() {
    # env: sudo passes on no variables of ours.
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 "$@"
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
source "$root/scripts/packages.sh"
case ${1-} in
build) wanted=("${build_packages[@]}") ;;
run) wanted=("${run_packages[@]}") ;;
demo) wanted=("${demo_packages[@]}") ;;
test) wanted=("${test_packages[@]}") ;;
*) usage ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "install-packages: this is not Debian. Wanted, by the names of Debian 12: ${wanted[*]}" >&2
    exit 1
fi
mapfile -t missing < <(missing_of "${wanted[@]}")
[[ ${#missing[@]} -gt 0 ]] || exit 0

if ! may_install; then
    echo "install-packages: neither root nor sudo. Let root run: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
apt update
apt install --yes --no-install-recommends "${missing[@]}" >/dev/null
