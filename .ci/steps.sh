# Sourced by .ci/run and .ci/evidence: steps with their seconds, and a table of them at the end.
#
#     limit SECONDS             every step ends when the run has taken this long
#     step NAME COMMAND..       runs a command (no function); its failure ends the run
#     outside NAME COMMAND..    the same for a check that ends with 77 where a program it needs cannot be had
#
# `kept NAME` prints the seconds that docs/gate.md has for a step, or nothing.

rows=()
over=
left_out=0
stop_at=0

limit() { stop_at=$1; }

# processor seconds, user and system, of all commands that have ended, in `spent`; `times` in a subshell would know none of them
clock=$(mktemp)
trap 'rm -f "$clock"' EXIT
processor() {
    times >"$clock"
    spent=$(awk 'NR == 2 { split($1 " " $2, p, /[ms ]+/); printf "%d", 60 * p[1] + p[2] + 60 * p[3] + p[4] }' "$clock")
}

kept() { sed -n "s/^| $1 | \([0-9]*\) |.*/\1/p" docs/gate.md 2>/dev/null | head -n 1; }

# the step that took most beyond its kept seconds
grew() {
    local row name seconds most=-1 worst=
    for row in "${rows[@]}"; do
        IFS='|' read -r name seconds _ <<<"$row"
        local more=$((seconds - $(kept "$name" | grep . || echo 0)))
        [ "$more" -le "$most" ] || { most=$more; worst="$name ($seconds s, kept $(kept "$name" | grep . || echo none))"; }
    done
    echo "$worst"
}

table() {
    [ "${#rows[@]}" -gt 0 ] || return 0
    local row name seconds cpu result
    printf '\n| %s | seconds | processor seconds | result |\n|---|--:|--:|---|\n' "${1:-step}"
    for row in "${rows[@]}"; do
        IFS='|' read -r name seconds cpu result <<<"$row"
        printf '| %s | %s | %s | %s |\n' "$name" "$seconds" "$cpu" "$result"
    done
    processor
    printf '| all | %s | %s | |\n' "$SECONDS" "$spent"
}

# attempt NAME COMMAND..: runs it, adds its row, returns its status
attempt() {
    local name=$1 began=$SECONDS before status=0 result
    shift
    processor
    before=$spent
    printf '\n== %s\n   %s\n' "$name" "$*"
    if [ "$stop_at" -gt 0 ]; then
        local left=$((stop_at - SECONDS))
        if [ "$left" -le 0 ]; then
            status=124
        else
            timeout --kill-after=10 "$left" "$@" || status=$?
        fi
    else
        "$@" || status=$?
    fi
    case $status in
        0) result=passed ;;
        77) result='not run' ;;
        124) result='stopped'; over=$name ;;
        *) result=failed ;;
    esac
    processor
    rows+=("$name|$((SECONDS - began))|$((spent - before))|$result")
    return "$status"
}

# ends the run with its table and the reason
give_up() {
    table
    if [ -n "$over" ]; then
        printf '\n*** stopped after %d s in the step `%s`; the step that grew most: %s\n' "$SECONDS" "$over" "$(grew)" >&2
    else
        printf '\n*** failed: %s\n' "$1" >&2
    fi
    exit 1
}

step() { attempt "$@" || give_up "$1"; }

outside() {
    local status=0
    attempt "$@" || status=$?
    case $status in
        0) ;;
        77) left_out=$((left_out + 1)) ;;
        *) give_up "$1" ;;
    esac
}
