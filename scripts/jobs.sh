#!/usr/bin/env bash
# Prints how many compilers to run at once: a compiler takes up to a gigabyte.
set -euo pipefail

jobs="$(nproc)"
memory_jobs="$(awk '/MemAvailable/ { jobs = int($2 / 1048576); print jobs < 1 ? 1 : jobs }' /proc/meminfo)"
echo "$(( memory_jobs < jobs ? memory_jobs : jobs ))"
