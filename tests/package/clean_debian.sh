#!/bin/bash
# Installs the Debian package in an empty Debian 12 and uses it there as an ordinary user
# would: every command of the user guide that the package has must work. Run by hand:
#
#   tests/package/clean_debian.sh [FILE.deb]
#
# Without FILE.deb it builds one with the preset `portable`. It needs mmdebstrap and the
# network (some 400 MB, kept nowhere); with root it needs nothing else, without root
# mmdebstrap uses a user namespace. Exits with 0 if all went well, and prints the figures.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
source=$here/../..

command -v mmdebstrap >/dev/null || { echo "needs mmdebstrap: apt-get install mmdebstrap" >&2; exit 2; }
package=${1-}
if [ -z "$package" ]; then
  (cd "$source" && cmake --preset portable -D KEDGE_TESTS=OFF && cmake --build --preset portable \
    --target all && cd build-portable && cpack -G DEB) >&2
  package=$(ls -t "$source"/build-portable/kedge_*.deb | head -1)
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
cp "$package" "$work/kedge.deb"
cp "$here/as_a_user.sh" "$work/as_a_user.sh"
echo "package: $(basename "$package"), $(du -k "$package" | cut -f1) kB"
echo "depends on: $(dpkg-deb -f "$package" Depends)"

# What happens within: sizes before and after, apt's seconds, then the user's commands.
# Packages that are recommended come along, as in every Debian (mmdebstrap turns that off).
cat >"$work/within.sh" <<'WITHIN'
set -eu
root=$1
before=$(du -skx "$root" | cut -f1)
start=$(date +%s)
chroot "$root" env DEBIAN_FRONTEND=noninteractive \
  apt-get -o APT::Install-Recommends=true install -y /tmp/kedge.deb >"$2/apt.log" 2>&1 ||
  { tail -20 "$2/apt.log"; exit 1; }
echo "apt-get install: $(($(date +%s) - start)) s; $(grep '^Need to get' "$2/apt.log")"
chroot "$root" apt-get clean
echo "system without kedge: $((before / 1024)) MB, with it: $(($(du -skx "$root" | cut -f1) / 1024)) MB"
chroot "$root" useradd --create-home --shell /bin/bash student
chroot "$root" su - student -c "bash /tmp/as_a_user.sh"
WITHIN
chmod 755 "$work"/*.sh
mmdebstrap --quiet --variant=apt --format=null \
  --customize-hook="copy-in $work/kedge.deb $work/as_a_user.sh /tmp" \
  --customize-hook="bash $work/within.sh \"\$1\" $work" \
  bookworm /dev/null
echo "clean Debian: all went well"
