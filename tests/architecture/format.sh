#!/usr/bin/env bash
# Every C++ file is as clang-format-14 writes it. To mend: tests/architecture/format.sh --fix
set -euo pipefail
cd "$(dirname "$0")/../.."

mode=(--dry-run --Werror)
if [[ "${1:-}" == --fix ]]; then mode=(-i); fi

list() {
  if [[ -e .git ]]; then
    git ls-files -z --cached --others --exclude-standard -- '*.cpp' '*.hpp' '*.h'
  else
    find server proto client-sdk tests \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' \) -print0
  fi
}
# A file that git still tracks but that is gone from the folder is not there to be formatted.
list | while IFS= read -r -d '' file; do
  if [[ -f "$file" ]]; then printf '%s\0' "$file"; fi
done | xargs -0 -r -n 16 -P 2 clang-format-14 "${mode[@]}"
