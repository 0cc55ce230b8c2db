#!/bin/bash
# Runs as root in the booted systemd of systemd_test.sh, with the installed files and the demo's configuration in /e2e.
# shellcheck source=tests/service/common.sh
source /e2e/common.sh

unit=plc-gateway
config=/etc/plc-gateway/plc-gateway.json

property() { systemctl show --property "$1" --value "${2:-$unit}"; }
main_pid() { property MainPID; }
journal() { journalctl --unit "$unit" --output cat --no-pager; }
is() { [[ $(property "$1") == "$2" ]]; }
restarted() { is NRestarts "$1" && is ActiveState active && is SubState running; }
in_status() { grep -qP "$1" "/proc/$(main_pid)/status"; }
opened_the_line() { [[ -n $(find "/proc/$(main_pid)/fd" -lname "$(readlink /dev/ttyGW0)") ]]; }
refused_to_start() { ! systemctl start "$unit" 2>/dev/null; }
answers_modbus() { mbpoll -m tcp -p 502 -a 1 -t 4 -r 101 -c 1 -1 -o 0.5 127.0.0.1 >/dev/null 2>&1; }

explain() {
    local status=$?
    [[ $status -eq 0 ]] && return
    systemctl --no-pager --full status "$unit" line || true
    journalctl --no-pager --unit "$unit" --unit probe | tail -n 60
}
trap explain EXIT

# --- install as an administrator would, with a socat pseudo-terminal as the serial line ---
cp -a /e2e/stage/. /
systemd-sysusers
sed 's|"/tmp/plc-gateway-demo/line1"|"/dev/ttyGW0"|; s|\b1502\b|502|' /e2e/demo.json >"$config"
mkdir -p "/etc/systemd/system/$unit.service.d"
cat >"/etc/systemd/system/$unit.service.d/pts.conf" <<END
[Service]
DeviceAllow=char-pts rw
END
# Shorter times than in the unit, so that the test is quick.
cat >"/etc/systemd/system/$unit.service.d/quick.conf" <<END
[Service]
WatchdogSec=2s
TimeoutAbortSec=500ms
RestartSec=100ms
END
systemctl daemon-reload
systemd-run --quiet --unit line socat \
    pty,raw,echo=0,link=/dev/ttyGW0,group=dialout,mode=660 pty,raw,echo=0,link=/run/far-end
within 5 test -e /dev/ttyGW0

# --- start ---
check "the unit can be enabled" systemctl --quiet enable "$unit"
check "it starts and says READY" systemctl start "$unit"
check "it is active" is ActiveState active
check "it tells a status" test -n "$(property StatusText)"
check "it runs as its own user" in_status "^Uid:\t$(id -u plc-gateway)\t$(id -u plc-gateway)\t"
check "it is no root" test "$(id -u plc-gateway)" -ne 0
check "it is in dialout" in_status "^Groups:.*\b$(getent group dialout | cut -d: -f3)\b"
check "it keeps one capability, port 502" in_status '^CapEff:\t0{13}400$'
check "it cannot get more" in_status '^CapBnd:\t0{13}400$'
check "it opens the serial line" within 5 opened_the_line
check "it answers on port 502" within 5 answers_modbus
check "it publishes by DDS" plc-gateway watch --config "$config" --count 1 --timeout 10

# --- devices: the same sandbox with a probe in the daemon's place ---
# Opening a serial port whose driver is absent must fail with ENXIO or ENODEV, as it would for root: not with EPERM.
mknod -m 666 /dev/ttyUSB9 c 188 9
mknod -m 666 /dev/ttyACM9 c 166 9
mknod -m 666 /dev/forbidden c 1 1  # memory
cat >/e2e-probe <<'END'
! { : <>/dev/forbidden; } 2>/tmp/error && grep -q 'not permitted' /tmp/error || { echo "/dev/forbidden: $(</tmp/error)"; exit 1; }
for port in /dev/ttyUSB9 /dev/ttyACM9; do
    { : <>$port; } 2>/tmp/error || ! grep -q 'ermi' /tmp/error || { cat /tmp/error; exit 1; }
done
! touch /etc/plc-gateway/x 2>/dev/null || { echo "/etc is writable"; exit 1; }
touch /var/lib/plc-gateway/x || exit 1
END
sed 's|^ExecStart=.*|ExecStart=/bin/bash /e2e-probe|; s|^Type=.*|Type=oneshot|; /^\(Restart\|Watchdog\|NotifyAccess\)/d' \
    "$(property FragmentPath)" >/run/systemd/system/probe.service
systemctl daemon-reload
check "USB serial ports are allowed before their driver is loaded, other devices are not" systemctl start probe

# --- it comes back ---
kill -STOP "$(main_pid)"
check "the watchdog restarts a daemon that hangs" within 10 restarted 1
check "the journal says why" grep -q 'Watchdog timeout' <<<"$(journal)"
kill -KILL "$(main_pid)"
check "a killed daemon is restarted" within 5 restarted 2
check "it answers again" within 5 answers_modbus
systemctl stop line
sleep 0.5
check "it stays when the serial port vanishes" restarted 2

# --- its log ---
journalctl --unit "$unit" --output json --no-pager _COMM=plc-gateway >/tmp/log.json
check "its lines are in the journal" test -s /tmp/log.json
check "they come by the journal's own protocol, with priorities from error to debug" \
    /usr/bin/python3 -c '
import json
lines = [json.loads(line) for line in open("/tmp/log.json")]
native = [line for line in lines if line["_TRANSPORT"] == "journal"]
priorities = {int(line["PRIORITY"]) for line in native}
print(f"   {len(native)} of {len(lines)} lines, priorities {sorted(priorities)}")
assert len(native) == len(lines) and priorities <= {3, 4, 5, 6, 7} and 6 in priorities'

# --- stop ---
start_ns=$(date +%s%N)
systemctl stop "$unit"
stopped_ms=$((($(date +%s%N) - start_ns) / 1000000))
check "it stops in under a second ($stopped_ms ms)" test "$stopped_ms" -lt 1000
check "it stops cleanly" is Result success
check "its exit status is 0" is ExecMainStatus 0

# --- a broken configuration ---
sed -i 's|"device"|"devise"|; s|\b502\b|99502|' "$config"
check "a broken configuration fails" refused_to_start
sleep 0.5
check "it is not tried again" is ActiveState failed
check "the journal has the first mistake" grep -q 'devise' <<<"$(journal)"
check "the journal has the second mistake" grep -q '99502' <<<"$(journal)"
