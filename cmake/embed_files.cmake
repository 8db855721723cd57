# embed_files(OUTPUT HEADER FUNCTION WHAT FILE...): a rule that makes a C++ file with the text of files (cmake/embed.cmake), as the FUNCTION
# that the HEADER declares. WHAT: what is embedded, in words. The files are absolute paths and are named without their folders, unless
# ROOT FOLDER stands before them: then they are relative to it, and named so.
set(embed_script ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)
function(embed_files output header function what)
  cmake_parse_arguments(PARSE_ARGV 4 embed "" "ROOT" "")
  set(files ${embed_UNPARSED_ARGUMENTS})
  set(paths ${files})
  set(root "")
  if(embed_ROOT)
    list(TRANSFORM paths PREPEND ${embed_ROOT}/)
    set(root -DROOT=${embed_ROOT})
  endif()
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} ${root} "-DFILES=${files}" -DHEADER=${header} -DFUNCTION=${function} -DOUTPUT=${output} -P ${embed_script}
    DEPENDS ${paths} ${embed_script}
    COMMENT "Embedding ${what}" VERBATIM)
endfunction()
