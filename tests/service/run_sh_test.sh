#!/bin/bash
# Runs ./run.sh as a person would, without a terminal and on one, and looks at what it leaves behind.
# shellcheck source=tests/service/common.sh
source "$(dirname "$0")/common.sh"

demo_dir=/tmp/plc-gateway-demo
work=$(mktemp -d)
output=$work/output
demo=       # process id of the running demo, and of its session

cleanup() {
    [[ -z $demo ]] || pkill -KILL --session "$demo" || true
    rm -rf "$work"
}
trap cleanup EXIT

# start COMMAND...: in a session of its own, from another folder, with Ctrl-C enabled as on a terminal.
start() {
    : >"$output"
    (cd / && exec setsid env --default-signal=INT "$@") <"${input:-/dev/null}" >"$output" 2>&1 &
    demo=$!
}

printed() { grep -q "$1" "$output"; }
up_or_gone() { printed 'Ctrl-C ends everything' || ! kill -0 "$demo" 2>/dev/null; }

comes_up() {
    # What has to be compiled is in the compiler's cache, usually.
    within 500 up_or_gone
    printed 'Ctrl-C ends everything' || { cat "$output"; return 1; }
}

# Those of the pump's temperature, the meter's volts, the tank's level, the scale's state, the press's strokes (high word)
# and its oil are never 0.
reads_registers() {
    mbpoll -m tcp -p 1502 -a 1 -t 4 -r 101 -c 56 -1 127.0.0.1 >"$work/mbpoll" || { cat "$work/mbpoll"; return 1; }
    [[ $(grep -cE '^\[(103|111|121|133|152|156)\]:[[:space:]]+[1-9]' "$work/mbpoll") -eq 6 ]]
}

# writes TABLE REFERENCE VALUE: mbpoll's.
writes() { mbpoll -m tcp -p 1502 -a 1 -t "$1" -r "$2" 127.0.0.1 "$3" >"$work/mbpoll" || { cat "$work/mbpoll"; return 1; }; }
press_state() { mbpoll -m tcp -p 1502 -a 1 -t 0 -r 21 -c 3 -1 127.0.0.1 | sed -nE 's/^\[[0-9]+\]:[[:space:]]+//p' | paste -sd,; }
press_is() { [[ $(press_state) == "$1" ]]; }

watches() {
    "$gateway" watch --config "$source_dir/etc/demo.json" --count 20 --timeout 20 >"$work/watch" || return 1
    head -n 5 "$work/watch"
    [[ $(wc -l <"$work/watch") -ge 3 ]]
}

second_one_refuses() {
    local status=0
    "$source_dir/run.sh" >"$work/second" 2>&1 || status=$?
    cat "$work/second"
    [[ $status -eq 1 ]] && grep -q 'port 1502 .* in use by plc-gateway (process' "$work/second"
}

# ends_with STATUS...: in time, with one of them.
ends_with() {
    local status=0
    timeout 10 tail --pid "$demo" -f /dev/null || return 1
    wait "$demo" || status=$?
    [[ " $* " == *" $status "* ]] || { echo "exit status $status"; cat "$output"; return 1; }
}

# A zombie waits for a parent that does not care; it is not ours any more.
processes_left() {
    local all
    all=$(ps -eo pid=,sess=,stat=,args=)  # before awk, which would find itself
    awk -v session="$demo" -v path="$release_dir/" '$3 !~ /^Z/ && ($2 == session || index($0, path))' <<<"$all"
}
no_process_left() { [[ -z $(processes_left) ]]; }
shows_cursor() { grep -o '\[?25[hl]' "$output" | tail -n 1 | grep -q h; }
shows_live_registers() { [[ $(wc -l <"$output") -gt $((lines + 3)) ]]; }

leaves_nothing() {
    if no_process_left && [[ ! -e $demo_dir ]]; then return; fi
    processes_left
    ls -la "$demo_dir"
    return 1
}

# --- without a terminal ---
start "$source_dir/run.sh"
check "it comes up" comes_up
check "mbpoll reads what the three devices, the FP7 and the scale measure" within 10 reads_registers
check "the press of the FP7 runs" within 5 press_is 1,0,0
writes 4 12 61
check "a setpoint of 61 strokes a minute is its fault" within 5 press_is 0,0,1
writes 4 12 60
writes 0 12 1
writes 0 12 0
check "it stops above when its start is taken away" within 5 press_is 0,1,0
check "plc-gateway watch gets samples" watches
check "a second one says who has the port" second_one_refuses
check "the first one goes on" reads_registers
grep -E '^\[(101|102|103|111|121)\]' "$work/mbpoll"
kill -TERM "$demo"
check "SIGTERM ends it with status 0" ends_with 0
check "it leaves nothing" leaves_nothing

start "$source_dir/run.sh"
check "it comes up again" comes_up
kill -INT -- "-$demo"
check "SIGINT to the group ends it" ends_with 0 130
check "it leaves nothing" leaves_nothing

# --- what goes wrong ---
start "$source_dir/run.sh"
check "it comes up again" comes_up
pkill -KILL --session "$demo" -x plc-gateway
check "it ends with 1 when the gateway dies" ends_with 1
check "it says so" printed 'the gateway ended with status'
check "it leaves nothing" leaves_nothing

start "$source_dir/run.sh"
check "it comes up again" comes_up
kill -KILL "$demo"
check "even SIGKILL ends it" ends_with 137
check "the children of a killed run.sh end" within 5 no_process_left
start "$source_dir/run.sh"
check "a folder that was left is no obstacle" comes_up
kill -HUP -- "-$demo"
check "SIGHUP ends it" ends_with 0
check "it leaves nothing" leaves_nothing

# --- on a terminal, with a typed Ctrl-C ---
mkfifo "$work/keyboard"
input=$work/keyboard
exec {keyboard}<>"$work/keyboard"
start script --quiet --return --command "'$source_dir/run.sh'" /dev/null
check "it comes up on a terminal" comes_up
lines=$(wc -l <"$output")
check "it shows live registers" within 15 shows_live_registers
tail -n +"$((lines + 1))" "$output" | head -n 5
printf '\003' >&"$keyboard"
check "Ctrl-C ends it" ends_with 0 130
check "the cursor is visible again" shows_cursor
check "it leaves nothing" leaves_nothing

# --- from a path with a space, as a new clone ---
clone="$work/a new clone"
mkdir "$clone"
tar -C "$source_dir" --exclude=./build --exclude=./.git --exclude=./node_modules -cf - . | tar -C "$clone" -xf -
start "$clone/run.sh"
check "it builds and comes up from a path with spaces" comes_up
check "mbpoll reads what the devices of all lines measure" within 10 reads_registers
kill -TERM "$demo"
check "SIGTERM ends it with status 0" ends_with 0
check "it leaves nothing" leaves_nothing
