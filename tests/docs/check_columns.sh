#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_columns.sh ROOT DOCUMENT...
#
# No line of a document has more than 100 columns, but for tables, code, pictures and HTML. Nor has
# a comment of a header; clang-format keeps its code as narrow.
set -eu

cd "$1"
shift
awk '
  FNR == 1 { code = 0 }
  /^ *```/ { code = !code }
  !code && length($0) > 100 && !/^ *[|<!]/ { print FILENAME ":" FNR ": " length($0) " columns"; failed = 1 }
  END { print NR " lines checked"; exit failed }
' "$@"
find include -name '*.hpp' -exec awk '
  length($0) > 100 && /\/\// { print FILENAME ":" FNR ": " length($0) " columns"; failed = 1 }
  END { exit failed }
' {} +
