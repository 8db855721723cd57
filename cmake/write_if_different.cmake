# Runs COMMAND and writes what it prints to OUTPUT, unless that is there already.
# Usage: cmake -DCOMMAND=a;b -DOUTPUT=file -P write_if_different.cmake
execute_process(COMMAND ${COMMAND} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
set(old "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old)
endif()
if(NOT text STREQUAL old)
  file(WRITE "${OUTPUT}" "${text}")
  message(STATUS "Wrote ${OUTPUT}")
endif()
