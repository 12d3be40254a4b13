# Completion of acsctl for bash.
# Bash also divides words at the characters of COMP_WORDBREAKS, such as : and =. The words of the line are joined again, and the candidates
# are cut after the last of these characters, because bash replaces only what follows it.
_acsctl()
{
    local -a words=()
    local rest=$COMP_LINE word sign prefix=
    local -i i
    for ((i = 0; i <= COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        if ((i > 0)) && [[ $rest != [[:space:]]* ]]; then
            words[${#words[@]} - 1]+=$word
        else
            rest=${rest#"${rest%%[![:space:]]*}"}
            words+=("$word")
        fi
        rest=${rest#"$word"}
    done
    mapfile -t COMPREPLY < <("${words[0]}" __complete "${words[@]:1}" 2>/dev/null)
    local current=${words[${#words[@]} - 1]}
    for sign in : =; do
        if [[ $COMP_WORDBREAKS == *"$sign"* && $current == *"$sign"* ]]; then
            word=${current%"${current##*"$sign"}"}
            ((${#word} > ${#prefix})) && prefix=$word
        fi
    done
    COMPREPLY=("${COMPREPLY[@]#"$prefix"}")
}
complete -o default -F _acsctl acsctl
