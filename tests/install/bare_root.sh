#!/usr/bin/env bash
# The portable wheel in a root with a minimal Debian and python3-venv only. For root only.
#   bare_root.sh SUITE WHEEL...     SUITE: bookworm, trixie, ...; one wheel per Python
# ROOTS, a folder, keeps the roots for the next time.
set -euo pipefail
suite=$1
shift
tests=$(realpath "$(dirname "$0")/..")
roots=${ROOTS:-$(mktemp -d)}
root=$roots/$suite
if [ ! -e "$root/usr/bin/python3" ]; then
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep /debian$ | head -n 1)
  debootstrap --variant=minbase --include=python3-venv,ca-certificates "$suite" "$root" "$mirror"
fi
end() {
  umount "$root/proc" "$root/dev" 2> /dev/null || true
  if [ -z "${ROOTS:-}" ]; then rm -rf --one-file-system "$roots"; fi
}
trap end EXIT
rm -rf "$root/wheels" "$root/checked"
mkdir -p "$root/wheels" "$root/checked"
cp "$@" "$root/wheels"
cp -r "$tests" "$root/checked/tests"
# pip reaches its registry as on this machine.
cp /etc/resolv.conf "$root/etc/"
cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
settings=()
for name in PIP_CERT PIP_INDEX_URL SSL_CERT_FILE http_proxy https_proxy OPENBLAS_CORETYPE; do
  [ -z "${!name:-}" ] || settings+=("$name=${!name}")
done
chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 "${settings[@]}" \
  bash -c 'du -sh --one-file-system / 2> /dev/null | sed "s/^/bare root: /"; bash /checked/tests/install/portable.sh /wheels/*.whl'
