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

# Names the files among the given ones in which the license stands in neither of the first two lines.
without_license() {
    awk -v license="$license" 'FNR <= 2 && index($0, license) { named[FILENAME] = 1 }
        END { for (i = 1; i < ARGC; ++i) if (!(ARGV[i] in named)) print ARGV[i] }' "$@"
}

failed=0
add_or_refuse() { # COMMENT FILE...
    local comment=$1 file at
    shift
    for file in $(without_license "$@"); do
        if [ "$fix" = yes ]; then
            at=1 # or behind the line that must be the first
            head -n 1 "$file" | grep -Eq '^#(!|version)' && at=2
            sed -i "${at}i $comment $license" "$file"
        else
            echo "$file: does not name its license (tools/check_sources.sh --fix adds it)" >&2
            failed=1
        fi
    done
}
add_or_refuse '//' "${slashes[@]}"
add_or_refuse '#' "${hashes[@]}"

if [ "$fix" = yes ]; then
    clang-format -i "${formatted[@]}"
else
    clang-format --dry-run -Werror "${formatted[@]}" || failed=1
fi
exit $failed
