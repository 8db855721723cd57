# Runs COMMAND and writes what it prints to OUTPUT, unless that is there already.
# Usage: cmake -DCOMMAND=a;b -DOUTPUT=file -P write_if_different.cmake
include("${CMAKE_CURRENT_LIST_DIR}/write_text.cmake")
execute_process(COMMAND ${COMMAND} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
write_text_if_different("${OUTPUT}" "${text}")
