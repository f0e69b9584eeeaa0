#!/usr/bin/env bash
# Installs what Pintle needs from the distribution (Debian 12 or later, Ubuntu 24.04 or later), and only what is missing.
#   tools/setup.sh [--dry-run] [GROUP...]      groups: build (default), test, bench, web
set -euo pipefail

dry_run=no
groups=()

usage() { sed -n '2,3s/^# //p' "$0"; }

fail() {
  echo "setup: $*" >&2
  exit 1
}

packages_of() {
  case "$1" in
    build) echo g++ cmake ninja-build pkg-config libeigen3-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libfmt-dev libgtest-dev \
      libsundials-dev libsuitesparse-dev libhdf5-dev libcpp-httplib-dev librsvg2-dev ;;
    test) echo clang-14 libclang-rt-14-dev python3 libopenmpi-dev openmpi-bin ffmpeg ;;
    bench) echo libbenchmark-dev libsimbody-dev libmujoco-dev valgrind ;;
    web) echo emscripten node-acorn chromium "$(command -v node >/dev/null || echo nodejs)" "$(command -v npm >/dev/null || echo npm)" ;;
    *) fail "unknown group '$1' (build, test, bench, web)" ;;
  esac
}

is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing_of() {
  local package
  for package in "$@"; do
    is_installed "$package" || echo "$package"
  done
}

# Sets `as_root` to the command prefix that gives root's rights.
find_root() {
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "these packages are missing and need root or sudo to install: $*"
    as_root=(sudo)
  fi
}

is_offered() {
  [[ "$(LC_ALL=C apt-cache policy "$1" 2>/dev/null)" =~ Candidate:\ [^\(] ]]
}

# Package lists are renewed only when one of the packages is unknown to them.
refresh_lists() {
  local package
  for package in "$@"; do
    if ! is_offered "$package"; then
      echo "setup: the package lists do not know $package; running apt-get update"
      "${as_root[@]}" apt-get update -q || fail "apt-get update failed: is there a network connection?"
      return
    fi
  done
}

# What the distribution offers of the packages named. Some put the sanitizer runtime into another package; the peers of the
# benchmarks may be absent, which go without them then.
offered_of() {
  local package
  for package in "$@"; do
    if is_offered "$package"; then
      echo "$package"
    elif [[ ! " libclang-rt-14-dev libsimbody-dev libmujoco-dev " =~ " $package " ]]; then
      fail "this distribution has no package $package; Pintle is built on Debian 12 or Ubuntu 24.04 and later"
    fi
  done
}

install() {
  local packages
  find_root "$@"
  # Ten minutes' patience with another installation, such as the machine's own upgrades just after it was started.
  local command=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -o DPkg::Lock::Timeout=600 install -q -y --no-install-recommends)
  if [ "$dry_run" = yes ]; then
    echo "setup: would run: ${command[*]} $*"
    return
  fi
  refresh_lists "$@"
  packages=$(offered_of "$@")
  [ -n "$packages" ] || return 0
  mapfile -t packages <<<"$packages"
  echo "setup: installing ${packages[*]}"
  if ! "${command[@]}" "${packages[@]}"; then
    echo "setup: once more with fresh package lists"
    "${as_root[@]}" apt-get update -q || fail "apt-get update failed: is there a network connection?"
    "${command[@]}" "${packages[@]}" || fail "apt-get could not install: ${packages[*]}"
  fi
}

check_versions() {
  local version
  [ "$dry_run" = no ] || return 0
  version=$(cmake --version | sed -n '1s/[^0-9]*//p')
  [ "$(printf '3.25\n%s\n' "$version" | sort -V | head -n1)" = 3.25 ] || fail "cmake $version is too old: 3.25 is needed"
}

for argument in "$@"; do
  case "$argument" in
    --dry-run) dry_run=yes ;;
    -h | --help) usage; exit 0 ;;
    -*) fail "unknown option '$argument'" ;;
    *) groups+=("$argument") ;;
  esac
done
[ ${#groups[@]} -gt 0 ] || groups=(build)

wanted=()
for group in "${groups[@]}"; do
  list=$(packages_of "$group")
  read -r -a names <<<"$list"
  wanted+=("${names[@]}")
done

if ! command -v dpkg-query >/dev/null; then
  echo "setup: this is not a Debian or Ubuntu machine; please see to these yourself: ${wanted[*]}" >&2
  exit 0
fi
missing=$(missing_of "${wanted[@]}")
if [ -n "$missing" ]; then
  mapfile -t missing_packages <<<"$missing"
  install "${missing_packages[@]}"
else
  echo "setup: everything for ${groups[*]} is installed"
fi
check_versions
