#!/bin/bash
# usage: docker_test.sh dockerfile   lint docker/Dockerfile (dockerfilelint and dockerfile-utils from npm)
#        docker_test.sh compose      check docker/compose.yaml
#        docker_test.sh image        build the images with podman, without a Docker engine, and run them
# shellcheck source=tests/service/common.sh
source "$(dirname "$0")/common.sh"

dockerfile=$source_dir/docker/Dockerfile

lint_dockerfile() {
    local npm=$cache_dir/npm
    trap 'rm -rf "$work"' EXIT
    command -v npm >/dev/null || skip "npm is missing: docker/Dockerfile is not linted"
    if [[ ! -x $npm/node_modules/.bin/dockerfilelint ]]; then
        timeout 60 npm install --silent --no-audit --no-fund --prefix "$npm" dockerfilelint@1.8.0 dockerfile-utils@0.16.3 \
            >/dev/null 2>&1 || skip "npm cannot install dockerfilelint: docker/Dockerfile is not linted"
    fi
    # missing_tag takes stages for images, invalid_format does not know the options of HEALTHCHECK.
    printf 'rules:\n  missing_tag: off\n  invalid_format: off\n' >"$work/.dockerfilelintrc"
    check "dockerfilelint has nothing to say" "$npm/node_modules/.bin/dockerfilelint" --config "$work" "$dockerfile"
    check "dockerfile-utils has nothing to say" "$npm/node_modules/.bin/dockerfile-utils" lint "$dockerfile"
}

lint_compose() {
    trap 'rm -rf "$work"' EXIT
    command -v docker-compose >/dev/null || skip "docker-compose is missing: docker/compose.yaml is not checked"
    check "the demo's services are valid" docker-compose --file "$source_dir/docker/compose.yaml" config --quiet
    check "the services for real hardware are valid" \
        docker-compose --file "$source_dir/docker/compose.yaml" --profile hardware config --quiet
}

# --- image ---

cannot_build() { skip "the images are not built: $1"; }

# Runs a command with a pure cgroup v2 view: crun refuses hybrid ones.
cgroup2() {
    unshare --mount --propagation private bash -c \
        'umount -R /sys/fs/cgroup && mount -t cgroup2 cgroup2 /sys/fs/cgroup && exec "$@"' cgroup2 "$@"
}

# A storage of our own: the base image below is no business of the machine's other containers.
podman() { command podman --root "$cache_dir/containers" --runroot "$work/run" "$@"; }

prepare_podman() {
    [[ $EUID -eq 0 ]] || cannot_build "that takes root"
    command -v podman >/dev/null || cannot_build "podman is missing"
    cgroup2 true 2>/dev/null || cannot_build "cgroup2 cannot be mounted"
    cat >"$work/containers.conf" <<END
[containers]
cgroups = "disabled"
default_ulimits = ["nofile=4096:4096", "nproc=1000:1000"]
[engine]
cgroup_manager = "cgroupfs"
events_logger = "file"
END
    export CONTAINERS_CONF=$work/containers.conf
    mkdir -p "$cache_dir"
    exec {lock}>"$cache_dir/lock"
    flock "$lock"
    # Images stay, containers do not; podman's list of containers insists on the folders of the last run.
    rm -rf "$cache_dir/containers/libpod"
    podman info >/dev/null 2>"$work/error" || cannot_build "podman says: $(tail -n 1 "$work/error")"
}

