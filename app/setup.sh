# shellcheck shell=bash
# Sourced by app/run and tests/run: installs what is missing, configures, builds. Says nothing when there is nothing to do.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*" >&2; }
fail() {
    say "error: $*"
    exit 2
}

# run_logged LOG COMMAND…: keeps the output of a command aside and shows all of it when the command fails.
run_logged() {
    local log=$1
    shift
    "$@" >"$log" 2>&1 && return 0
    cat "$log" >&2
    return 1
}

# Only one run at a time may install or build in a folder; the others wait.
lock() {
    mkdir -p "$1"
    exec 9>"$1/.lock"
    flock --nonblock 9 && return 0
    say "Another run is building in $1; waiting for it."
    flock 9
}
unlock() { exec 9>&-; }

missing_packages() {
    local wanted
    wanted=$(
        grep -v '^[[:space:]]*\(#\|$\)' "$root/third_party/packages.txt"
        printf '%s\n' "$@"
    )
    # shellcheck disable=SC2086 # one word a package
    comm -23 <(sort <<<"$wanted") \
        <(dpkg-query --show --showformat='${db:Status-Abbrev} ${Package}\n' $wanted 2>/dev/null |
            sed -n 's/^.i[[:space:]]*//p' | sort -u)
}

# install_packages [PACKAGE…]: those of third_party/packages.txt, and these.
install_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "This is not a Debian system: third_party/packages.txt lists what has to be installed by hand."
        return 0
    fi
    local missing as_root=() log
    missing=$(missing_packages "$@")
    [[ -n $missing ]] || return 0
    missing=$(tr '\n' ' ' <<<"$missing")
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            fail "these packages are missing, and there is neither root nor sudo to install them: $missing"
        as_root=(sudo)
    fi
    as_root+=(env DEBIAN_FRONTEND=noninteractive)
    local apt=("${as_root[@]}" apt-get -q -y -o DPkg::Lock::Timeout=600)
    log=$(mktemp)
    say "Installing the system packages that are missing: $missing"
    if [[ -n $(dpkg --audit) ]]; then # an earlier installation was interrupted
        run_logged "$log" "${as_root[@]}" dpkg --configure -a || fail "dpkg could not finish an earlier installation"
    fi
    run_logged "$log" "${apt[@]}" update || fail "apt-get update failed (see above): is the network there?"
    # shellcheck disable=SC2086
    run_logged "$log" "${apt[@]}" install --no-install-recommends $missing ||
        fail "apt-get could not install these packages (see above): $missing"
    rm -f "$log"
}

# configure BUILD [CMake options]: only when there is no usable build folder; ninja repeats it by itself when needed.
configure() {
    local build=$1 configured_for
    shift
    if [[ -f $build/CMakeCache.txt ]]; then
        configured_for=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
        if [[ $configured_for != "$root" ]]; then # the tree was moved or copied
            find "$build" -mindepth 1 -maxdepth 1 ! -name .lock -exec rm -rf {} +
        elif [[ -f $build/build.ninja ]]; then
            return 0
        fi
    fi
    run_logged "$build/configure.log" cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" ||
        fail "CMake could not configure $build (see above)"
}

# Shows ninja's output: compiler messages in full; its progress as one line that renews itself on a terminal, and in a
# few plain lines elsewhere. (One step runs always, and has nothing to show: it looks up the commit.)
show_progress() {
    local line begun='' step=0 total percent=-100
    while IFS= read -r line; do
        if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\  ]]; then
            step=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
            ((step > 1)) || continue
            begun=yes
            if [[ -t 2 ]]; then
                printf '\r\033[KBuilding: %d of %d' "$step" "$total" >&2
            elif ((100 * step / total >= percent + 25 && total > 20)); then
                percent=$((100 * step / total))
                say "Building: $step of $total"
            fi
        elif [[ $line != "ninja: Entering directory"* && $line != "ninja: no work to do." && $line != "-- "* ]]; then
            [[ -t 2 && -n $begun ]] && printf '\r\033[K' >&2
            say "$line"
        fi
    done
    if [[ -t 2 && -n $begun ]]; then printf '\r\033[K' >&2; fi
}

# build BUILD TARGET…
build() {
    local build=$1 jobs memory status=0
    shift
    memory=$(awk '/^MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo) # GiB; the largest file needs about one
    jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
    ((jobs <= memory)) || jobs=$((memory > 1 ? memory : 1))
    NINJA_STATUS='[%f/%t] ' ninja -C "$build" -j "$jobs" "$@" 2>&1 | show_progress || status=$?
    ((status <= 128)) || fail "the build was stopped by signal $((status - 128)); the next run goes on from there"
    ((status == 0)) || fail "the build failed (see above)"
}
