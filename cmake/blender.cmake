# The add-on for Blender: the folder, the script for the command line, and the zip that Blender's "Install..." takes.
set(addon ${PROJECT_SOURCE_DIR}/contrib/blender)
set(addon_zip ${PROJECT_BINARY_DIR}/gloam_blender.zip)
file(GLOB addon_files CONFIGURE_DEPENDS RELATIVE ${addon} ${addon}/gloam_blender/*.py ${addon}/gloam_blender/*.toml)
list(TRANSFORM addon_files PREPEND ${addon}/ OUTPUT_VARIABLE addon_paths)
add_custom_command(
  OUTPUT ${addon_zip}
  COMMAND ${CMAKE_COMMAND} -E rm -f ${addon_zip}
  COMMAND ${CMAKE_COMMAND} -E tar cf ${addon_zip} --format=zip ${addon_files}
  WORKING_DIRECTORY ${addon} DEPENDS ${addon_paths} COMMENT "Packing the add-on for Blender" VERBATIM)
add_custom_target(blender_addon ALL DEPENDS ${addon_zip})
set(addon_folder ${CMAKE_INSTALL_DATADIR}/gloam/blender)
install(FILES ${addon_paths} DESTINATION ${addon_folder}/gloam_blender COMPONENT runtime)
install(FILES ${addon}/gloam_ao.py ${addon_zip} DESTINATION ${addon_folder} COMPONENT runtime)
