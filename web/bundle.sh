#!/usr/bin/env bash
# bundle.sh OUT: makes OUT/tera-view.html, the whole page of `tera view` in one file, from this folder and the npm packages
# that package.json pins. These are fetched once, held against their SHA-512 and kept in OUT. Where that cannot be done, the
# build goes on without the page: OUT/missing.txt says what is missing, and `tera view` prints it.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=$1
page=$out/tera-view.html
mkdir -p "$out/cache" "$out/node_modules/tera-worker"
rm -f "$out/missing.txt" "$out/made.stamp"

give_up() {
  echo "$1" >"$out/missing.txt"
  echo "tera view: built without its page: $1"
  rm -f "$page"
  exit 0
}

command -v esbuild >/dev/null || give_up "esbuild is not installed; apt-get install esbuild, then build again"
command -v curl >/dev/null || give_up "curl is not installed; apt-get install curl, then build again"
command -v openssl >/dev/null || give_up "openssl is not installed; apt-get install openssl, then build again"

fetch() {  # NAME VERSION URL INTEGRITY
  local tarball=$out/cache/$1-$2.tgz
  local digest
  [ -e "$tarball" ] || curl -fsSL --connect-timeout 10 --max-time 120 -o "$tarball.part" "$3" ||
    give_up "$3 cannot be fetched; build again with a network, or put that file at $tarball"
  [ -e "$tarball" ] || mv "$tarball.part" "$tarball"
  digest=sha512-$(openssl dgst -sha512 -binary "$tarball" | base64 -w0)
  [ "$digest" = "$4" ] || { rm -f "$tarball"; give_up "$3 is another file than web/package.json pins: found $digest, need $4"; }
  [ -e "$out/node_modules/$1/.$2" ] && return
  rm -rf "${out:?}/node_modules/$1"
  mkdir -p "$out/node_modules/$1"
  tar -xzf "$tarball" -C "$out/node_modules/$1" --strip-components=1 || give_up "$tarball cannot be unpacked"
  touch "$out/node_modules/$1/.$2"
}

while read -r name version url integrity; do
  fetch "$name" "$version" "$url" "$integrity"
done < <(sed -n '/"pins"/,/\]/s/^ *"\(.* sha512-[^"]*\)".*/\1/p' "$here/package.json")

# The worker is text within the page, so that one file is all there is.
export NODE_PATH=$out/node_modules
options=(--bundle --minify --charset=utf8 --target=es2022 --log-level=warning --legal-comments=eof)
esbuild "$here/src/worker/worker.js" "${options[@]}" --format=iife --outfile="$out/node_modules/tera-worker/worker.txt" ||
  give_up "esbuild failed on web/src/worker/worker.js"
esbuild "$here/src/main.js" "${options[@]}" --format=iife --loader:.txt=text --outfile="$out/main.js" ||
  give_up "esbuild failed on web/src/main.js"
esbuild "$here/src/style.css" "${options[@]}" --outfile="$out/main.css" || give_up "esbuild failed on web/src/style.css"

{
  sed '/<!--style-->/,$d' "$here/page.html"
  echo "<style>"; cat "$out/main.css"; echo "</style>"
  sed '1,/<!--style-->/d;/<!--script-->/,$d' "$here/page.html"
  echo "<script>"; cat "$out/main.js"; echo "</script>"
  sed '1,/<!--script-->/d' "$here/page.html"
} >"$page.part"
mv "$page.part" "$page"
touch "$out/made.stamp"
