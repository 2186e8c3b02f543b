# shellcheck shell=bash
# Sourced by app/run. `bundle BUILD DIR` makes a folder that runs on another x86-64 Linux with nothing installed but a
# GPU driver:
#   bounce          starts the program with the libraries that fit the machine (app/bundle_start.sh)
#   bounce-x86_64   the program
#   lib/            libraries that only the program uses
#   lib/shared/     libraries that a GPU driver may use too: for machines that have none, or older ones
#   glsl/ assets/ licenses/ LICENSE about.txt
# From the machine itself come the C library and OpenGL with EGL, which belong to the kernel and the driver.

of_machine='^(ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libresolv|libutil|libEGL|libGL|libGLX|libGLdispatch|libOpenGL)\.so'
of_drivers='^(libstdc\+\+|libgcc_s|libz|libX[^.]*|libX11-xcb|libxcb[^.]*|libbsd|libmd)\.so'
loaded_later='libXcursor.so.1 libXi.so.6 libXinerama.so.1 libXrandr.so.2 libXrender.so.1 libX11-xcb.so.1' # by GLFW
compiled_in='libimgui-dev libglm-dev nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev python3-glad'

# libraries_of FILE…: "name path" of each shared library that they need, directly or not
libraries_of() {
    ldd "$@" | sed -n 's/^[[:space:]]*\([^ ]*\) => \(\/[^ ]*\) .*/\1 \2/p' | sort -u
}

# The package that a file belongs to; they know some libraries by /lib, some by /usr/lib.
package_of() {
    local path
    path=$(realpath "$1")
    { dpkg -S "$path" || dpkg -S "/usr$path" || dpkg -S "${path#/usr}"; } 2>/dev/null | head -n 1 | cut -d: -f1
}

# copy_licence PACKAGE BUNDLE: packages of one source share theirs, which is kept once.
copy_licence() {
    local same
    [[ -f /usr/share/doc/$1/copyright ]] || fail "no licence found for the package '$1' (a bundle can be made on Debian only)"
    gzip -9 -n -c "/usr/share/doc/$1/copyright" >"$2/licenses/$1.txt.gz"
    for same in "$2"/licenses/*; do
        [[ -L $same || $same == "$2/licenses/$1.txt.gz" ]] && continue
        cmp -s "$same" "$2/licenses/$1.txt.gz" || continue
        ln -sf "$(basename "$same")" "$2/licenses/$1.txt.gz"
        return
    done
}

bundle() {
    [[ $# == 2 && -n $2 && $2 != -* ]] || fail "expected: app/run bundle DIR"
    local build=$1 into=$2 name path later=() aside place
    if [[ -e $into ]]; then
        [[ -d $into ]] || fail "'$into' is there already, and is not a folder"
        if [[ -n $(ls -A "$into") ]]; then
            head -n 1 "$into/about.txt" 2>/dev/null | grep -q '^A bundle of Bounce' ||
                fail "'$into' is not empty, and not an earlier bundle: nothing was changed"
        fi
    fi
    mkdir -p "$(dirname "$into")"
    into=$(realpath "$into")
    aside=$(mktemp -d "$into.XXXXXX")
    # shellcheck disable=SC2064 # the name as it is now
    trap "rm -rf $(printf %q "$aside")" EXIT
    chmod 755 "$aside"
    mkdir -p "$aside/lib/shared" "$aside/licenses"

    strip -o "$aside/bounce-x86_64" "$build/bounce"
    for name in $loaded_later; do
        path=$(ldconfig_path "$name")
        [[ -n $path ]] && later+=("$path")
    done
    while read -r name path; do
        [[ $name =~ $of_machine ]] && continue
        place=$aside/lib
        [[ $name =~ $of_drivers ]] && place=$aside/lib/shared/$name && mkdir "$place"
        install -m 644 "$(realpath "$path")" "$place/$name"
        copy_licence "$(package_of "$path")" "$aside"
    done < <({
        libraries_of "$build/bounce" "${later[@]}"
        for path in "${later[@]}"; do echo "$(basename "$path") $path"; done
    } | sort -u)
    for name in $compiled_in; do copy_licence "$name" "$aside"; done

    cp -r "$root/glsl" "$root/assets" "$root/LICENSE" "$aside"
    find "$aside/assets" \( -name '*.py' -o -name '__pycache__' -o -name generator -o -name readme -o -name charts -o -name results \) -prune -exec rm -rf {} +
    install -m 755 "$root/app/bundle_start.sh" "$aside/bounce"
    describe_bundle "$aside" >"$aside/about.txt"

    if [[ -e $into ]]; then
        rm -rf "$aside.old"
        mv "$into" "$aside.old"
        mv "$aside" "$into"
        rm -rf "$aside.old"
    else
        mv "$aside" "$into"
    fi
    echo "$into: $(du -s --apparent-size --block-size=1M "$into" | cut -f1) MiB; start it with $into/bounce"
}

# Where the loader finds a library.
ldconfig_path() { PATH=$PATH:/sbin:/usr/sbin ldconfig -p | sed -n "s/^[[:space:]]*$1 (libc6,x86-64) => //p" | head -n 1; }

describe_bundle() {
    local glibc commit
    glibc=$(objdump -T "$1"/bounce-x86_64 "$1"/lib/*.so* | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -n 1)
    commit=$(git -C "$root" describe --always --dirty=+ --abbrev=10 2>/dev/null || echo unknown)
    cat <<ABOUT
A bundle of Bounce, made from commit $commit.

It needs x86-64 Linux with ${glibc/GLIBC_/glibc } or newer, and a driver with OpenGL 4.6 and EGL. Nothing has to be installed.
Start it with ./bounce (./bounce --help lists its commands). The folder may be moved.

LICENSE is the licence of Bounce; licenses/ holds those of the libraries that it is built with (zcat shows them).
ABOUT
}
