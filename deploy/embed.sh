#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes C that embeds files in the program: the shader files, the page, the examples. The bytes are
# taken in by the assembler, which is much faster than arrays in C.
#
#   embed.sh glsl FILE...       struct glsl_file glsl_files[], for renderer/glsl.h
set -eu

# bytes LABEL FILE: LABEL and LABEL_end enclose the file; one NUL follows, so text is a C string.
bytes() {
    printf '__asm__(".section .rodata\\n.balign 16\\n.global %s\\n.hidden %s\\n%s:\\n"\n' "$1" "$1" "$1"
    printf '        ".incbin \\"%s\\"\\n.global %s_end\\n.hidden %s_end\\n%s_end:\\n.byte 0\\n.previous\\n");\n' \
        "$2" "$1" "$1" "$1"
    printf 'extern const unsigned char %s[], %s_end[];\n' "$1" "$1"
}

glsl() {
    echo '#include "renderer/glsl.h"'
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

"$@"
