#!/usr/bin/env bash
# Compiles the kernel, every room up to the analyses, with emscripten, to keep the way to the browser open. Only the
# syntax and the types are checked; nothing is linked or run.
#   tools/web_check.sh [WORK_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-build/web}
command -v em++ >/dev/null || { echo "web_check: em++ is missing (tools/setup.sh web)" >&2; exit 1; }

# Only the header-only libraries are shown to em++, not the rest of the host's headers.
mkdir -p "$out/include"
for library in eigen3/Eigen fmt; do
  ln -sfn "/usr/include/$library" "$out/include/$(basename "$library")"
done

compile() {
  if ! em++ -fsyntax-only -std=c++20 -Wall -Wextra -ffp-contract=off -DFMT_HEADER_ONLY=1 -DPINTLE_VERSION='"web"' \
    -Iinclude -Isrc -isystem "$2/include" "$1"; then
    echo "web_check: $1 failed" >&2
    return 1
  fi
}
export -f compile

kernel=(base space model laws probes solve system integrators analyses)
sources=$(find "${kernel[@]/#/src/}" -name '*.cpp' ! -name '*_test.cpp' | sort)
xargs -P "$(nproc)" -I{} bash -c "compile {} $out" <<<"$sources"
echo "web_check: $(wc -l <<<"$sources") sources of the kernel compile with emscripten"
