#!/bin/sh
# Starts the program of this folder. A GPU driver, which is loaded into the same process, uses some of the libraries that
# the program uses: for those the machine's own are taken where they are new enough, else the copies in lib/shared.
here=$(dirname "$(readlink -f "$0")")
program=$here/bounce-x86_64

# What the loader misses (libraries, or versions of them), found without running the program.
missing() {
    LD_TRACE_LOADED_OBJECTS=1 "$program" 2>&1 | grep 'not found' |
        sed 's/ => not found.*//; s/ not found.*//; s/^.*: \(.*: version\)/\1/; s/^[[:space:]]*//' | sort -u
}

machine_has() {
    for system_folder in /lib/x86_64-linux-gnu /usr/lib/x86_64-linux-gnu /lib64 /usr/lib64 /usr/lib /lib; do
        [ -e "$system_folder/$1" ] && return 0
    done
    return 1
}

too_old=$(missing)
for folder in "$here"/lib/shared/*; do
    name=${folder##*/}
    if ! machine_has "$name" || printf '%s' "$too_old" | grep -qF "/$name: version"; then
        LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$folder
        export LD_LIBRARY_PATH
    fi
done

still_missing=$(missing)
if [ -n "$still_missing" ]; then
    printf 'error: Bounce cannot start on this machine, which lacks:\n%s\n' "$still_missing" >&2
    sed -n 3p "$here/about.txt" >&2
    exit 2
fi
exec "$program" "$@"
