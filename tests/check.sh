# check NAME COMMAND...: prints 'ok NAME', or what the command wrote and 'FAILED NAME'. Sourced by the test scripts, which
# set WORK and end with exit "$FAILED".
# shellcheck shell=bash disable=SC2034
FAILED=0

check() {
    local name=$1 log=${1//[^[:alnum:]_.-]/_}
    log=$WORK/${log:0:100}.log
    shift
    if "$@" >"$log" 2>&1; then
        echo "ok $name"
    else
        tail -n 60 "$log"
        echo "FAILED $name"
        FAILED=1
    fi
}

# wait_for SECONDS COMMAND...
wait_for() {
    local until=$((SECONDS + $1))
    while ! "${@:2}"; do
        ((SECONDS < until)) || return 1
        sleep 0.2
    done
}
