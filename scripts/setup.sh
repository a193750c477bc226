# What scripts/run and scripts/test share: install what is missing, build into build/, use the result. Sourced by both.
#
# Debian 12 has ROS 1 in its own archive, so there rosdep works from files alone. Ubuntu 20.04 with the official Noetic in
# /opt/ros/noetic takes the ordinary way through rosdep's online lists (not tried by us: we have no such machine).

set -eo pipefail  # not -u: ROS's own setup files use unset variables

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir=$source_dir/build
log_dir=$build_dir/log
mkdir -p "$log_dir"

# Debian's programs want Debian's python3, whatever else PATH offers first.
cmake_options=(-DCMAKE_BUILD_TYPE=Release -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3)

say()
{
  echo "block_world: $*"
}

fail()
{
  echo "block_world: $*" >&2
  exit 1
}

# Keeps the latest line of the input on the terminal's last line, and wipes it in the end.
show_latest()
{
  local width line
  width=$(($(tput cols 2>/dev/null || echo 80) - 1))
  while IFS= read -r line; do
    printf '\r\033[K%.*s' "$width" "$line"
  done
  printf '\r\033[K'
}

# quietly NAME COMMAND...: output goes to a log; a terminal shows its latest line, and a failure shows its end.
quietly()
{
  local log=$log_dir/$1.log status=0
  shift
  if [ -t 1 ]; then
    { "$@" 2>&1 </dev/null | tee "$log" | show_latest; } || status=1
  else
    "$@" >"$log" 2>&1 </dev/null || status=1
  fi
  [ "$status" = 0 ] && return
  tail -n 50 "$log" >&2
  fail "failed: $* (whole log: $log)"
}

as_root()
{
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "needs root or sudo to run: $*"
  fi
}

apt_install()
{
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

# The package lists are fetched only when what we have does not do.
install_packages()
{
  apt_install "$@" || { as_root apt-get update && apt_install "$@"; }
}

# Points rosdep at Debian's list and at our small map, both files: no network, nothing written outside build/.
use_debian_rosdep()
{
  local dir=$build_dir/rosdep
  export ROSDEP_SOURCE_PATH=$dir/lists ROSDISTRO_INDEX_URL=file://$dir/index.yaml ROS_HOME=$dir
  mkdir -p "$dir/lists"
  {
    echo "yaml file:///usr/share/python3-rosdep2/debian.yaml debian"
    echo "yaml file://$source_dir/scripts/rosdep.yaml debian"
  } >"$dir/lists/10-debian.list"
  printf '%%YAML 1.1\n---\ndistributions: {}\ntype: index\nversion: 4\n' >"$dir/index.yaml"
  rosdep update
}

# Packages that package.xml asks for and that are not installed, one a line.
missing_packages()
{
  local distro=debian
  if [ -d /opt/ros/noetic ]; then
    distro=noetic
    [ -e /etc/ros/rosdep/sources.list.d/20-default.list ] || as_root rosdep init
    [ -d "${ROS_HOME:-$HOME/.ros}/rosdep" ] || rosdep update
  else
    use_debian_rosdep
  fi >"$log_dir/rosdep.log" 2>&1
  rosdep install --from-paths "$source_dir" --ignore-src --rosdistro $distro --simulate -y 2>>"$log_dir/rosdep.log" |
    sed -n 's/.*apt-get install -y //p'
}

# What package.xml asks for, after the few tools that are needed to read it and to compile at all.
install_missing()
{
  local tool tools=()
  for tool in rosdep=python3-rosdep2 g++=g++ make=make cmake=cmake; do
    command -v "${tool%=*}" >/dev/null || tools+=("${tool#*=}")
  done
  if [ ${#tools[@]} -gt 0 ]; then
    say "installing ${tools[*]}"
    quietly install-tools install_packages "${tools[@]}"
  fi

  local packages
  packages=$(missing_packages) || fail "rosdep cannot resolve package.xml: $(cat "$log_dir/rosdep.log")"
  if [ -n "$packages" ]; then
    say "installing $(wc -w <<<"$packages") packages and what they need"
    quietly install-packages install_packages $packages
  fi
  # A bare root may lack even this, and ROS does not start without.
  getent hosts localhost >/dev/null || as_root tee -a /etc/hosts <<<"127.0.0.1 localhost" >/dev/null
}

# Other physics engines that speed_against_error measures us against. Not needed by anything else, so not in package.xml.
install_peers()
{
  local package missing=()
  for package in libbox2d-dev libchipmunk-dev libbullet-dev libode-dev "$@"; do
    dpkg -s "$package" >/dev/null 2>&1 || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  say "installing ${missing[*]}"
  quietly install-peers install_packages "${missing[@]}"
}

# build [TARGET...]
build()
{
  [ ! -f /opt/ros/noetic/setup.bash ] || source /opt/ros/noetic/setup.bash
  say "building"
  quietly configure cmake -S "$source_dir" -B "$build_dir" "${cmake_options[@]}"
  quietly build cmake --build "$build_dir" -j"$(nproc)" --target "${@:-all}"
  source "$build_dir/devel/setup.bash"
}

# A machine that cannot resolve its own name (many containers) can still talk to itself.
use_own_address()
{
  if [ -z "${ROS_IP:-}${ROS_HOSTNAME:-}" ] && ! getent hosts "$(hostname)" >/dev/null; then
    export ROS_IP=127.0.0.1
  fi
}
