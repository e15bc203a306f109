# Fresh minimal Debian systems in a folder, of another release or for another kind of processor, and what is done in them; for
# other_releases.sh and packages.sh. Sourced after launch/common.sh. Needs root and debootstrap.
# The mirror is that of apt, or HDLYAP_MIRROR. HDLYAP_RELEASES (/var/tmp/hdlyap_releases) keeps base systems and packages for
# the next time, the logs, and a system itself if something failed in it.
# shellcheck shell=bash

readonly FOLDER=${HDLYAP_RELEASES:-/var/tmp/hdlyap_releases}
readonly CLONE=/hdlyap_clone/hdlyap # in the system
FAILED=0

# choose_steps KNOWN STEP...: STEPS, which have to be among those known.
choose_steps() {
    local word
    STEPS=("${@:2}")
    for word in "${STEPS[@]}"; do
        [[ " $1 " == *" $word "* ]] || die "unknown step $word, choose from: $1" 2
    done
}

# fresh_system RELEASE[.ARCHITECTURE] [USE]: SYSTEM is then its folder, with a clean clone in it; NAME begins names of logs.
fresh_system() {
    local word
    ((EUID == 0)) || die "needs root, for debootstrap and chroot"
    for word in debootstrap unshare git; do command -v "$word" >/dev/null || die "needs $word"; done
    git -C "$ROOT" diff --quiet HEAD || say "what is not committed is not tested"
    NAME=$1${2:+.$2} SYSTEM=$FOLDER/$1${2:+.$2} DEBS=$FOLDER/$1.debs
    mkdir -p "$DEBS/partial"
    [[ -d $FOLDER/$1.base ]] || make_base "$1"
    rm -rf --one-file-system "$SYSTEM"
    cp -a --reflink=auto "$FOLDER/$1.base" "$SYSTEM"
    cp -L /etc/resolv.conf "$SYSTEM/etc"
    printf '%s\n' '127.0.0.1 localhost' "127.0.1.1 $(hostname)" >"$SYSTEM/etc/hosts"
    echo force-unsafe-io >"$SYSTEM/etc/dpkg/dpkg.cfg.d/unsafe" # it may be lost
    git clone -q --no-hardlinks "$ROOT" "$SYSTEM$CLONE"
}

# make_base RELEASE
make_base() {
    local base=$FOLDER/$1.base from=${HDLYAP_MIRROR:-$(mirror)}
    [[ -n $from ]] || die "apt names no mirror of Debian: set HDLYAP_MIRROR"
    say "base system of $1 in $base"
    rm -rf "$base.new"
    debootstrap --variant=minbase "$1" "$base.new" "$from" >"$base.log" 2>&1 ||
        die "debootstrap failed; its log is $base.log: $(tail -n 1 "$base.log")"
    mv "$base.new" "$base"
}

mirror() {
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -n 1
}

# inside COMMAND...: in the clone in the system, with mounts and processes of its own, which all end with it.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --ipc --fork --kill-child bash -ec '
        mount --bind "$0" "$0" # a root that is no mount is none to ip-netns
        mount --rbind /dev "$0/dev"
        mount -t tmpfs tmpfs "$0/dev/shm"
        mount -t tmpfs tmpfs "$0/run"
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"
        mount --bind "$1" "$0/var/cache/apt/archives"
        exec chroot "$0" env -i -C "$2" HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "${@:3}"' \
        "$SYSTEM" "$DEBS" "$CLONE" "$@"
}

log_of() { echo "$FOLDER/$NAME.$1.log"; }

# step NAME COMMAND...: with a log; SAID is then how long it took. A function has to join its commands by &&.
step() {
    local log began=$SECONDS status=0
    log=$(log_of "$1")
    say "$1, to $log"
    run "${@:2}" >"$log" 2>&1 || status=$?
    SAID="$((SECONDS - began)) s"
    ((!status)) || { FAILED=1 && tail -n 20 "$log"; }
    return "$status"
}

# The first command of README.
demo() {
    DEMO=passed
    step demo inside launch/demo.sh --scene quick || DEMO=failed
    grep '^lambda_max ' "$(log_of demo)" || { DEMO+=', no table' && FAILED=1; }
    DEMO+=", $SAID"
}

# version PACKAGE: installed in the system, as its authors count it.
# shellcheck disable=SC2016
version() { inside dpkg-query -W -f '${source:Upstream-Version}' "$1" 2>/dev/null | sed 's|+.*||' || echo '?'; }

# first_number COMMAND...: the first version that it prints.
first_number() { inside "$@" 2>/dev/null | grep -oE '[0-9]+(\.[0-9]+)+' | head -n 1; }

# row HEADS CELL...: for doc/platforms.md.
row() {
    echo "| system | $1 | date | commit |"
    printf '| %s ' "$NAME ($(cat "$SYSTEM/etc/debian_version"))" "${@:2}" "$(date +%F)" "$(git -C "$SYSTEM$CLONE" rev-parse --short HEAD)"
    echo '|'
}

leave_system() {
    if ((FAILED)); then
        say "the system is kept in $SYSTEM"
    else
        rm -rf --one-file-system "$SYSTEM"
    fi
}
