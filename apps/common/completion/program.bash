# Completion of a program for bash: what its --help lists, and files. Installed under the name of the program.
_acs_program()
{
    local program="$1" word="$2" help
    local -a commands=()
    if [ "$COMP_CWORD" -gt 1 ] && [[ "${COMP_WORDS[1]}" != -* ]]; then
        commands=("${COMP_WORDS[1]}")
    fi
    help="$("$program" "${commands[@]}" --help 2>/dev/null)" || return
    if [[ "$word" == -* ]]; then
        help="$(sed -nE 's/^  (-[A-Za-z],)?(--[a-z-]+).*/\2/p' <<<"$help")"
    elif [ "$COMP_CWORD" -eq $((${#commands[@]} + 1)) ]; then
        help="$(sed -nE -e "s/.*${program##*/} ([a-z]+) [A-Z]{2}.*/\1/p" -e '/^Subcommands:/,/^$/s/^  ([a-z]+) .*/\1/p' <<<"$help")"
    else
        help=""
    fi
    mapfile -t COMPREPLY < <(compgen -W "$help" -- "$word")
}
complete -o default -F _acs_program "${BASH_SOURCE[0]##*/}"
