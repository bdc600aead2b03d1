#!/usr/bin/env bash
# The unit files say what systemd understands. Skipped (77) where systemd-analyze is not installed.
set -euo pipefail
cd "$(dirname "$0")/../.."

if ! command -v systemd-analyze >/dev/null; then
  echo "systemd-analyze is not here: the unit files were not checked"
  exit 77
fi

# The program of a unit must exist for the check: a copy of the unit names one that does.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0
for unit in deploy/systemd/*.service; do
  sed 's|^ExecStart=[^ ]*|ExecStart=/bin/true|' "$unit" >"$folder/${unit##*/}"
  said=$(systemd-analyze verify --man=no "$folder/${unit##*/}" 2>&1 | grep -F "${unit##*/}" || true)
  if [[ -n "$said" ]]; then
    printf '%s\n' "$said"
    status=1
  fi
done
# The gateway reads what the server keeps for its own account alone.
accounts=$(sed -n 's/^User=//p' deploy/systemd/mechane-server.service deploy/systemd/mechane-gateway.service | sort -u)
if [[ "$accounts" != mechane ]] || ! grep -q "^u $accounts " deploy/systemd/mechane.conf; then
  echo "mechane-server and mechane-gateway must have the account of deploy/systemd/mechane.conf"
  status=1
fi
exit $status
