#!/bin/bash
# What "cmake --install" puts where, and whether systemd, mandoc and the dynamic linker agree with it.
# shellcheck source=tests/service/common.sh
source "$(dirname "$0")/common.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unit=$work/usr/lib/systemd/system/plc-gateway.service
config=$work/etc/plc-gateway/plc-gateway.json

install_into() {
    DESTDIR=$1 cmake --install "$release_dir" --prefix "$2" >"$work.log" 2>&1 || { cat "$work.log"; return 1; }
    rm -f "$work.log"
}

has_mode() { [[ $(stat -c %a "$2") == "$1" ]]; }
hardened() { systemd-analyze security --offline=true --threshold=17 --no-pager "$1" >/dev/null; }
silent() {
    local output
    output=$("$@" 2>&1) || output+=" (exit status $?)"
    [[ -z $output ]] || { echo "$output"; return 1; }
}

check "it installs" install_into "$work" /usr
while read -r mode file; do
    check "$file, mode $mode" has_mode "$mode" "$work/$file"
done <<END
755 usr/bin/plc-gateway
644 usr/lib/systemd/system/plc-gateway.service
644 usr/lib/sysusers.d/plc-gateway.conf
644 usr/share/plc-gateway/plc-gateway.schema.json
644 usr/share/man/man8/plc-gateway.8
644 usr/share/doc/plc-gateway/LICENSE
644 usr/share/doc/plc-gateway/README.md
644 usr/share/doc/plc-gateway/examples/demo.json
644 usr/share/doc/plc-gateway/examples/plc-gateway.json
644 etc/plc-gateway/plc-gateway.json
END
check "nothing else" test "$(find "$work" -type f | wc -l)" -eq 10

check "the installed binary runs" "$work/usr/bin/plc-gateway" --version
check "the installed configuration has no mistake" "$work/usr/bin/plc-gateway" check "$config"
check "the installed demo has no mistake" \
    "$work/usr/bin/plc-gateway" check "$work/usr/share/doc/plc-gateway/examples/demo.json"

# --- an edited configuration survives, a lost one comes back ---
echo "// edited" >>"$config"
check "it installs again" install_into "$work" /usr
check "an edited configuration is kept" grep -q edited "$config"
rm "$config"
check "it installs a third time" install_into "$work" /usr
check "a missing configuration is installed" cmp -s "$source_dir/etc/plc-gateway.json" "$config"

# --- the unit follows the prefix ---
check "the unit starts /usr/bin with /etc" grep -qx \
    'ExecStart=/usr/bin/plc-gateway run --config /etc/plc-gateway/plc-gateway.json' "$unit"
check "it installs to another prefix" install_into "$work/other" /usr/local
check "the unit of that one starts /usr/local/bin with /usr/local/etc" grep -qx \
    'ExecStart=/usr/local/bin/plc-gateway run --config /usr/local/etc/plc-gateway/plc-gateway.json' \
    "$work/other/usr/local/lib/systemd/system/plc-gateway.service"

# --- systemd ---
# systemd-analyze exits with 0 even for keys that it does not know, so any output is a mistake. It looks for the binary.
mkdir "$work/verify"
sed "s|^ExecStart=/usr/bin/plc-gateway|ExecStart=$work/usr/bin/plc-gateway|" "$unit" >"$work/verify/plc-gateway.service"
check "systemd has nothing to say about the unit" silent systemd-analyze verify --man=no "$work/verify/plc-gateway.service"
check "the unit's exposure is at most 1.7 of 10" hardened "$unit"
check "systemd-sysusers understands the user" systemd-sysusers --dry-run "$work/usr/lib/sysusers.d/plc-gateway.conf"

# --- manual page ---
check "mandoc has nothing to say about the manual page" silent mandoc -T lint -W warning "$work/usr/share/man/man8/plc-gateway.8"

# --- packages: what the binary is linked with is what scripts/packages.sh installs to run it ---
packages_of() {
    # Debian 12 has / and /usr merged; dpkg knows a library by either path.
    ldd "$1" | awk '$3 ~ "^/" {print $3}' | xargs -n 1 readlink -f | sed 's|^/usr||; s|^|*|' |
        xargs dpkg-query --search | sed 's/:.*//' | sort -u
}
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"
installed_with=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces \
    --no-enhances "${run_packages[@]}" 2>/dev/null | sed -n 's/^ *[|]*[A-Za-z]*: //p; /^[a-z]/p' | sort -u)
for package in $(packages_of "$work/usr/bin/plc-gateway"); do
    check "$package comes with the packages of 'install-packages.sh run'" grep -qx "$package" <<<"$installed_with"
done
