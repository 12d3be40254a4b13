# Sourced by the scripts beside it: where the clone is, how they talk, how they configure and build. Bash.
set -euo pipefail

ACS_ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
ACS_SCRIPT="$(basename "$0")"

# One object cache for every clone and build folder of a machine.
export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$ACS_ROOT}" CCACHE_NOHASHDIR="${CCACHE_NOHASHDIR:-1}"
export NINJA_STATUS="[%f/%t %es] "

note()
{
    printf '== %s\n' "$*" >&2
}

die()
{
    printf '%s: %s\n' "$ACS_SCRIPT" "$*" >&2
    exit 1
}

# A wrong command line: one line, exit code 2.
die_usage()
{
    printf '%s: %s (see %s --help)\n' "$ACS_SCRIPT" "$*" "$ACS_SCRIPT" >&2
    exit 2
}

# setup SET: installs the packages of that set (scripts/setup --help).
setup()
{
    "$ACS_ROOT/scripts/setup" --for "$1" || die "cannot continue without the packages above"
}

# configure PRESET [OPTION...]: runs CMake if the folder has never been configured with these options, or if the presets
# or the list of folders have changed since. A clone that was moved or copied starts again: its build folder would build
# the old place. Changes inside a CMakeLists.txt are left to Ninja, which reruns CMake by itself.
configure()
{
    local preset="$1" folder="$ACS_ROOT/build/$1" log state home
    shift
    state="$(cd "$ACS_ROOT" && { pwd -P; cat CMakePresets.json; find . -name build -prune -o -name CMakeLists.txt -print | sort; } | cksum)"
    if [ -f "$folder/build.ninja" ] && [ -f "$folder/.configured" ] && is_configured "$state" "$*" <"$folder/.configured"; then
        return
    fi
    note "configure $preset"
    home="$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt" 2>/dev/null || true)"
    if [ -n "$home" ] && [ "$home" != "$ACS_ROOT" ]; then
        rm -rf "$folder"
    fi
    mkdir -p "$folder"
    log="$folder/configure.log"
    if ! (cd "$ACS_ROOT" && cmake --preset "$preset" "$@") >"$log" 2>&1 </dev/null; then
        cat "$log" >&2
        die "CMake could not configure preset '$preset'; its message is above"
    fi
    printf '%s\n%s\n' "$state" "$*" >"$folder/.configured"
}

# is_configured STATE OPTIONS: compares with the two lines of .configured. A caller without options accepts any.
is_configured()
{
    local state options
    read -r state && read -r options
    [ "$state" = "$1" ] && { [ -z "$2" ] || [ "$options" = "$2" ]; }
}

# build PRESET [TARGET...]: prints nothing if there is nothing to do. The build's output goes to standard error.
build()
{
    local preset="$1" folder="$ACS_ROOT/build/$1" plan targets=()
    shift
    if [ $# -gt 0 ]; then
        targets=(--target "$@")
    fi
    if plan="$(ninja -C "$folder" -n "$@" 2>/dev/null)" && grep -q '^ninja: no work to do' <<<"$plan"; then
        return
    fi
    note "build $preset${*:+ ($*)}"
    cmake --build "$folder" -j "$(nproc)" "${targets[@]}" >&2 </dev/null || die "the build of preset '$preset' failed; the compiler's message is above"
}

# join SEPARATOR WORD...
join()
{
    local separator="$1" result="$2"
    shift 2
    local word
    for word in "$@"; do
        result+="$separator$word"
    done
    printf '%s' "$result"
}
