# Sourced by tests/*/run: Python environments under target/ for checks by other programs.
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
    venv=${CARGO_TARGET_DIR:-target}/checks-$state
    [ -e "$venv/complete" ] && return
    echo "installing $1/requirements.txt into $venv"
    rm -rf "$venv"
    "$python" -m venv "$venv" || not_run "$python has no venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$1/requirements.txt" || not_run 'the packages cannot be installed'
    touch "$venv/complete"
}
