#!/bin/bash
# Boots a real systemd on a throw-away overlay of this machine's own root, with processes, mounts, network and cgroups of
# its own; runs SCRIPT in it as root, prints its output and returns its exit status. Nothing outlives the run.
# Exit status 77: this machine cannot do that, and the last line says why.
# usage: systemd_boot.sh SCRIPT DIR    SCRIPT runs in it as root, and sees DIR as /e2e, read-only
set -euo pipefail

time_limit=${E2E_TIMEOUT:-120}  # seconds

cannot() {
    echo "no real systemd can be booted here: $1"
    exit 77
}

probe() {
    [[ $EUID -eq 0 ]] || cannot "that takes root"
    command -v systemd-nspawn >/dev/null || cannot "systemd-nspawn is missing (Debian package systemd-container)"
    ! mountpoint -q /usr || cannot "/usr is a file system of its own"
    unshare --mount --propagation private bash -euc '
        mount -t tmpfs tmpfs /run
        mkdir /run/{up,work,root,cg}
        mount -t overlay overlay -o lowerdir=/,upperdir=/run/up,workdir=/run/work /run/root
        mount -t cgroup2 cgroup2 /run/cg' >/dev/null 2>&1 || cannot "overlay or cgroup2 cannot be mounted"
}

# Runs in a mount namespace of its own. Arguments: script, DIR, folder for the output.
boot() {
    # A pure cgroup v2 view, and a subtree of our own, so that several runs go side by side.
    umount -R /sys/fs/cgroup
    mount -t cgroup2 cgroup2 /sys/fs/cgroup
    mkdir "/sys/fs/cgroup/e2e.$$"
    echo $$ >"/sys/fs/cgroup/e2e.$$/cgroup.procs"

    mount -t tmpfs tmpfs /run
    mkdir /run/ov
    mount -t tmpfs tmpfs /run/ov
    mkdir /run/ov/{up,work,root}
    local root=/run/ov/root
    mount -t overlay overlay -o lowerdir=/,upperdir=/run/ov/up,workdir=/run/ov/work "$root"
    # Nothing of the machine's own services; and a machine id of its own.
    rm -f "$root"/usr/sbin/policy-rc.d "$root"/etc/systemd/system/{multi-user,timers,sockets,network-online}.target.wants/*
    : >"$root/etc/machine-id"
    cp "$1" "$root/e2e-script"
    # systemd ends with the exit status of the script.
    echo 'bash /e2e-script; systemctl exit $?' >"$root/e2e-run"
    cat >"$root/etc/systemd/system/e2e.service" <<END
[Unit]
Requires=multi-user.target
After=multi-user.target
[Service]
Type=oneshot
ExecStart=/bin/bash /e2e-run
TimeoutStartSec=$time_limit
FailureAction=exit
StandardOutput=append:/out/log
StandardError=append:/out/log
END
    # All capabilities and the bpf call: without them DevicePolicy= is accepted but not enforced.
    exec timeout --foreground $((time_limit + 20)) systemd-nspawn --quiet --register=no --keep-unit --link-journal=no \
        --machine="e2e$$" --private-network --console=pipe --capability=all --system-call-filter="bpf add_key keyctl" \
        --bind-ro="$2:/e2e" --bind="$3:/out" --directory="$root" --boot systemd.unit=e2e.service \
        </dev/null >"$3/console" 2>&1
}

if [[ ${1-} == --inside ]]; then
    shift
    boot "$@"
fi
[[ $# -eq 2 ]] || { sed -n '5s/^# //p' "$0" >&2; exit 2; }
probe
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cp -a "$2" "$out/e2e"  # a path without colons, which --bind would take for its own
status=0
unshare --mount --propagation private bash "$(realpath "$0")" --inside "$(realpath "$1")" "$out/e2e" "$out" || status=$?
if [[ -s $out/log ]]; then
    cat "$out/log"
else
    cat "$out/console"
    [[ $status -ne 0 ]] || status=1
fi
find /sys/fs/cgroup -depth -type d -path '*/e2e.*' -exec rmdir {} + 2>/dev/null || true
exit "$status"
