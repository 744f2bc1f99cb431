#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# complete_in_fish.sh ARTICULA
#
# The script for fish completes commands where they are expected, also after options with values, and
# then no names of files. Names of the running loop are asked for with the typed connection.
set -eu

program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" completion fish >"$work/script.fish"

# A program of that name answers for names of the loop: it prints how it was called.
mkdir "$work/bin"
printf '#!/bin/sh\necho "asked:$*"\n' >"$work/bin/articula"
chmod +x "$work/bin/articula"
touch "$work/a_file"
cd "$work"

failed=0
# check <typed words> <whole lines that are offered>...; a word after "not" must not be offered.
check() {
  typed=$1
  shift
  offered=$(HOME=$work PATH=$work/bin:$PATH fish --no-config -c \
    "source script.fish; complete -C '$typed'" | cut -f 1)
  wanted=yes
  for word in "$@"; do
    if [ "$word" = not ]; then
      wanted=no
      continue
    fi
    found=no
    ! printf '%s\n' "$offered" | grep -qxF -- "$word" || found=yes
    [ $found = $wanted ] || { echo "'$typed': $word is offered: $found"; failed=1; }
    wanted=yes
  done
}

check 'articula ' status gains not a_file not get
check 'articula contr' controllers
check 'articula --port 8899 ' status gains not a_file
check 'articula --json gains ' get set not status not a_file
check 'articula --port 8899 gains ' get set not status
check 'articula switch --st' --start --stop
check 'articula fault ' ack
check 'articula gains get ' 'asked:names GAIN' not a_file
check 'articula --port 8899 gains get ' 'asked:--port 8899 names GAIN' not a_file
check 'articula switch --port 8899 --start ' 'asked:--port 8899 names CONTROLLER' not a_file
check 'articula play ' a_file not status
check 'articula run --controller ' a_file
exit $failed
