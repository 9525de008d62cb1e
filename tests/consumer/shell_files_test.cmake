# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# Checks the installed manual pages and completions: MAN and SHARE are directories.
foreach(file IN ITEMS bash-completion/completions/flagstone zsh/site-functions/_flagstone
                      fish/vendor_completions.d/flagstone.fish)
  file(SIZE ${SHARE}/${file} size)
  if(size EQUAL 0)
    message(FATAL_ERROR "${SHARE}/${file} is empty (expected completions; see cmake/shell_files.cmake)")
  endif()
endforeach()

file(STRINGS ${MAN}/man1/flagstone.1 commands REGEX "^[\\]fBflagstone[\\]-[a-z]+")
file(GLOB pages ${MAN}/man1/flagstone*.1)
list(LENGTH commands command_count)
list(LENGTH pages page_count)
math(EXPR expected "${command_count} + 1")
if(command_count LESS 10 OR NOT page_count EQUAL expected)
  message(FATAL_ERROR "${MAN}/man1 has ${page_count} pages (expected ${expected}: the program and each of its commands)")
endif()

find_program(MANDOC mandoc)
if(MANDOC)
  foreach(page IN LISTS pages)
    execute_process(COMMAND ${MANDOC} -T lint -W warning ${page} OUTPUT_VARIABLE findings)
    string(REGEX REPLACE "[^\n]*missing date[^\n]*\n" "" findings "${findings}")
    if(findings)
      message(FATAL_ERROR "${findings}")
    endif()
  endforeach()
endif()
