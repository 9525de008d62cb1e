#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
#
# chromium_test.sh REPORT_EXAMPLE: in headless Chromium, no example report logs an error, and each of
# its plots has something drawn on it. Exits with 77 where there is no Chromium.
set -euo pipefail

for name in chromium chromium-browser google-chrome; do
  if browser=$(command -v "$name"); then break; fi
done
[ -n "${browser:-}" ] || { echo "no Chromium on this system"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" "$folder"

# Reports how many different colours each canvas has: "f1:57 speed:40". Blank is 1.
cat > "$folder/probe.html" << 'PROBE'
<script>
const colors = (canvas) => new Set(new Uint32Array(
  canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
document.body.dataset.colors = [...document.querySelectorAll('canvas')]
  .map((canvas) => `${canvas.id}:${colors(canvas)}`).join(' ');
</script>
PROBE

# check PAGE CANVAS... : these are the page's plots, all of them drawn, and no error is logged
check() {
  local page=$1 id drawn
  shift
  cat "$folder/probe.html" >> "$folder/$page"
  "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$folder/profile" \
    --enable-logging=stderr --dump-dom "file://$folder/$page" \
    > "$folder/dom" 2> "$folder/log" || { cat "$folder/log"; echo "$page: Chromium failed"; exit 1; }
  if grep CONSOLE "$folder/log"; then echo "$page: logged the above"; exit 1; fi
  drawn=$(sed -n 's/.*data-colors="\([^"]*\)".*/\1/p' "$folder/dom")
  echo "$page: colours on each plot: $drawn"
  [ "$(wc -w <<< "$drawn")" = $# ] || { echo "$page: there should be $# plots"; exit 1; }
  for id in "$@"; do
    [[ " $drawn " =~ " $id:"([0-9]+)" " ]] || { echo "$page: no plot $id"; exit 1; }
    [ "${BASH_REMATCH[1]}" -gt 10 ] || { echo "$page: plot $id is blank"; exit 1; }
  done
}

check eval.html f1 speed precision-recall range scans
check one.html f1 speed precision-recall range scans
check many.html f1 speed precision-recall range scans
check sweep.html f1 precision recall
check single.html f1 precision recall
check heat.html
