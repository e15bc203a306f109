# A fresh minimal Debian in a folder, of another release or for another kind of processor; for other_releases.sh and
# other_machine.sh. Sourced, never run. Needs root and debootstrap.
# fresh_system RELEASE [ARCHITECTURE]: which one; then FOLDER is where logs and systems are, NAME begins their names, BASE is
# the base system, kept for the next time as the packages in DEBS are, SYSTEM the one in use, CLONE the tree inside.
# shellcheck shell=bash

fresh_system() {
    local word
    ((EUID == 0)) || die "needs root, for debootstrap and chroot"
    for word in debootstrap unshare git; do command -v "$word" >/dev/null || die "needs $word"; done
    RELEASE=$1 ARCH=${2:-$(dpkg --print-architecture)} FOLDER=${HDLYAP_RELEASES:-/var/tmp/hdlyap_releases}
    NAME=$RELEASE
    [[ $ARCH == "$(dpkg --print-architecture)" ]] || NAME+=.$ARCH
    BASE=$FOLDER/$NAME.base SYSTEM=$FOLDER/$NAME DEBS=$FOLDER/$NAME.debs CLONE=/root/hdlyap
    git -C "$ROOT" diff --quiet HEAD || say "what is not committed is not tested"
    mkdir -p "$DEBS/partial"
    make_base
    make_system
}

mirror() {
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -n 1
}

make_base() {
    [[ ! -d $BASE ]] || return 0
    local from=${HDLYAP_MIRROR:-$(mirror)}
    [[ -n $from ]] || die "apt names no mirror of Debian: set HDLYAP_MIRROR"
    say "base system of $NAME in $BASE"
    rm -rf "$BASE.new"
    debootstrap --variant=minbase "--arch=$ARCH" "$RELEASE" "$BASE.new" "$from" >"$FOLDER/$NAME.base.log" 2>&1 ||
        die "debootstrap failed; its log is $FOLDER/$NAME.base.log: $(tail -n 1 "$FOLDER/$NAME.base.log")"
    echo '127.0.0.1 localhost' >"$BASE.new/etc/hosts"
    echo force-unsafe-io >"$BASE.new/etc/dpkg/dpkg.cfg.d/unsafe" # it may be lost
    mv "$BASE.new" "$BASE"
}

make_system() {
    rm -rf --one-file-system "$SYSTEM"
    cp -a --reflink=auto "$BASE" "$SYSTEM"
    cp -L /etc/resolv.conf "$SYSTEM/etc"
    git clone -q --no-hardlinks "$ROOT" "$SYSTEM$CLONE"
}

# inside COMMAND...: in the system, with mounts and processes of its own, which all end with it.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --ipc --fork --kill-child bash -ec '
        mount --rbind /dev "$0/dev"
        mount -t tmpfs tmpfs "$0/dev/shm"
        mount -t tmpfs tmpfs "$0/run"
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"
        mount --bind "$1" "$0/var/cache/apt/archives"
        exec chroot "$0" env -i -C "$2" HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin "${@:3}"' \
        "$SYSTEM" "$DEBS" "$CLONE" "$@"
}

# shellcheck disable=SC2034
# step NAME COMMAND...: with a log; then SAID is how long it took, in seconds.
step() {
    local name=$1 log=$FOLDER/$NAME.$1.log began=$SECONDS status=0
    shift
    say "$name, to $log"
    run "$@" >"$log" 2>&1 || status=$?
    SAID=$((SECONDS - began))
    ((!status)) || { FAILED=1 && tail -n 20 "$log"; }
    return "$status"
}

# version PACKAGE: installed in the system, as its authors count it.
# shellcheck disable=SC2016
version() { inside dpkg-query -W -f '${source:Upstream-Version}' "$1" 2>/dev/null || echo '?'; }

# first_number COMMAND...: the first version that it prints.
first_number() { inside "$@" 2>/dev/null | grep -oE '[0-9]+(\.[0-9]+)+' | head -n 1; }
