#!/bin/bash
# Checks the manual by mandoc, and that zsh and fish read their completions and complete by them. (Unit tests do bash.)
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build manual
cmake --preset release >/dev/null
cmake --build --preset release --target manual
manual=build/release/manual

mandoc -Tlint "$manual"/man/man1/*.1
bash -n "$manual/bash-completion/completions/trisect"
zsh -n "$manual/zsh/vendor-completions/_trisect"
fish --no-execute "$manual/fish/vendor_completions.d/trisect.fish"

# expect SHELL LINE WORD OFFERED: the word must be one of those that the shell offers at the end of the line.
expect() {
  if ! grep -q -- "$3" <<<"$4"; then
    echo "$1 does not offer '$3' after '$2', but: $4" >&2
    exit 1
  fi
}

home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
in_fish() {
  HOME=$home fish --no-config -c 'source $argv[1]; complete -C $argv[2]' \
    "$manual/fish/vendor_completions.d/trisect.fish" "$1"
}
# zsh completes in a terminal only, which its module zpty makes: the keys are the line and a tab.
in_zsh() {
  HOME=$home zsh -f scripts/check-manual.zsh "$manual/zsh/vendor-completions" "$1"
}
while IFS='|' read -r line word; do
  expect fish "$line" "$word" "$(in_fish "$line")"
  expect zsh "$line" "$word" "$(in_zsh "$line")"
done <<'END'
trisect cross|crosscheck
trisect bench sp|speed
trisect render --sur|--surface
trisect render --surface sph|sphere
trisect render --surface=sph|sphere
trisect render assets/sphere-2|sphere-20.obj
trisect render assets/torus.obj -o docs/teap|teapot.png
END
echo "The manual and the completions are well"
