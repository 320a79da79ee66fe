#!/bin/bash
# doc/parameters.md describes the parameters of this very program. Usage: manual.sh <arenite> <repository root>
set -euo pipefail
program=${1:?usage: manual.sh <arenite> <repository root>}
root=${2:?usage: manual.sh <arenite> <repository root>}
fresh=$(mktemp)
trap 'rm -f "$fresh"' EXIT

"$program" parameters --markdown >"$fresh"
if ! diff -u "$root/doc/parameters.md" "$fresh" | head -n 40; then
  echo "doc/parameters.md is not up to date. Write it anew: ./arenite parameters --markdown > doc/parameters.md"
  exit 1
fi
