# shellcheck shell=bash disable=SC2034  # sourced
# The Debian 12 packages that the project uses, by purpose. scripts/install-packages.sh installs them.

# To build the gateway and the simulated field devices.
build_packages=(
    g++ cmake ninja-build pkg-config ccache lld
    libboost1.81-dev nlohmann-json3-dev libspdlog-dev libfmt-dev libcli11-dev libsystemd-dev
    cyclonedds-dev cyclonedds-tools
    libmodbus-dev               # the simulated field devices speak through it
    iproute2                    # ss, by which ./run.sh says who holds a port
)

# To run an installed gateway: the shared libraries of its binary. tests/service/install_test.sh keeps this list true.
run_packages=(libddsc0debian libfmt9 libspdlog1.10 libsystemd0)

# To run the simulated field devices of the demo as well.
demo_packages=("${run_packages[@]}" libmodbus5)

# To test: everything for building, and
test_packages=(
    "${build_packages[@]}"
    doctest-dev clang-format clang-tools-14 shellcheck mandoc git
    mbpoll python3-pymodbus python3-serial-asyncio python3-jsonschema socat procps   # other people's software at the other end of every wire
    nodejs npm                                                # jsmodbus and modbus-serial, which npm installs
    libfastrtps-dev fastddsgen tshark                         # a foreign DDS, and what reads the traffic
    systemd systemd-container dbus                            # a service under a real systemd
    podman buildah crun mmdebstrap docker-compose             # the Dockerfile without a Docker engine
)
