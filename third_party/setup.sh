# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154
# Sourced by ./run and ./check, which set `command_name` to their own: messages, Debian packages,
# configuring. The callers stand in the repository's folder.

say() { printf '%s: %s\n' "$command_name" "$*" >&2; }
fail() { say "$*"; exit 1; }

# The packages of these kinds (second column of third_party/packages) that are not installed.
missing_packages() {
  local package kind
  while read -r package kind _; do
    [[ -n $package && $package != \#* && " $* " == *" $kind "* ]] || continue
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
      echo "$package"
  done < third_party/packages
}

install_packages() {
  command -v dpkg-query >/dev/null || {
    say "this is no Debian; expecting what third_party/packages lists to be installed"
    return
  }
  local -a missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  local by_hand="sudo apt-get install ${missing[*]}"
  if ((EUID != 0)); then
    command -v sudo >/dev/null || fail "missing packages and no sudo; as root run: $by_hand"
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  mkdir -p build
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update >build/install.log 2>&1 ||
    fail "apt-get update failed (is there a network?); see build/install.log, or run: $by_hand"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}" >>build/install.log 2>&1 ||
    fail "packages could not be installed; see build/install.log, or run: $by_hand"
}

# Configures build/PRESET unless that is done already and no ARGUMENTS are given. From then on ninja
# configures again by itself when a CMakeLists.txt changes.
configure() {
  local preset=$1 cache=build/$1/CMakeCache.txt
  shift
  # A build folder that was moved or copied here belongs to another place.
  if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache"; then
    rm -rf "build/$preset"
  fi
  [[ $# -eq 0 && -f build/$preset/build.ninja ]] && return
  mkdir -p "build/$preset"
  cmake --preset "$preset" "$@" >"build/$preset/configure.log" 2>&1
}

# Compiles again what was compiled before in no time, where ccache is installed.
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
fi
