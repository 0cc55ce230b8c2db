#!/bin/bash
# Runs plc-gateway with the demo: installs the missing packages, builds (release), starts simulated field devices behind a
# pseudo-terminal and the gateway with etc/demo.json, and shows live registers. Needs no hardware.
# Ctrl-C, SIGTERM or SIGHUP ends everything and leaves nothing behind. Without a terminal it runs until it is signalled.
# usage: ./run.sh
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
config=$root/etc/demo.json
gateway=$root/build/release/daemon/plc-gateway
field_line=$root/build/release/tests/field/field-line
field_fp7=$root/build/release/tests/field/field-fp7
field_scale=$root/build/release/tests/field/field-scale
demo_dir=/tmp/plc-gateway-demo  # a fixed path, because etc/demo.json names the serial lines in it
log=$demo_dir/gateway.log
children=()                     # process ids; negative for a whole group, as kill takes them

fail() {
    printf 'run.sh: %s\n' "$@" >&2
    exit 1
}

# Started from a service's shell: these are that service's, not the gateway's.
unset JOURNAL_STREAM NOTIFY_SOCKET WATCHDOG_USEC

# --- one demo at a time ---

# The ports that the configuration listens on; it is JSON with comments, one member a line.
ports() {
    sed -n 's/^[^/]*"port"[[:space:]]*:[[:space:]]*\([0-9]\{1,5\}\).*/\1/p' "$config" | sort -u
}

# Listening sockets on a port that collide with 127.0.0.1, each with its process as far as we may see it.
listeners() {
    ss -Hltnp "sport = :$1" | awk '$4 ~ /^(127\.0\.0\.1|0\.0\.0\.0|\*|\[::\]|\[::ffff:127\.0\.0\.1\]):/'
}

refuse_busy_ports() {
    local port by
    for port in $(ports); do
        by=$(listeners "$port")
        [[ -n $by ]] || continue
        by=$(sed -nE 's/.*\(\("([^"]*)",pid=([0-9]+).*/\1 (process \2)/p' <<<"$by" | head -n 1)
        fail "port $port of MODBUS TCP is in use by ${by:-a process of another user}." \
            "End that process, or give the demo another port in $config."
    done
}

# Children inherit the lock, so it is free only when nothing of a demo runs any more, however that demo ended.
claim_demo_dir() {
    umask 077
    if ! mkdir "$demo_dir" 2>/dev/null; then
        [[ -d $demo_dir && ! -L $demo_dir && -O $demo_dir ]] ||
            fail "$demo_dir is not ours. The demo needs that path: let its owner ($(stat -c %U "$demo_dir")) remove it."
    fi
    exec {lock}<>"$demo_dir/lock"
    flock --nonblock "$lock" ||
        fail "the demo is already running, as process $(<"$demo_dir/lock"). End it with: kill $(<"$demo_dir/lock")"
    trap end EXIT
    trap 'exit 0' INT TERM HUP
    chmod 0700 "$demo_dir"
    find "$demo_dir" -mindepth 1 ! -name lock -delete  # what a killed demo left
    echo $$ >"$demo_dir/lock"
}

