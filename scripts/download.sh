# For scripts that unpack drivers; sourced. Nothing is installed, and the system's packages are not touched.

# download SUITE FOLDER PACKAGE...: the .deb files of these packages of a suite of Debian, into FOLDER. Takes the package
# source from the machine's own list.
download() {
  local suite=$1 folder=$2 source
  shift 2
  # Where the machine gets bookworm from, in either of apt's formats.
  source=$(cat /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null |
    sed -n 's/^URIs: *\([^ ]*\).*/\1/p; s/^deb *\(\[[^]]*\] *\)\{0,1\}\([^ ]*\) *bookworm .*/\2/p' | head -n 1 || true)
  if [ -z "$source" ]; then
    echo "$(basename "$0"): no source of bookworm in /etc/apt" >&2
    return 1
  fi
  mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial"
  echo "deb $source $suite main" >"$folder/apt/sources.list"
  local options=(-q -o Acquire::Retries=3 -o "Dir::Etc::sourcelist=$folder/apt/sources.list"
    -o Dir::Etc::sourceparts=/nonexistent -o "Dir::State::lists=$folder/apt/lists" -o "Dir::Cache=$folder/apt/cache"
    -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update >/dev/null
  (cd "$folder" && apt-get "${options[@]}" download "$@" >/dev/null)
}
