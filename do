#!/usr/bin/env bash
# Installs what is missing, builds mis, and runs it: `./do compare scenes/veach.json`. Results go to stdout, all else to stderr.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")

usage() {
    cat <<'END'
./do COMMAND …     builds mis where needed and runs `mis COMMAND …`; try ./do compare scenes/veach.json
./do test …        builds and runs the tests; … goes to ctest (-R NAME, -V)
./do bench …       measures every bar of docs/performance.md; --quick, --out FILE, --benchmark_filter=REGEX, …
./do which-light   measures every figure of docs/which-light.md anew, in fifteen minutes (--quick: soon and rough, to build)
./do fuzz SECONDS  lets libFuzzer loose on each reader of files for so long (600)
./do docs          what is public as HTML, in build/docs/html
./do format        formats the sources; ./do format --check only says what it would change
./do setup GROUP…  installs packages of packages.txt and no more (build, format, ci, python, docs)
./do clean         removes all that was built
END
}

say() { printf 'do: %s\n' "$*" >&2; }
fail() { say "$*"; exit 1; }

# Installs the packages of these groups of packages.txt that are missing.
need_packages() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: CMake says what it does not find
    local group name installed wanted=() missing=()
    while read -r group name _; do
        [[ " $* " == *" $group "* ]] && wanted+=("$name")
    done < <(grep -v '^ *#' "$root/packages.txt")
    ((${#wanted[@]})) || fail "packages.txt has no such group; there are build, format, ci, python, docs"
    installed=" $(dpkg-query -W -f '${db:Status-Status}:${Package} ' "${wanted[@]}" 2>/dev/null || true)"
    for name in "${wanted[@]}"; do
        [[ $installed == *" installed:$name "* ]] || missing+=("$name")
    done
    ((${#missing[@]})) || return 0

    local as_root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || fail "these packages are missing, and there is no sudo; as root: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300)
    local install=("${apt[@]}" install -y --no-install-recommends "${missing[@]}")
    say "installing with ${as_root[*]:+${as_root[*]} }apt-get: ${missing[*]}"
    if ! apt-cache show "${missing[@]}" >/dev/null 2>&1 || ! "${install[@]}" >&2; then
        "${apt[@]}" update >&2 || fail "apt-get update failed"
        "${install[@]}" >&2 || fail "these packages could not be installed: ${missing[*]}"
    fi
}

# Shows ninja's lines on stderr: one that is rewritten on a terminal, nothing at all when there was nothing to do.
show_progress() {
    local line rewritten=
    while IFS= read -r line; do
        case $line in
            "ninja: no work to do." | "ninja: Entering directory"* | *"Re-checking globbed directories..." | "") continue ;;
        esac
        if [[ -t 2 && $line == "["+([0-9])/+([0-9])"] "* ]]; then
            printf '\r\e[K%.*s' "$((${COLUMNS:-80} - 1))" "$line" >&2
            rewritten=yes
        else
            printf '%s%s\n' "${rewritten:+$'\r\e[K'}" "$line" >&2
            rewritten=
        fi
    done
    [[ -z $rewritten ]] || printf '\r\e[K' >&2
}

# Builds a target of the Release build.
build() {
    need_packages build
    mkdir -p "$root/build"
    (
        flock 9 # of two builds at a time, one waits
        if [[ ! -f $root/build/release/build.ninja ]]; then
            say "configuring (once), then building"
            cmake -S "$root" --preset release >"$root/build/configure.log" 2>&1 || {
                cat "$root/build/configure.log" >&2
                fail "cmake failed"
            }
        fi
        shopt -s extglob
        ninja -C "$root/build/release" -j "$(nproc)" "$1" 2>&1 | show_progress
    ) 9>"$root/build/.lock" || fail "the build failed"
}

sources() {
    find "$root/mis" "$root/tests" "$root/bench" \( -name '*.h' -o -name '*.cpp' \) -print0
}

case ${1-} in
    "")
        usage >&2
        exit 2
        ;;
    -h | --help | help)
        usage
        if [[ -x $root/build/release/bin/mis ]]; then
            echo
            exec "$root/build/release/bin/mis" --help
        fi
        ;;
    test)
        build all
        exec ctest --test-dir "$root/build/release" -j "$(nproc)" --output-on-failure --no-tests=error "${@:2}"
        ;;
    bench)
        build benches
        [[ -x $root/build/release/bin/mis_bench ]] || fail "the benchmarks need Embree, oneTBB and the io packages"
        say "some minutes; all figures go to build/bench.json"
        "$root/build/release/bin/mis_bench" --out "$root/build/bench.json" "${@:2}"
        ;;
    which-light)
        command -v python3 >/dev/null || fail "which-light needs Python 3: apt-get install python3"
        build mis_program
        exec python3 "$root/docs/which_light.py" "${@:2}"
        ;;
    fuzz)
        need_packages build ci
        cmake -S "$root" --preset fuzz >&2
        (cd "$root" && cmake --build --preset fuzz >&2)
        corpus=$root/build/fuzz/corpus
        for reader in scene table report mesh; do
            mkdir -p "$corpus/$reader"
            case $reader in
                scene)
                    cp "$root"/scenes/*.json "$corpus/scene/"
                    "$root/build/fuzz/tests/fuzz/scene_seeds" "$corpus/scene"
                    ;;
                report) cp "$root"/tests/fuzz/report.json "$corpus/report/" ;;
                mesh) cp "$root"/tests/fuzz/mesh*.{obj,ply} "$root"/scenes/meshes/* "$corpus/mesh/" ;;
                table) cp "$root"/scenes/*.csv "$corpus/table/" 2>/dev/null || printf 'x,y,z,radius,r,g,b\n0,1,2,.5,1,1,1\n' >"$corpus/table/one.csv" ;;
            esac
            say "$reader reader, ${2-600} s"
            "$root/build/fuzz/tests/fuzz/${reader}_fuzz" -max_total_time="${2-600}" -timeout=60 -rss_limit_mb=4096 \
                -max_len=65536 -print_final_stats=1 -artifact_prefix="$root/build/fuzz/" "$corpus/$reader"
        done
        ;;
    format)
        need_packages format
        clang-format --version | grep -q 'version 14\.' || say "this is not clang-format 14, whose layout the sources follow"
        case ${2-} in
            "") sources | xargs -0 -r clang-format -i ;;
            --check) sources | xargs -0 -r clang-format --dry-run -Werror ;;
            *) fail "format knows --check, not $2" ;;
        esac
        ;;
    docs)
        need_packages docs
        mkdir -p "$root/build/docs"
        (cd "$root" && doxygen docs/Doxyfile >&2) || fail "the docstrings have faults"
        echo "$root/build/docs/html/index.html"
        ;;
    setup) need_packages "${@:2}" ;;
    clean) rm -rf -- "$root/build" ;;
    *)
        build mis_program
        exec "$root/build/release/bin/mis" "$@"
        ;;
esac
