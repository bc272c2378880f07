#!/usr/bin/env bash
# packages.sh [portability]: installs the Debian packages that building and testing need, or those that
# scripts/portability.sh needs besides, as far as they are missing. Asks nothing. Set ALPENGLOW_SKIP_PACKAGES=1
# where they come from elsewhere.
set -euo pipefail

packages=(
  # tools
  cmake g++ ninja-build glslang-tools spirv-tools clang-format
  # what the libraries and the program use
  libvulkan-dev libglm-dev libopenimageio-dev openimageio-tools libopenexr-dev
  nlohmann-json3-dev libcli11-dev pkg-config libcairo2-dev
  libglfw3-dev libimgui-dev
  # what the tests use: software Vulkan, its validation layers, a second loader
  python3 libgtest-dev mesa-vulkan-drivers vulkan-validationlayers libvulkan-volk-dev
  # what the viewer's tests use: a display without a monitor, and keys pressed on it
  xvfb xdotool
)
if [[ "${1:-}" == portability ]]; then
  # a second compiler, one for Windows, what runs its programs and gives them a display
  packages=(clang g++-mingw-w64-x86-64-posix wine wine64 xvfb xauth)
fi

if [[ "${ALPENGLOW_SKIP_PACKAGES:-}" == 1 ]]; then
  exit 0
fi

system=""
if [[ -r /etc/os-release ]]; then
  # shellcheck source=/dev/null
  system="$(. /etc/os-release && echo "${ID:-} ${VERSION_ID:-0}")"
fi
if [[ "$system" != "debian "* ]] || (( ${system#debian } < 12 )) || ! command -v apt-get >/dev/null; then
  printf '%s\n' "${packages[@]}"
  echo "This is not Debian 12 or later, so please install the like of the packages above yourself" \
    "and run this again with ALPENGLOW_SKIP_PACKAGES=1." >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status="$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)"
  [[ "$status" == installed ]] || missing+=("$package")
done
if (( ${#missing[@]} == 0 )); then
  exit 0
fi

as_root=()
if (( $(id -u) != 0 )); then
  if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
    printf '%s\n' "${missing[@]}"
    echo "The packages above are missing, and installing them needs root or sudo without a" \
      "password." >&2
    exit 1
  fi
  as_root=(sudo -n)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@" </dev/null
}

echo "Installing ${missing[*]}"
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
# A fresh machine knows no package at all, and an old list names files that are gone.
if ! apt install -y --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
  if ! { apt update && apt install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    cat "$log" >&2
    echo "Installing the packages ${missing[*]} failed; the lines above say why." >&2
    exit 1
  fi
fi