end() {
    local status=$?
    trap '' INT TERM HUP
    [[ ${#children[@]} -eq 0 ]] || kill -TERM -- "${children[@]}" 2>/dev/null || true
    for _ in {1..50}; do
        [[ -n $(jobs -rp) ]] || break
        sleep 0.1
    done
    [[ -z $(jobs -rp) ]] || kill -KILL -- "${children[@]}" 2>/dev/null || true
    rm -rf "$demo_dir"
    exit "$status"
}

# --- build, start, show ---

build() {
    # ccache: let other folders, and the container that docker/Dockerfile builds in, share what was compiled.
    export CCACHE_BASEDIR=$root CCACHE_COMPILERCHECK=content CCACHE_SLOPPINESS=locale
    echo "Building plc-gateway (release) ..."
    set -m  # a group of its own, so that a signal to this script can end compilers and all
    (cd "$root" && cmake --preset release >/dev/null && cmake --build --preset release) </dev/null &
    set +m
    children=(-$!)
    wait $! || fail "the build failed."
    children=()
}

# Starts a program that also ends when this script is killed by SIGKILL; its id is then in $!.
start() {
    setpriv --pdeathsig TERM -- "$@" </dev/null &
    children+=($!)
}

wait_until() {
    local tries=$1
    shift
    until "$@"; do
        ((tries-- > 0)) || return 1
        sleep 0.1
    done
}

answering_or_gone() {
    local port
    kill -0 "$gateway_pid" 2>/dev/null || return 0
    for port in $(ports); do
        [[ -n $(listeners "$port") ]] || return 1
    done
}

field_is_there() { [[ -e $demo_dir/line1 && -e $demo_dir/fp7 && -e $demo_dir/scale ]]; }

start_demo() {
    start "$field_line" --link "$demo_dir/line1" --device 1:pump --device 2:meter --device 3:tank >"$demo_dir/field.log" 2>&1
    field_pid=$!
    start "$field_fp7" --link "$demo_dir/fp7" >>"$demo_dir/field.log" 2>&1
    fp7_pid=$!
    start "$field_scale" --link "$demo_dir/scale" >>"$demo_dir/field.log" 2>&1
    scale_pid=$!
    wait_until 50 field_is_there || fail "the simulated field devices did not start:" "$(<"$demo_dir/field.log")"
    start "$gateway" run --config "$config" >"$log" 2>&1
    gateway_pid=$!
    wait_until 100 answering_or_gone || echo "run.sh: the gateway does not listen yet, see $log" >&2
}

# Called with the status of a child that ended although nobody asked it to.
explain_end() {
    if [[ $1 == "$gateway_pid" ]]; then
        echo "run.sh: the gateway ended with status $2. The end of its log:" >&2
        tail -n 20 "$log" >&2
        refuse_busy_ports
    else
        echo "run.sh: the simulated field devices ended with status $2:" >&2
        tail -n 20 "$demo_dir/field.log" >&2
    fi
    exit 1
}

hints() {
    local port watch check
    port=$(ports | head -n 1)
    printf -v watch '%q watch --config %q' "$gateway" "$config"
    printf -v check '%q check %q' "$gateway" "$config"
    cat <<END

plc-gateway is running: it polls three simulated devices on the serial line $demo_dir/line1 by MODBUS RTU
and a simulated FP7 on $demo_dir/fp7 by MEWTOCOL-COM, hears a scale, and answers MODBUS TCP on 127.0.0.1:$(ports | paste -sd,) (unit 1) and DDS on loopback. Its log: $log

Four things to try, from another terminal:
  1. Read its registers by MODBUS TCP (Debian package mbpoll):
     pump 101-103, meter 111-118, tank 121, scale 131-133, the FP7's press 151-156
       mbpoll -m tcp -p $port -a 1 -t 4 -r 101 -c 56 127.0.0.1
  2. Let the press make 45 strokes a minute, then let it stand:
       mbpoll -m tcp -p $port -a 1 -t 4 -r 12 127.0.0.1 45
       mbpoll -m tcp -p $port -a 1 -t 4 -r 12 127.0.0.1 0
  3. Watch them by DDS:
       $watch
  4. Edit what it does in $config,
     let it look for mistakes, and start ./run.sh again:
       $check

Ctrl-C ends everything.
END
}

run() {
    local ended status watch_pid=
    if [[ -t 1 ]]; then
        echo
        start "$gateway" watch --config "$config"
        watch_pid=$!
    fi
    while true; do
        status=0
        wait -n -p ended "$gateway_pid" "$field_pid" "$fp7_pid" "$scale_pid" $watch_pid || status=$?
        [[ $ended == "$watch_pid" ]] || explain_end "$ended" "$status"
        echo "run.sh: the live view ended with status $status; the gateway still runs." >&2
        watch_pid=
    done
}

case ${1-} in
'') ;;
-h | --help)
    sed -n '2,5s/^# //p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
*)
    sed -n '5s/^# //p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac

! command -v ss >/dev/null || refuse_busy_ports  # before a build of minutes
claim_demo_dir
"$root/scripts/install-packages.sh" build
build
refuse_busy_ports
start_demo
hints
run
