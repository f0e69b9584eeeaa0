#!/usr/bin/env bash
# Compiles what the studio has of the library with emscripten, to keep the way to the browser open. Only the syntax and the types
# are checked, which takes a fraction of the time of the real build (tools/studio.sh kernel); nothing is linked or run.
#   tools/web_check.sh [WORK_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-build/web}
command -v em++ >/dev/null || { echo "web_check: em++ is missing (tools/setup.sh web)" >&2; exit 1; }

# Only the header-only libraries are shown to em++, not the rest of the host's headers.
mkdir -p "$out/include"
for library in eigen3/Eigen fmt nlohmann toml++; do
  ln -sfn "/usr/include/$library" "$out/include/$(basename "$library")"
done

compile() {
  if ! em++ -fsyntax-only -std=c++20 -Wall -Wextra -ffp-contract=off -fwasm-exceptions -DFMT_HEADER_ONLY=1 -DTOML_HEADER_ONLY=1 -DPINTLE_VERSION='"web"' \
    -I. -Iinclude -Isrc -isystem "$2/include" "$1"; then
    echo "web_check: $1 failed" >&2
    return 1
  fi
}
export -f compile

rooms=(base simd space model laws joints linalg system kinematics integrators mobility dynamics start bearings run check studies live results io)
sources=$( (find "${rooms[@]/#/src/}" -name '*.cpp'; find studio/kernel -maxdepth 1 -name '*.cpp') | grep -v '_tests\?\.cpp$' | sort)
xargs -P "$(nproc)" -I{} bash -c "compile {} $out" <<<"$sources"
echo "web_check: $(wc -l <<<"$sources") sources of the studio's kernel compile with emscripten"
