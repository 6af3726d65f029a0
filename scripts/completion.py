"""Shell completion for bash and zsh: sub-commands, their options, laws, keys of a scene and their words. Used by scripts/reference.py."""
import re
import subprocess

HEAD = r"""# Completion of titin and scripts/run in bash and zsh; written by scripts/reference.py, do not edit. Put into ~/.bashrc or ~/.zshrc:
#
#   source <this file>
#
# A key comes one part at a time; where the name is yours (materials.NAME), those of the scene on the line are offered.
if [ -n "${ZSH_VERSION:-}" ]; then autoload -U +X compinit bashcompinit && compinit && bashcompinit; fi
"""

FUNCTIONS = r"""
# Names that a scene gives to the tables below $1, such as materials: from its heads, [materials.muscle] or [materials.muscle.terms].
_titin_names() {
  local scene=$1 parent=$2
  [ -n "$scene" ] && [ -f "$scene" ] || return 0
  sed -nE 's/^[[:space:]]*\[([^]]*)\].*/\1/p' "$scene" | tr -d ' ' | while IFS= read -r head; do
    case $head in "$parent".*) head=${head#"$parent".}; case $head in
      \"*) head=${head#\"}; printf '"%s"\n' "${head%%\"*}" ;;
      *) printf '%s\n' "${head%%.*}" ;;
    esac ;; esac
  done | sort -u
}

# The next part of every key that fits what is typed so far: each whole part that is typed against that of the key.
_titin_next() {
  local scene=$1 typed=$2 parent=
  case $typed in *.*) parent=${typed%.*} ;; esac
  printf '%s\n' "$_titin_keys" | TYPED=$typed NAMES=$(_titin_names "$scene" "$parent") awk '
    BEGIN {
      n = split(ENVIRON["TYPED"], typed, "."); if (n == 0) n = 1
      m = split(ENVIRON["NAMES"], names, "\n")
      for (i = 1; i < n; i++) before = before typed[i] "."
    }
    {
      k = split($0, part, "."); if (k < n) next
      for (i = 1; i < n; i++) if (part[i] != "<NAME>" && part[i] != typed[i]) next
      after = k == n ? "=" : "."
      if (part[n] != "<NAME>") print before part[n] after
      else for (j = 1; j <= m; j++) print before names[j] after
    }' | sort -u
}

# The words that a key may take.
_titin_words() {
  local typed=$1 key words pattern
  while read -r key words; do
    pattern=${key//<NAME>/*}
    case $typed in $pattern) printf '%s\n' $words ;; esac
  done <<<"$_titin_choices"
}

_titin_fill() {   # candidates on standard input that begin with $1
  local line
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in "$1"*) COMPREPLY+=("$line") ;; esac
  done
  case ${COMPREPLY[*]} in *[.=]*) compopt -o nospace 2>/dev/null ;; esac
}

_titin_scene_words() {   # a scene, then key=value
  local current=$1 scene= word
  for word in "${COMP_WORDS[@]}"; do case $word in *.toml) [ -f "$word" ] && scene=$word ;; esac; done
  if [ "$current" = = ]; then _titin_fill '' < <(_titin_words "${COMP_WORDS[COMP_CWORD-1]}")
  elif [ "${COMP_WORDS[COMP_CWORD-1]}" = = ]; then _titin_fill "$current" < <(_titin_words "${COMP_WORDS[COMP_CWORD-2]}")
  elif [[ $current == *=* ]]; then   # zsh does not part words at the sign
    _titin_fill "$current" < <(_titin_words "${current%%=*}" | sed "s/^/${current%%=*}=/")
  elif [ -z "$scene" ]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -X '!*.toml' -- "$current") $(compgen -d -- "$current"))
  else _titin_fill "$current" < <(_titin_next "$scene" "$current")
  fi
}

_titin_complete() {   # $1: the sub-command, $2: the word at the cursor
  local options=_titin_options_$1
  case ${COMP_WORDS[COMP_CWORD-1]} in
    -o | --restart) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- "$2")); return ;;
  esac
  case $2 in -*) COMPREPLY=($(compgen -W "$(eval "echo \"\${$options:-}\"")" -- "$2")); return ;; esac
  case $1 in
    run | check) _titin_scene_words "$2" ;;
    keys) _titin_fill "$2" < <(_titin_next '' "$2" | sed 's/=$//') ;;
    materials) COMPREPLY=($(compgen -W "$_titin_laws" -- "$2")) ;;
    inspect) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- "$2")) ;;
  esac
}

_titin() {
  local current=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then COMPREPLY=($(compgen -W "$_titin_commands --help --version" -- "$current"))
  else _titin_complete "${COMP_WORDS[1]}" "$current"
  fi
}
_titin_run() { COMPREPLY=(); _titin_complete run "${COMP_WORDS[COMP_CWORD]}"; }
_titin_space() { if [ -n "${ZSH_VERSION:-}" ]; then echo -o nospace; fi; }   # zsh asks once for all words
complete $(_titin_space) -F _titin titin build/bin/titin ./titin
complete $(_titin_space) -F _titin_run scripts/run ./scripts/run
"""


def help_of(titin, *words):
    return subprocess.run([titin, *words, "--help"], check=True, capture_output=True, text=True).stdout


def sub_commands(titin):
    return re.findall(r"^  (\w+)  ", help_of(titin).split("Subcommands:")[1], re.M)


def options_of(titin, command):
    """Both forms of each option: its line begins with "  -h,--help"."""
    lines = re.findall(r"^  (-\S+)", help_of(titin, command), re.M)
    return [word for line in lines for word in line.split(",")]


def quoted(name, lines):
    return f"{name}='" + "\n".join(lines) + "'\n"


def paths_of(keys, laws):
    """Every key that a scene may say, those of laws below the tables that hold a law."""
    paths = [key["path"] for key in keys if key["type"] != "table"]
    tables = {"volumetric": ["volumetric"], "fluid": ["fluid"]}
    for law in laws:
        for holder in [p.removesuffix(".law") for p in paths if p.endswith(".law")]:
            if holder.endswith("terms.<NAME>") if law["kind"] not in tables else holder.split(".")[-1] in tables[law["kind"]]:
                paths += [f"{holder}.{key['path']}" for key in law["parameters"] if key["type"] != "table"]
    return sorted(set(paths))


def completion_of(titin, keys, laws):
    commands = sub_commands(titin)
    words = [f"{key['path']} {' '.join(key['choices'])}" for key in keys if key["choices"]]
    words += [f"{key['path']} true false" for key in keys if key["type"] == "true or false"]
    text = HEAD + "\n" + quoted("_titin_commands", [" ".join(commands)])
    text += "".join(quoted(f"_titin_options_{c}", [" ".join(options_of(titin, c))]) for c in commands)
    text += quoted("_titin_laws", [" ".join(sorted({law["name"] for law in laws}))])
    return text + quoted("_titin_keys", paths_of(keys, laws)) + quoted("_titin_choices", sorted(words)) + FUNCTIONS
