#!/bin/bash
# Installs the npm packages of the lock file into a folder, unless they are there already.
# usage: install.sh FOLDER
set -euo pipefail

from=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$1
installed=$folder/installed.json  # the lock file of the last installation that succeeded
cmp -s "$from/package-lock.json" "$installed" && exit 0

mkdir -p "$folder"
rm -f "$installed"
cp "$from/package.json" "$from/package-lock.json" "$folder"
# No scripts: serialport brings its binary along.
npm ci --prefix "$folder" --ignore-scripts --prefer-offline --no-audit --no-fund --no-update-notifier
cp "$from/package-lock.json" "$installed"
