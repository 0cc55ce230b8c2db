#!/bin/bash
# Entry point of the demo image: the simulated field devices and the gateway share a container, because a pseudo-terminal
# belongs to the container that opened it.
set -euo pipefail

dir=/tmp/plc-gateway-demo
rm -rf "$dir"  # of this container, if it was killed and is started again
mkdir -m 0700 "$dir"

end() {
    trap '' INT TERM
    # shellcheck disable=SC2046  # one word for each process
    kill -TERM $(jobs -rp) 2>/dev/null || true
    wait
}
trap end EXIT
trap 'exit 0' INT TERM

/usr/libexec/plc-gateway/field-line --link "$dir/line1" --device 1:pump --device 2:meter --device 3:tank &
/usr/libexec/plc-gateway/field-fp7 --link "$dir/fp7" &
/usr/libexec/plc-gateway/field-scale --link "$dir/scale" &
for _ in {1..50}; do
    [[ ! -e $dir/line1 || ! -e $dir/fp7 || ! -e $dir/scale ]] || break
    sleep 0.1
done
plc-gateway run --config /usr/share/doc/plc-gateway/examples/demo.json &
wait -n || exit $?
