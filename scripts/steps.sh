# Sourced by the other scripts: installing, building, and showing how far a long step is.
# Expects $program, the name that messages begin with.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
sanitized=$root/build-sanitize
log=$build/$program.log

# What Debian 12 needs to build, run and test everything.
packages=(
    g++ cmake ninja-build pkg-config git ccache mold
    libglfw3-dev libglm-dev libopenimageio-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev
    libepoxy-dev libegl-dev libgl-dev
    libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libboost-dev libeigen3-dev libssl-dev
    libpango1.0-dev libcairo2-dev libgtest-dev libgmock-dev libxtst-dev libxrandr-dev libx11-dev libembree-dev libnlopt-cxx-dev libimgui-dev libfreetype-dev libzip-dev
    libgl1-mesa-dri libegl1 libgl1 fonts-dejavu-core fonts-wqy-microhei gnuplot-nox xvfb xauth
    man-db zsh cmark-gfm python3 tidy
)

# What the sanitized build needs besides.
clang_packages=(clang lld llvm libclang-rt-14-dev)

say() { printf '%s\n' "$*" >&2; }

fail() {
    say "$program: $*"
    exit 1
}

spell() { if [ "$1" -lt 100 ]; then echo "$1 s"; else echo "$(($1 / 60)) min $(($1 % 60)) s"; fi; }

# step LABEL COUNTER COMMAND...: runs the command with its output in the log. COUNTER is a function
# that prints "done total" from the log, by which the time left is estimated.
step() {
    local label=$1 counter=$2 start=$SECONDS last=-5
    shift 2
    mkdir -p "$build"
    : >"$log"
    "$@" >"$log" 2>&1 </dev/null &
    local job=$!
    while kill -0 $job 2>/dev/null; do
        sleep 0.5
        local elapsed=$((SECONDS - start)) finished total left="..."
        read -r finished total < <($counter) || true
        if [ "${finished:-0}" -gt 0 ] && [ "${total:-0}" -gt 0 ]; then
            left="$((100 * finished / total)) %, $(spell $((elapsed * (total - finished) / finished))) left"
        fi
        if [ -t 2 ]; then
            printf '\r\033[K%-22s %s, %s' "$label" "$(spell $elapsed)" "$left" >&2
        elif [ $((SECONDS - last)) -ge 10 ]; then
            last=$SECONDS
            say "$label: $(spell $elapsed), $left"
        fi
    done
    [ -t 2 ] && printf '\r\033[K' >&2
    if ! wait $job; then
        local reason
        reason=$(grep -m1 -E '[Ee]rror: |^E:|FAILED' "$log" || tail -n 1 "$log")
        fail "$label failed: $reason (all of it: $log)"
    fi
    say "$label: done in $(spell $((SECONDS - start)))"
}

# Each package is fetched, unpacked and set up.
count_apt() {
    awk '/newly installed/ { total = 3 * $3; seen = 1 }
         seen && /^(Get:|Unpacking|Setting up)/ { done++ }
         END { print done + 0, total + 0 }' "$log"
}

count_ninja() { grep -aoE '^\[[0-9]+/[0-9]+\]' "$log" | tail -n 1 | tr -d '[]' | tr '/' ' '; }

count_nothing() { echo "0 0"; }

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "installing packages needs root or sudo; missing: ${missing[*]}"
    fi
}

install_packages() {
    as_root apt-get update &&
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

install_missing() {
    missing=()
    local package
    for package in "${packages[@]}"; do
        [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] ||
            missing+=("$package")
    done
    [ ${#missing[@]} = 0 ] && return
    command -v apt-get >/dev/null || fail "this is not Debian; install what these packages hold: ${missing[*]}"
    [ "$(id -u)" = 0 ] || as_root true
    step "installing ${#missing[@]} packages" count_apt install_packages "${missing[@]}"
}

# Up to eight sources as one: from nothing, that saves a quarter of the time of one by one, most of which goes into reading
# headers. A build folder that was configured otherwise stays as it is (CONTRIBUTING.md).
configure() {
    step "configuring" count_nothing cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8
}

# build_targets TARGET...: configures once, then builds; nothing to do takes a second.
build_targets() {
    [ -f "$build/build.ninja" ] || configure
    step "building" count_ninja ninja -C "$build" "$@"
}

# The same by clang with sanitizers, in a folder of its own.
build_sanitized() {
    [ -f "$sanitized/build.ninja" ] ||
        step "configuring" count_nothing cmake -S "$root" --preset sanitize
    step "building (sanitizers)" count_ninja ninja -C "$sanitized" "$@"
}
