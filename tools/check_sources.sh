#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks that every source file names its license and that C++ and GLSL are formatted.
# Usage: tools/check_sources.sh [--fix]    (--fix adds and formats what is missing)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fix=no
[ "${1:-}" = --fix ] && fix=yes
license='SPDX-License-Identifier: MIT'

cpp=(':*.cpp' ':*.h' ':*.comp' ':*.vert' ':*.frag' ':*.glsl')
mapfile -t slashes < <(git ls-files "${cpp[@]}" ':*.js' ':*.mjs')
mapfile -t hashes < <(git ls-files ':*CMakeLists.txt' ':*.cmake' ':*.sh' ':*.py' check demo .ci/run)
mapfile -t formatted < <(git ls-files "${cpp[@]}")

# The line stands first, or behind the line that names the interpreter.
names_license() { head -n 2 "$1" | grep -qF "$license"; }
add_license() { # FILE COMMENT
    local at=1
    head -n 1 "$1" | grep -q '^#!' && at=2
    sed -i "${at}i $2 $license" "$1"
}

failed=0
for file in "${slashes[@]}" "${hashes[@]}"; do
    names_license "$file" && continue
    if [ "$fix" = yes ]; then
        case "$file" in
        *.cpp | *.h | *.comp | *.vert | *.frag | *.glsl | *.js | *.mjs) add_license "$file" '//' ;;
        *) add_license "$file" '#' ;;
        esac
    else
        echo "$file: does not name its license (tools/check_sources.sh --fix adds it)" >&2
        failed=1
    fi
done

if [ "$fix" = yes ]; then
    clang-format -i "${formatted[@]}"
else
    clang-format --dry-run -Werror "${formatted[@]}" || failed=1
fi
exit $failed
