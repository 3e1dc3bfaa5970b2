#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes the table of options into the README, between its two marks:
#   update-readme.sh PROGRAM README
set -eu
table=$(mktemp)
trap 'rm -f "$table"' EXIT
"$1" help options >"$table"
sed -i -e "/<!-- options -->/,/<!-- end of options -->/{
/<!-- options -->/r $table
/<!--/!d
}" "$2"
