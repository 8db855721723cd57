# A man page for the command, made from its --help, and for each of its subcommands, made from their --help-all: with every flag.
# Usage: cmake -DGLOAM=binary -DHELP2MAN=program -DGZIP=program -DVERSION=0.1.0 -DOUTPUT=folder -P manual.cmake

set(ENV{COLUMNS} 100000)  # man breaks lines itself

function(help_of command result)
  execute_process(COMMAND ${GLOAM} ${command} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${help}" PARENT_SCOPE)
endfunction()

# `invocation`: "gloam" or "gloam run"; `summary`: the line under NAME; `flag`: that of the help it is made from.
function(write_page invocation summary flag)
  string(REPLACE " " "-" name "${invocation}")
  string(TOUPPER "${name}" title)
  execute_process(
    COMMAND ${HELP2MAN} --no-info --section=1 --help-option=${flag} "--name=${summary}" "--version-string=gloam ${VERSION}" "--source=gloam ${VERSION}"
            "--manual=gloam" "--include=${OUTPUT}/common.h2m" "${invocation}"
    WORKING_DIRECTORY ${OUTPUT} OUTPUT_VARIABLE page COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "\n\\.TH [^ ]+ " "\n.TH ${title} " page "${page}")
  string(REGEX REPLACE "\ngloam \\\\- " "\n${name} \\\\- " page "${page}")
  # Examples keep their lines.
  string(REGEX REPLACE "\n\\.IP\n((gloam [^\n]*\n)+)" "\n.IP\n.nf\n\\1.fi\n" page "${page}")
  file(WRITE ${OUTPUT}/${name}.1 "${page}")
  execute_process(COMMAND ${GZIP} -9nf ${OUTPUT}/${name}.1 COMMAND_ERROR_IS_FATAL ANY)  # as Debian wants them
endfunction()

file(REMOVE_RECURSE ${OUTPUT})
help_of("" help)
string(REGEX REPLACE "\nExamples:.*" "" groups "${help}")
string(REGEX MATCHALL "\n  [a-z]+ " commands "${groups}")
list(TRANSFORM commands STRIP)
if(NOT commands)
  message(FATAL_ERROR "${GLOAM} --help shows no commands: there is no man page to make")
endif()
list(TRANSFORM commands REPLACE "(.+)" "\\\\fBgloam-\\1\\\\fR(1)" OUTPUT_VARIABLE see_also)
list(JOIN see_also ", " see_also)
file(WRITE ${OUTPUT}/common.h2m
"[EXIT STATUS]
0 done, 1 failed (one line on standard error), 2 wrong usage, 128 + signal when interrupted.

[ENVIRONMENT]
.TP
\\fBPOCL_CACHE_DIR\\fR
folder where the OpenCL driver PoCL keeps compiled kernels

[SEE ALSO]
\\fBgloam\\fR(1), ${see_also}
")
# help2man takes the program from PATH, so that the page says \"gloam\" without a path.
cmake_path(GET GLOAM PARENT_PATH folder)
set(ENV{PATH} "${folder}:$ENV{PATH}")
string(REGEX MATCH "^gloam: ([^\n]*[^\n.])" unused "${help}")
write_page("gloam" "${CMAKE_MATCH_1}" --help)
foreach(command IN LISTS commands)
  help_of(${command} help)
  string(REGEX MATCH "^[^\n]*" summary "${help}")
  write_page("gloam ${command}" "${summary}" --help-all)
endforeach()
file(REMOVE ${OUTPUT}/common.h2m)
