#!/usr/bin/env bash
# Looks for faults that the tests do not show. Each step installs what it needs; without arguments all of them run:
#
#   scripts/check.sh format          # clang-format on every tracked source (seconds)
#   scripts/check.sh tidy [REGEX]    # clang-tidy with the checks of .clang-tidy, on sources whose path matches (src/soil/)
#   scripts/check.sh asan [ARG...]   # the unit tests under AddressSanitizer and UBSan; arguments go to ctest
#   scripts/check.sh tsan            # the programs of threaded tests under ThreadSanitizer
#
# JOBS in the environment says how many processes work side by side; without it, one for each core.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

packages() { sed -n "s/^\($1\): //p" scripts/packages.txt; }
# install HEADING...: the packages of these headings of packages.txt.
install() {
  local heading
  # shellcheck disable=SC2046
  for heading in "$@"; do scripts/install_packages.sh $(packages "$heading"); done
}

format() {
  install format
  # Versions disagree about the same settings; 14 is Debian 12's.
  local version
  version=$(clang-format --version)
  [[ $version == *"version 14."* ]] || { echo "$version: need version 14" >&2; exit 2; }
  git ls-files -z '*.h' '*.cpp' | xargs -0 clang-format --dry-run --Werror
  echo "format: all $(git ls-files '*.h' '*.cpp' | wc -l) sources are as clang-format 14 writes them"
}

tidy() {
  install build libraries serve run test ros2 survey prove tidy
  cmake --preset tidy >/dev/null
  # What is generated has to be there before it is included.
  cmake --build --preset tidy --parallel "$jobs" --target tera_messages tera_ros2_types_generate tera_commit
  local found=build/tidy/found.txt
  if ! run-clang-tidy -quiet -p build/tidy -j "$jobs" "${1:-$PWD/(src|blind)/}" >$found 2>build/tidy/stderr.txt; then
    grep -Ev '^(clang-tidy-14 .*)?$' $found
    exit 1
  fi
  echo "tidy: nothing found"
}

asan() {
  install build libraries serve run test ros2 survey prove test-ros2
  cmake --preset asan >/dev/null
  cmake --build --preset asan --parallel "$jobs" --target unit_tests
  # Debian's libfastrtps, which the tests of ROS 2 talk to, deletes readers of its own by the size of their base.
  ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1:new_delete_type_mismatch=0 \
  LSAN_OPTIONS=suppressions=$PWD/scripts/suppressions/lsan.txt:print_suppressions=0 UBSAN_OPTIONS=print_stacktrace=1 \
    ctest --test-dir build/asan -L unit --output-on-failure --parallel "$jobs" "$@"
}

# Whole programs, so that no test is missed for its name: in_parallel; the writer with its queue of frames; rays and scans; a run with
# threads, live and to its end; two simulations side by side; the search of the diagnosis. Not sessions of `tera serve`: gRPC, not compiled
# for it, hands them from thread to thread unseen.
threaded='core_test dataset_test ray_scene_test sensors_test generate_test sim_test search_test'
tsan() {
  install build libraries serve run test ros2 survey prove test-ros2
  cmake --preset tsan >/dev/null
  # shellcheck disable=SC2086
  cmake --build --preset tsan --parallel "$jobs" --target $threaded
  local name program deadlocks
  for name in $threaded; do
    program=$(find build/tsan/test -name "$name" -type f)
    echo "tsan: $name"
    # The LLVM of Mesa's renderer seems to hold more locks at once than are counted: what draws is watched for races alone.
    deadlocks=1
    [ "$name" = generate_test ] && deadlocks=0
    # A test kills a process that it forks: the child may start threads of its own.
    TSAN_OPTIONS=suppressions=$PWD/scripts/suppressions/tsan.txt:halt_on_error=1:second_deadlock_stack=1:die_after_fork=0:detect_deadlocks=$deadlocks \
      "$program" --gtest_brief=1
  done
}

if [ $# -eq 0 ]; then
  format
  tidy
  asan
  tsan
  exit
fi
step=$1
shift
usage() { sed -n '2,9s/^# \{0,1\}//p' scripts/check.sh; }
case $step in
  format | tidy | asan | tsan) "$step" "$@" ;;
  -h | --help) usage ;;
  *)
    echo "check.sh: no step is called $step" >&2
    usage >&2
    exit 2
    ;;
esac
