#!/usr/bin/env bash
# Runs every fuzzer of a build for a while, from the files in tests/fuzz/<name>/. An input that breaks the program is
# left in the build folder: fix the cause, and add the file to tests/fuzz/<name>/, where the tests replay it.
#   tools/fuzz.sh BUILD_FOLDER SECONDS
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 seconds=$2
shopt -s nullglob
for fuzzer in "$build"/fuzz/*_fuzz; do
  name=$(basename "$fuzzer" _fuzz)
  mkdir -p "$build/fuzz/found-$name" "tests/fuzz/$name"
  echo "fuzz: $name for $seconds s"
  case $name in
    model_toml) models=(tests/broken mechanisms) ;;
    model_json) models=(tests/broken) ;;
    *) models=() ;;
  esac
  "$fuzzer" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=4000 -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$build/fuzz/$name-" "$build/fuzz/found-$name" "tests/fuzz/$name" "${models[@]}"
done
