#!/usr/bin/env bash
# Completes lines as bash would, and holds the candidates against what they should be: run_completion.sh
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root" || exit 1
source scripts/completion.bash
wrong=0 cases=0

# words of a line, as readline parts them (the last one may be empty), then "--" and candidates that must all be there, or "!word" not.
completes() {
  COMP_WORDS=()
  while [ "$1" != -- ]; do COMP_WORDS+=("$1"); shift; done
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  if [ "${COMP_WORDS[0]}" = titin ]; then _titin; else _titin_run; fi
  local found=" ${COMPREPLY[*]-} " word
  for word in "$@"; do
    cases=$((cases + 1))
    case $word in
      !*) case $found in *" ${word#!} "*) printf '%s offers %s\n' "${COMP_WORDS[*]}" "${word#!}"; wrong=$((wrong + 1)) ;; esac ;;
      *) case $found in *" $word "*) ;; *) printf '%s does not offer %s, but%s\n' "${COMP_WORDS[*]}" "$word" "$found"; wrong=$((wrong + 1)) ;; esac ;;
    esac
  done
}

block=configs/muscle/block.toml
completes titin '' -- run check inspect materials keys help
completes titin ru -- run '!check'
completes titin run -- run
completes titin run configs/muscle/bl -- $block
completes titin run $block tim -- time. '!title='
completes titin run $block time.s -- time.step= time.scheme= '!time.end='
completes titin run $block materials. -- materials.muscle.
completes titin run $block materials.muscle.te -- materials.muscle.terms.
completes titin run $block materials.muscle.terms. -- materials.muscle.terms.active.
completes titin run $block materials.muscle.terms.active.peak -- materials.muscle.terms.active.peak_stress=
completes titin run $block 'boundary.' -- 'boundary."x-".' 'boundary."x+".'
completes titin run $block time.scheme = '' -- backward_euler bdf2
completes titin run $block time.scheme = bd -- bdf2 '!newmark'
completes titin run $block time.scheme = -- newmark
completes titin run $block time.scheme=bd -- time.scheme=bdf2
completes titin run $block muscle.ellipticity=t -- muscle.ellipticity=true
completes titin run $block materials.muscle.terms.base.law=ye -- materials.muscle.terms.base.law=yeoh
completes titin run $block --over -- --overwrite
completes titin run $block - -- -o -q --help
completes titin check $block mesh.c -- mesh.cells=
completes titin keys time. -- time.end time.step
completes titin materials hill -- hill_active hill_passive
completes titin inspect scr -- scripts
completes scripts/run $block time.en -- time.end=
completes scripts/run configs/lagrange/so -- configs/lagrange/sod.toml
completes titin run $block nothing.of. -- '!nothing.of.'
if [ $wrong -gt 0 ]; then exit 1; fi
echo "$cases candidates are right"
