#!/bin/bash
# Rules that a program can check on the sources.
# usage: lint_test.sh shell|format|layers|words
#        lint_test.sh coroutines BUILD_DIR    (the one that has compile_commands.json)
# shellcheck source=tests/service/common.sh
source "$(dirname "$0")/common.sh"
cd "$source_dir"

# The project's own files whose name matches a pattern of grep -E. Also from an archive without git.
files() {
    { git ls-files --cached --others --exclude-standard 2>/dev/null || find . -path ./build -prune -o -type f -print; } |
        sed 's|^\./||' | grep -E "$1" | sort -u | while read -r file; do [[ ! -f $file ]] || echo "$file"; done
}

none() {
    local sentence=$1 found=$2
    [[ -z $found ]] || fail "$sentence:"$'\n'"$found"
    echo "ok: $sentence"
}

lint_shell() {
    local scripts
    mapfile -t scripts < <(files '' | while read -r file; do
        if [[ $file == *.sh ]] || head -c 20 "$file" | grep -qE '^#!.*\b(bash|sh)$'; then echo "$file"; fi
    done)
    check "shellcheck has nothing to say about ${#scripts[@]} scripts" shellcheck -x "${scripts[@]}"
}

lint_format() {
    local sources
    mapfile -t sources < <(files '\.(c|h|cpp|hpp)$')
    none "${#sources[@]} C++ files are formatted, or: clang-format -i FILE" \
        "$(clang-format --dry-run "${sources[@]}" 2>&1 | sed -n 's/:[0-9]*:[0-9]*: warning: .*//p' | sort -u)"
}

# Includes of the files in $1, but not in $3, that match $2.
includes() {
    files "$1" | grep -vE "${3:-^$}" | xargs -d '\n' --no-run-if-empty grep -nE "^ *# *include *[\"<]$2" || true
}

lint_layers() {
    none "protocols include neither bridge nor daemon" "$(includes '^protocols/' '(bridge|daemon)/')"
    none "bridge does not include daemon" "$(includes '^bridge/' 'daemon/')"
    none "nothing that ships includes tests" "$(includes '^(protocols|bridge|daemon)/' 'tests/')"
    none "Cyclone DDS is known in bridge/dds only" \
        "$(includes '^(protocols|bridge|daemon)/' '(dds/|ddsc|ddsrt|dds\.h|registers\.h|messages\.h")' '^bridge/dds/')"
    none "protocols and bridge know no sockets, logs or JSON" \
        "$(includes '^(protocols|bridge)/' '(boost/asio|spdlog|nlohmann|sys/socket\.h|termios\.h)')"
}

lint_words() {
    local words='\b(TO''DO|FIX''ME|XX''X|HA''CK)\b'
    none "no promises in comments" "$(files '\.(c|h|cpp|hpp|idl|sh|py|cmake|in|json)$|CMakeLists\.txt$|Dockerfile$' |
        xargs -d '\n' grep -nE "$words" || true)"
}

# GCC 12 destroys some temporaries twice in a full expression with co_await: name lambdas and aggregates before it.
bad_coroutines=(
    -c 'match coawaitExpr(isExpansionInFileMatching("/(bridge|daemon|tests)/"), hasDescendant(lambdaExpr()))'
    -c 'match coawaitExpr(isExpansionInFileMatching("/(bridge|daemon|tests)/"),
        hasDescendant(cxxBindTemporaryExpr(hasDescendant(initListExpr()))))'
)

lint_coroutines() {
    local build_dir=$1 sources output
    [[ -f $build_dir/compile_commands.json ]] || skip "there is no $build_dir/compile_commands.json"
    mapfile -t sources < <(files '\.cpp$' | xargs -d '\n' grep -l 'co_await')
    [[ ${#sources[@]} -gt 0 ]] || skip "no file has co_await"
    output=$(printf '%s\n' "${sources[@]}" |
        xargs -d '\n' -P 2 -n 1 clang-query-14 -p "$build_dir" "${bad_coroutines[@]}" 2>&1) || fail "clang-query: $output"
    # A file that clang cannot read would pass.
    none "clang reads ${#sources[@]} coroutine files" "$(grep -E ': (fatal )?error: ' <<<"$output" || true)"
    none "no unnamed lambda or aggregate in their co_await expressions" \
        "$(grep -A 3 -E ': note: "root" binds here' <<<"$output" || true)"
}

case ${1-} in
shell | format | layers | words) "lint_$1" ;;
coroutines) lint_coroutines "$2" ;;
*)
    sed -n '3,4s/^# //p' "$0" >&2
    exit 2
    ;;
esac
