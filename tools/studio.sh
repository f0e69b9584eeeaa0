#!/usr/bin/env bash
# Builds the studio: the kernel as WebAssembly (build/web/bin/pintle.wasm) and the pages around it (build/studio), a static folder
# that works from any web server.
#   tools/studio.sh kernel     the module only
#   tools/studio.sh pages      the pages, around a module that is built
#   tools/studio.sh test       types, and the tests in Node; PINTLE_ANSWERS is the native program that the module is compared with
#   tools/studio.sh browser    the built pages in chromium; PINTLE is the native program whose numbers they must show
#   tools/studio.sh            kernel and pages
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

fail() {
  echo "studio: $*" >&2
  exit 1
}

kernel() {
  command -v emcmake >/dev/null || fail "emscripten is missing (tools/setup.sh web)"
  # Debian's emscripten links with a parser of Node's packages, and looks for it elsewhere. EM_CACHE stays unset: the libraries
  # that it comes with are where it looks.
  export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
  emcmake cmake -G Ninja -S . -B build/web -DCMAKE_BUILD_TYPE=Release >/dev/null
  cmake --build build/web -j "$jobs"
  mkdir -p studio/public/kernel
  cmp -s build/web/bin/pintle.wasm studio/public/kernel/pintle.wasm || cp build/web/bin/pintle.wasm studio/public/kernel/
  echo "studio: kernel of $(stat -c %s build/web/bin/pintle.wasm) bytes, $(gzip -9 -c build/web/bin/pintle.wasm | wc -c) as gzip"
}

packages() {
  command -v npm >/dev/null || fail "npm is missing (tools/setup.sh web)"
  [ studio/node_modules/.package-lock.json -nt studio/package-lock.json ] && return
  # Registries that mirror only a part of the world lack packages for other systems, which npm ci insists on.
  (cd studio && npm ci --no-audit --no-fund) || {
    echo "studio: npm ci failed; trying npm install without the lock file"
    (cd studio && npm install --no-package-lock --no-audit --no-fund)
  }
}

pages() {
  [ -f studio/public/kernel/pintle.wasm ] || fail "the kernel is not built (tools/studio.sh kernel)"
  packages
  (cd studio && npm run --silent build)
  echo "studio: build/studio is $(find build/studio -type f -name '*.br' -exec cat {} + | wc -c) bytes compressed"
}

run_tests() {
  packages
  (cd studio && npm run --silent types && npm run --silent test)
}

run_in_browser() {
  command -v chromium >/dev/null || fail "chromium is missing (tools/setup.sh web)"
  packages
  (cd studio && npm run --silent e2e)
}

case "${1:-all}" in
  kernel) kernel ;;
  pages) pages ;;
  test) run_tests ;;
  browser) run_in_browser ;;
  all) kernel && pages ;;
  *) sed -n '2,8s/^# //p' "$0"; exit 2 ;;
esac
