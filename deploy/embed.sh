#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes C that embeds files in the program: the shader files, the page, the examples. The bytes are
# taken in by the assembler, which is much faster than arrays in C.
#
#   embed.sh glsl FILE...          glsl_files[] of renderer/glsl/files.h
#   embed.sh embedded SOURCE WORK  page_table[] (SOURCE/web/dist), examples_table[] and
#                                  cards_table[] (SOURCE/protocol/examples), example_files_table[]
#                                  (SOURCE/protocol/examples/assets), templates_table[]
#                                  (SOURCE/server/cli), references_table[]
#                                  (SOURCE/protocol/reference) of embedded.h; WORK takes the
#                                  compressed files. Without web/dist the page's table is empty
set -eu

# bytes LABEL FILE: the file under a name, and one NUL behind it, so that text is a C string.
bytes() {
    cat <<C
__asm__(".section .rodata\n.balign 16\n"
        ".global $1\n.hidden $1\n$1:\n.incbin \"$2\"\n.byte 0\n.previous\n");
extern const unsigned char $1[];
C
}

glsl() {
    echo '#include "renderer/glsl/files.h"'
    n=0
    for file; do
        n=$((n + 1))
        bytes "glsl_$n" "$file"
    done
    echo 'const struct glsl_file glsl_files[] = {'
    n=0
    for file; do
        n=$((n + 1))
        printf '    {"%s", (const char *)glsl_%d},\n' "$(basename "$file")" "$n"
    done
    printf '    {0},\n};\n'
}

mime() {
    case $1 in
    *.html) echo 'text/html; charset=utf-8' ;;
    *.js) echo 'text/javascript; charset=utf-8' ;;
    *.css) echo 'text/css; charset=utf-8' ;;
    *.svg) echo 'image/svg+xml' ;;
    *.json | *.webmanifest) echo 'application/json' ;;
    *.png) echo 'image/png' ;;
    *.jpg) echo 'image/jpeg' ;;
    *.woff2) echo 'font/woff2' ;;
    *.wasm) echo 'application/wasm' ;;
    *.hdr) echo 'image/vnd.radiance' ;;
    *.txt) echo 'text/plain; charset=utf-8' ;;
    *)
        echo "embed.sh: no media type is known for $1" >&2
        exit 1
        ;;
    esac
}

# table NAME PREFIX: rows from lines `path file gzip` on stdin, and the count.
table() {
    rows=
    n=0
    while read -r path file gzip; do
        n=$((n + 1))
        bytes "$2$n" "$file"
        type=$(mime "$path")
        [ "$1" = page ] || path=${path%.*}
        rows="$rows    {\"$path\", \"$type\", $2$n, $(($(wc -c <"$file"))), $gzip},
"
    done
    printf 'const struct embedded %s_table[] = {\n%s    {0},\n};\n' "$1" "$rows"
    printf 'const size_t %s_count = %d;\n' "$1" "$n"
}

# Text travels compressed: the browser unpacks it, and the program is smaller.
page() {
    [ -d "$1/web/dist" ] || return 0
    (cd "$1/web/dist" && find . -type f ! -name .built | LC_ALL=C sort) | while read -r name; do
        case $name in
        *.png | *.jpg | *.woff2) echo "${name#.} $1/web/dist/$name false" ;;
        *)
            mkdir -p "$2/page/$(dirname "$name")"
            gzip -9nc "$1/web/dist/$name" >"$2/page/$name.gz"
            echo "${name#.} $2/page/$name.gz true"
            ;;
        esac
    done
}

# files FOLDER ENDING
files() {
    for file in "$1"/*."$2"; do
        [ -e "$file" ] && echo "$(basename "$file") $file false"
    done
}

# digests FOLDER: files under their SHA-256.
digests() {
    for file in "$1"/*; do
        [ -e "$file" ] && echo "$(sha256sum "$file" | cut -d ' ' -f 1).${file##*.} $file false"
    done
}

embedded() {
    echo '#include "server/embedded.h"'
    page "$1" "$2" | table page page_
    files "$1/protocol/examples" json | LC_ALL=C sort | table examples example_
    digests "$1/protocol/examples/assets" | LC_ALL=C sort | table example_files example_file_
    files "$1/protocol/examples" jpg | LC_ALL=C sort | table cards card_
    files "$1/server/cli" html | LC_ALL=C sort | table templates template_
    files "$1/protocol/reference" jpg | LC_ALL=C sort | table references reference_
}

"$@"
