#!/bin/bash
# All C++ files look as clang-format leaves them. Usage: format.sh <repository root> [--fix]
# Versions of clang-format differ; the one of Debian 12 decides.
set -euo pipefail
root=${1:?usage: format.sh <repository root> [--fix]}
version=14

formatter=$(command -v "clang-format-$version" || command -v clang-format || true)
if [[ -z $formatter ]] || ! "$formatter" --version | grep -q "version $version\."; then
  echo "skipped: clang-format $version is not installed (Debian: apt-get install clang-format)"
  exit 77
fi
cd "$root"
options=(--dry-run -Werror --ferror-limit=3)
[[ ${2:-} == --fix ]] && options=(-i)
if ! find include source tests -name '*.h' -print0 -o -name '*.cc' -print0 | xargs -0 "$formatter" "${options[@]}"; then
  echo "Format the files with: tests/conventions/format.sh . --fix"
  exit 1
fi
