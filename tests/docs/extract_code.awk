# SPDX-License-Identifier: Apache-2.0
# Makes C++ files of the C++ blocks of a document:
#
#   awk -v folder=FOLDER -v name=NAME -v file=PATH -f extract_code.awk DOCUMENT
#
# A block that has a main function is a program: it becomes programs/NAME_LINE.cpp as it is. The other blocks are
# parts of programs, each in a namespace and a function of its own. One that includes headers becomes
# NAME_LINE.cpp with these headers alone; the others become NAME.cpp, with every header included. What a
# block takes for granted stands before it in the document, where no reader sees it:
#
#   <!-- given
#   const articula::JointPidGains<2> gains{};
#   -->
#
# Compilers report errors at the lines of the document.

function scope_of(line) {
  return line ~ /^(template|struct|class|enum|namespace|using)[ <]/ ? "file" : "function"
}

function take(line,    code, opening, closing) {
  if (line ~ /^#include/) { includes = includes line "\n"; return }
  code = line
  gsub(/"([^"\\]|\\.)*"/, "", code)
  sub(/\/\/.*/, "", code)
  if (chunk == "") {
    if (code ~ /^ *$/) return
    scope = scope_of(code)
    chunk = "#line " FNR " \"" file "\"\n"
  }
  chunk = chunk line "\n"
  opening = gsub(/[({[]/, "", code)
  closing = gsub(/[])}]/, "", code)
  depth += opening - closing
  if (depth == 0 && (code ~ /; *$/ || (code ~ /^ *$/ && closing > 0))) {
    parts[scope] = parts[scope] chunk
    chunk = ""
  }
}

function finish() {
  if (chunk != "") {
    print file ":" first ": this block ends within a statement" > "/dev/stderr"
    failed = 1
  }
  if (whole ~ /int main\(/) {
    printf "#line %d \"%s\"\n%s", first, file, whole > (folder "/programs/" name "_" first ".cpp")
  } else {
    part = "namespace " name "_" first " {\n" parts["file"] "[[maybe_unused]] int block() {\n" \
           parts["function"] "  return 0;\n}\n}\n"
    if (includes == "") fragments = fragments part
    else print includes part > (folder "/" name "_" first ".cpp")
  }
  parts["file"] = parts["function"] = chunk = whole = includes = ""
  depth = 0
}

/^<!-- given$/ { given = 1; next }
/^-->$/ && given { given = 0; next }
given { take($0); next }
/^ *```/ {
  fence = !fence
  plain = fence && /^ *``` *$/
  if (fence && (/^ *``` *([cC]\+\+|cxx|cc|hpp)/ || /^ +```cpp/ || /^```cpp +$/)) {
    print file ":" FNR ": write ```cpp alone on the line, so that the block is compiled" > "/dev/stderr"
    failed = 1
  }
}
plain && /; *(\/\/.*)?$/ {
  print file ":" FNR ": C++ in a block that is not ```cpp, so it is not compiled" > "/dev/stderr"
  failed = 1
}
/^```cpp$/ { block = 1; first = FNR + 1; next }
/^```$/ && block { block = 0; finish(); next }
block { whole = whole $0 "\n"; take($0) }

END {
  if (fragments != "") {
    print "#include \"all_headers.hpp\"\nusing namespace articula;\n" fragments \
      > (folder "/" name ".cpp")
  }
  exit failed
}
