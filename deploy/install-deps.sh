#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what fieldcast needs and this machine lacks: Debian packages by apt, the page's packages
# by npm. Says what it does; does nothing when all is there.
#
#   install-deps.sh          what building and running take
#   install-deps.sh test     what testing takes as well
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
purpose=${1:-run}
node_oldest=18

case $purpose in
run | test) ;;
*)
    echo "usage: install-deps.sh [run|test]" >&2
    exit 2
    ;;
esac

is_there() { # KIND NAME
    case $1 in
    command) command -v "$2" ;;
    module) pkg-config --exists "$2" ;;
    file) [ -e "$2" ] ;;
    *)
        echo "deploy/packages: what is a '$1'?" >&2
        exit 1
        ;;
    esac >/dev/null 2>&1
}

missing_packages() {
    while read -r kind name packages for; do
        case $kind in '' | '#'*) continue ;; esac
        [ "$for" = run ] || [ "$for" = "$purpose" ] || continue
        is_there "$kind" "$name" || echo "$packages" | tr ',' ' '
    done <"$here/packages"
}

install_packages() {
    if ! command -v apt-get >/dev/null; then
        echo "fieldcast needs these Debian packages, or what matches them here: $*" >&2
        exit 1
    fi
    as_root=
    if [ "$(id -u)" != 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "Please run as root:  apt-get install $*" >&2
            exit 1
        fi
        as_root=sudo
    fi
    echo "Installing with apt: $*"
    $as_root apt-get update -qq
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"
}

check_node() {
    version=$(node -p 'process.versions.node.split(".")[0]')
    if [ "$version" -lt "$node_oldest" ]; then
        echo "node $version is too old: $node_oldest or newer is needed" >&2
        exit 1
    fi
}

# npm writes node_modules/.package-lock.json last, so a broken installation is done again.
install_page_packages() {
    [ -e "$root/web/package-lock.json" ] || return 0
    installed=$root/web/node_modules/.package-lock.json
    if [ -n "$(find "$installed" -newer "$root/web/package-lock.json" 2>/dev/null)" ]; then
        return 0
    fi
    echo "Installing the page's packages with npm into web/node_modules"
    (cd "$root/web" && npm ci --no-audit --no-fund --loglevel=error)
    touch "$installed"
}

packages=$(missing_packages | tr '\n' ' ')
if [ -n "$packages" ]; then
    # shellcheck disable=SC2086 # a list of words
    install_packages $packages
fi
check_node
install_page_packages
