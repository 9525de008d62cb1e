#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
#
# chromium_test.sh REPORT_EXAMPLE: opens the example reports in headless Chromium. No report may log an
# error, and no plot may be blank. Exits with 77 if Chromium is not installed.
set -euo pipefail

for name in chromium chromium-browser google-chrome; do
  if browser=$(command -v "$name"); then break; fi
done
[ -n "${browser:-}" ] || { echo "Chromium is not installed"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" "$folder"

# Reports the number of colours of each canvas: "f1:57 speed:40". A blank canvas has 1.
cat > "$folder/probe.html" << 'PROBE'
<script>
const colors = (canvas) => new Set(new Uint32Array(
  canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
document.body.dataset.colors = [...document.querySelectorAll('canvas')]
  .map((canvas) => `${canvas.id}:${colors(canvas)}`).join(' ');
</script>
PROBE

# check PAGE CANVAS...: checks that the page has exactly these plots, that none is blank and that no error is logged
check() {
  local page=$1 id drawn
  shift
  cat "$folder/probe.html" >> "$folder/$page"
  "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$folder/profile" \
    --enable-logging=stderr --dump-dom "file://$folder/$page" \
    > "$folder/dom" 2> "$folder/log" || { cat "$folder/log"; echo "$page: Chromium failed"; exit 1; }
  if grep CONSOLE "$folder/log"; then echo "$page: logged these errors"; exit 1; fi
  drawn=$(sed -n 's/.*data-colors="\([^"]*\)".*/\1/p' "$folder/dom")
  echo "$page: colours on each plot: $drawn"
  [ "$(wc -w <<< "$drawn")" = $# ] || { echo "$page: expected $# plots"; exit 1; }
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
