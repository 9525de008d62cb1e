# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# Writes the manual pages and the completions of the command into OUTPUT:
#
#   cmake -DCOMMAND=build/flagstone -DOUTPUT=DIRECTORY -P cmake/shell_files.cmake
#
# RUN_BY is an emulator that runs the command, if the command is for another machine.

function(write_output file)
  cmake_path(GET file PARENT_PATH directory)
  file(MAKE_DIRECTORY ${OUTPUT}/${directory})
  execute_process(COMMAND ${RUN_BY} ${COMMAND} ${ARGN} OUTPUT_FILE ${OUTPUT}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write_output(man1/flagstone.1 manual)
execute_process(COMMAND ${RUN_BY} ${COMMAND} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n  [a-z]+  +[A-Z]" lines "${help}")
foreach(line IN LISTS lines)
  string(REGEX MATCH "[a-z]+" name "${line}")
  write_output(man1/flagstone-${name}.1 manual ${name})
endforeach()
write_output(bash/flagstone completion bash)
write_output(zsh/_flagstone completion zsh)
write_output(fish/flagstone.fish completion fish)
