# Minimal systems of Debian releases, made by debootstrap as root, and commands in them. Sourced after launch/common.sh.
# HDLYAP_RELEASES (/var/tmp/hdlyap_releases) keeps base systems and packages for the next time. The mirror is that of apt, or
# HDLYAP_MIRROR.
# shellcheck shell=bash

readonly FOLDER=${HDLYAP_RELEASES:-/var/tmp/hdlyap_releases}

mirror() {
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -n 1
}

# make_base RELEASE: in $FOLDER/RELEASE.base, once.
make_base() {
    local base=$FOLDER/$1.base from=${HDLYAP_MIRROR:-$(mirror)}
    [[ ! -d $base ]] || return 0
    [[ -n $from ]] || die "apt names no mirror of Debian: set HDLYAP_MIRROR"
    say "base system of $1 in $base"
    rm -rf "$base.new"
    mkdir -p "$FOLDER"
    debootstrap --variant=minbase "$1" "$base.new" "$from" >"$base.log" 2>&1 ||
        die "debootstrap failed; its log is $base.log: $(tail -n 1 "$base.log")"
    echo '127.0.0.1 localhost' >"$base.new/etc/hosts"
    mv "$base.new" "$base"
}

# make_system RELEASE SYSTEM: a fresh one.
make_system() {
    rm -rf --one-file-system "$2"
    mkdir -p "$FOLDER/$1.debs/partial"
    cp -a --reflink=auto "$FOLDER/$1.base" "$2"
    cp -L /etc/resolv.conf "$2/etc"
}

# inside SYSTEM DEBS COMMAND...: with mounts and processes of its own, which all end with it. DEBS keeps what apt fetches.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --ipc --fork --kill-child bash -ec '
        mount --rbind /dev "$0/dev"
        mount -t tmpfs tmpfs "$0/dev/shm"
        mount -t tmpfs tmpfs "$0/run"
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"
        mount --bind "$1" "$0/var/cache/apt/archives"
        exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "${@:2}"' \
        "$1" "$2" "${@:3}"
}
