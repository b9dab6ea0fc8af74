# Completion of tessera for bash: commands, options and files. Options come from `tessera COMMAND --help`.
_tessera() {
    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=
    local commands="view render reconstruct reference merge compare bench sweep stability info"
    COMPREPLY=()
    for candidate in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ " $commands " == *" $candidate "* ]] && command=$candidate && break
    done
    case $previous in
    -m | --method | --methods) COMPREPLY=($(compgen -W "pt pr gpt gpr" -- "$word")) && return ;;
    --recon) COMPREPLY=($(compgen -W "none l2 l1 mixed uniform weighted guided smoothed oidn" -- "$word")) && return ;;
    esac
    if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$(tessera $command --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*')" -- "$word"))
    elif [[ -z $command && $COMP_CWORD == 1 ]]; then
        COMPREPLY=($(compgen -W "$commands" -- "$word") $(compgen -f -- "$word"))
    else
        COMPREPLY=($(compgen -f -- "$word"))
    fi
}
complete -o filenames -F _tessera tessera