# debian:bookworm-slim, made from packages: no image registry is asked.
make_base_image() {
    local sources
    ! podman image exists debian:bookworm-slim || return 0
    command -v mmdebstrap >/dev/null || cannot_build "mmdebstrap is missing"
    # The machine's own mirrors of Debian 12, from whichever format of source list it has.
    # shellcheck disable=SC2016  # the variables are apt's
    sources=$(apt-get indextargets --format 'deb $(SITE) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
        grep -E ' bookworm(-updates|-security)? main$')
    [[ -n $sources ]] || cannot_build "the machine has no package source of Debian 12"
    mmdebstrap --quiet --variant=minbase --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/man/*' \
        bookworm "$work/base.tar" - <<<"$sources" || cannot_build "mmdebstrap failed"
    podman import --quiet "$work/base.tar" debian:bookworm-slim >/dev/null
    rm "$work/base.tar"
}

# Every stage gets a name, so that the layers of the last run stay as cache and older ones can go.
build_images() {
    local stage compiler_cache
    # What run.sh compiled is not compiled again.
    compiler_cache=$(ccache --get-config cache_dir)
    mkdir -p "$compiler_cache"
    for stage in build demo gateway; do
        # The host's network: another one would leave a bridge and rules on this machine.
        podman build --quiet --format docker --pull=never --isolation=chroot --network host \
            --volume "$compiler_cache:/root/.cache/ccache" --target "$stage" --tag "plc-gateway-test:$stage" \
            --file "$dockerfile" "$source_dir" >"$work/build.log" 2>&1 || { tail -n 60 "$work/build.log"; return 1; }
    done
    podman image prune --force >/dev/null
}

label() { podman image inspect --format "$1" "plc-gateway-test:$2"; }
has_no_field_devices() { ! in_gateway ls /usr/libexec/plc-gateway/field-line 2>/dev/null; }
in_gateway() { podman run --rm --no-healthcheck "${sandbox[@]}" --entrypoint "$1" plc-gateway-test:gateway "${@:2}"; }
# "podman exec" does not work without a cgroup of its own.
inside() { nsenter -t "$(podman inspect "$1" --format '{{.State.Pid}}')" -m -p -u -i -r -w "${@:2}"; }
is_healthy() { inside "$1" env "${@:2}" /usr/libexec/plc-gateway/healthcheck 2>/dev/null; }
reads_registers() { mbpoll -m tcp -p 1502 -a 1 -t 4 -r 101 -c 10 -1 -o 0.5 127.0.0.1 >/dev/null 2>&1; }
stops() { podman stop --time 5 "$1" >/dev/null && [[ $(podman inspect "$1" --format '{{.State.ExitCode}}') -eq 0 ]]; }
explain() {
    podman logs demo
    podman logs gateway
    podman rm --all --force --time 0 >/dev/null
}

# Runs in a network of its own, so that port 1502 and the DDS domain are nobody else's.
run_images() {
    local sandbox=(--network host --read-only --cap-drop=all --security-opt=no-new-privileges)
    ip link set lo up
    check "the image runs" in_gateway plc-gateway --version
    check "its configuration has no mistake" in_gateway plc-gateway check /etc/plc-gateway/plc-gateway.json
    check "it does not run as root" test "$(in_gateway id -u)" -ne 0
    check "it has no field devices" has_no_field_devices
    check "nor a compiler" test -z "$(in_gateway find /usr/bin -name '*g++*')"
    check "it has a health check" test -n "$(label '{{.HealthCheck}}' gateway)"

    trap explain EXIT
    podman run --detach --name demo --tmpfs /tmp "${sandbox[@]}" --no-healthcheck plc-gateway-test:demo >/dev/null
    check "mbpoll reads ten registers of the demo" within 15 reads_registers
    check "the health check is content" is_healthy demo HEALTH_PORT=1502
    check "plc-gateway watch gets samples" \
        inside demo plc-gateway watch --domain 0 --interface lo --count 3 --timeout 20
    check "the demo stops in time, with status 0" stops demo

    # The shipped configuration, on a port for which an ordinary user needs no rights.
    sed 's/\b502\b/1502/' "$source_dir/etc/plc-gateway.json" >"$work/plc-gateway.json"
    podman run --detach --name gateway "${sandbox[@]}" --no-healthcheck \
        --volume "$work/plc-gateway.json:/etc/plc-gateway/plc-gateway.json:ro" plc-gateway-test:gateway >/dev/null
    check "the health check of the gateway finds the port" within 10 is_healthy gateway
    check "the gateway stops in time, with status 0" stops gateway
    trap - EXIT
    podman rm --all >/dev/null
}

test_image() {
    trap 'rm -rf "$work"' EXIT
    prepare_podman
    trap 'podman rm --all --force --time 0 >/dev/null; podman umount --all >/dev/null; rm -rf "$work"' EXIT
    make_base_image
    check "the images are built" build_images
    label '{{.RepoTags}} {{.Size}} bytes' gateway
    # Functions do not cross unshare: this script goes on in there.
    cgroup2 unshare --net bash "$(realpath "$0")" run "$work"
}

case ${1-} in
dockerfile | compose)
    work=$(mktemp -d)
    "lint_$1"
    ;;
image)
    work=$(mktemp -d)
    test_image
    ;;
run)  # by itself
    work=$2
    export CONTAINERS_CONF=$work/containers.conf
    run_images
    ;;
*)
    sed -n '2,4s/^# //p' "$0" >&2
    exit 2
    ;;
esac
