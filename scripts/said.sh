# To read with `.`: said WHAT COMMAND... runs the command. Without a terminal its output is kept for the case that it fails, and
# every `said_every_s` seconds a line is said: for how long it has run, and the last that it said itself.
said_every_s=10

said() {
  local what=$1 log child status=0 begun=$SECONDS next=$said_every_s
  shift
  if [ -t 1 ]; then
    "$@"
    return
  fi
  echo "$what"
  log=$(mktemp)
  "$@" >"$log" 2>&1 &
  child=$!
  # shellcheck disable=SC2064
  trap "kill $child 2>/dev/null || true" EXIT
  while sleep 0.2; kill -0 "$child" 2>/dev/null; do
    if [ $((SECONDS - begun)) -lt "$next" ]; then continue; fi
    echo "$what: $((SECONDS - begun)) s  $(tail -n 1 "$log" | cut -c 1-90)"
    next=$((SECONDS - begun + said_every_s))
  done
  trap - EXIT
  wait "$child" || status=$?
  if [ "$status" -ne 0 ]; then tail -n 50 "$log" >&2; fi
  rm -f "$log"
  return "$status"
}
