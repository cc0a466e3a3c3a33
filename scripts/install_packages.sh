#!/usr/bin/env bash
# Installs the Debian packages given by name, those that are missing only; does nothing, and needs no
# network, when all are there. Waits up to 15 minutes for another apt that holds a lock, as unattended upgrades do.
set -euo pipefail

missing=()
for package in "$@"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

sudo=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "need root or sudo to install: ${missing[*]}" >&2; exit 2; }
  sudo=(sudo)
fi

longest_wait_s=900
pause_s=${TERA_APT_PAUSE_S:-5}
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# apt's own DPkg::Lock::Timeout waits for the lock of installing, not for those of lists and archives.
apt_get() {
  until "${sudo[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -qq "$@" >"$log" 2>&1; do
    if ! grep -qE 'Could not get lock|Unable to (acquire|lock)' "$log"; then
      tail -n 50 "$log" >&2
      exit 1
    fi
    if [ "$SECONDS" -ge "$longest_wait_s" ]; then
      echo "another program has held apt's lock for $longest_wait_s s: $(grep -m 1 lock "$log")" >&2
      exit 1
    fi
    echo "waiting for another program: $(grep -m 1 -E 'Could not get lock|Unable to (acquire|lock)' "$log")"
    sleep "$pause_s"
  done
}

echo "installing: ${missing[*]}"
apt_get update
apt_get install -y --no-install-recommends "${missing[@]}"
