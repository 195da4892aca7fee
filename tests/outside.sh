# Sourced by tests/*/run: Python environments for checks by other programs, kept in EQUIPOD_CACHE (by default the user's cache), so that they survive `cargo clean` and
# serve every checkout; the name of each has a checksum of its requirements and of the interpreter.
#
# OUTSIDE_CHECKS=required makes it a failure when something cannot be had, OUTSIDE_CHECKS=off leaves the checks out; else they end with 77, NOT RUN.
# OUTSIDE_PYTHON names the interpreter.

not_run() {
    printf '\n*** NOT CHECKED by other programs: %s\n' "$1" >&2
    [ "${OUTSIDE_CHECKS:-}" = required ] && exit 1
    exit 77
}

# environment FOLDER: sets `venv` to an environment with the packages of FOLDER/requirements.txt, made once for each state of it
environment() {
    case ${OUTSIDE_CHECKS:-} in
        '' | required) ;;
        off) not_run 'OUTSIDE_CHECKS=off' ;;
        *) echo "OUTSIDE_CHECKS is \`$OUTSIDE_CHECKS\`: \`required\` or \`off\`" >&2; exit 1 ;;
    esac
    local python=${OUTSIDE_PYTHON:-python3} state
    command -v "$python" >/dev/null || not_run "there is no $python"
    state=$(cat "$1/requirements.txt" <("$python" --version) | cksum | tr ' ' '-')
    venv=${EQUIPOD_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/equipod}/checks-$state
    mkdir -p "$(dirname "$venv")"
    # two checks that need one environment at once make it once
    exec 8>"$venv.lock"
    flock 8 2>/dev/null || true
    if [ -e "$venv/complete" ]; then
        exec 8>&-
        return
    fi
    echo "installing $1/requirements.txt into $venv"
    rm -rf "$venv"
    "$python" -m venv "$venv" || not_run "$python has no venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$1/requirements.txt" || not_run 'the packages cannot be installed'
    touch "$venv/complete"
    exec 8>&-
}
