# Completion of acsctl for bash.
_acsctl()
{
    local IFS=$'\n'
    mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" __complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -o default -F _acsctl acsctl
