#!/bin/bash
# Healthy is a gateway that answers a MODBUS TCP request in time; an exception response is an answer, too.
# HEALTH_ADDRESS and HEALTH_PORT say where it listens, if not on 127.0.0.1 and the first port of the configuration.
set -euo pipefail

first_port() {
    sed -n 's/^[^/]*"port"[[:space:]]*:[[:space:]]*\([0-9]\{1,5\}\).*/\1/p' /etc/plc-gateway/plc-gateway.json | head -n 1
}

port=${HEALTH_PORT:-$(first_port)}
exec {connection}<>"/dev/tcp/${HEALTH_ADDRESS:-127.0.0.1}/${port:-502}"
# Transaction 1, unit 1, read the first holding register.
printf '\0\1\0\0\0\6\1\3\0\0\0\1' >&"$connection"
[[ $(timeout 3 head -c 8 <&"$connection" | od -An -tx1) == ' 00 01 00 00 '* ]]
