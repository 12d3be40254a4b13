# Sourced by the tests of this folder: "source lib.sh BUILD_FOLDER CMAKE COMPILER BUILD_TYPE SANITIZERS".
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)"
build="$1" cmake="$2" compiler="$3" type="$4" sanitizers="${5:-}"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
unset CMAKE_PREFIX_PATH acs_DIR acs_ROOT
flags=""
if [ -n "$sanitizers" ]; then
    flags="-fsanitize=$sanitizers"
fi

fail()
{
    cat "$work/log"
    echo "FAILED: $*"
    exit 1
}

# install_build: installs the build to $work/prefix.
install_build()
{
    "$cmake" --install "$build" --prefix "$work/prefix" >"$work/log" 2>&1 || fail "cmake --install"
}

# configure_project SOURCE BUILD OPTION...: configures a foreign project that finds the installed build.
configure_project()
{
    local source="$1" folder="$2"
    shift 2
    "$cmake" -G Ninja -S "$source" -B "$folder" "-DCMAKE_PREFIX_PATH=$work/prefix" "-DCMAKE_CXX_COMPILER=$compiler" \
        "-DCMAKE_BUILD_TYPE=$type" "-DCMAKE_CXX_FLAGS=$flags" "$@" >"$work/log" 2>&1
}
