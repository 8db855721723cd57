# Contents of `cmake --install`, and of the Debian packages. Component `runtime` is the command with its pages and completions
# (zsh's are `zsh`, since packages have another folder for them) and the add-on for Blender, `development` the libraries, headers and package files.
#
# The libraries are static: a C++ interface of plain structs has no stable ABI before 1.0, and kernels, techniques and scenes are
# linked in as data, so that a program that uses gloam needs none of its files.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# --- Runs first, so that it fails before any file is copied.
install(CODE [[
  set(prefix "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
  set(probe "${prefix}/.gloam-install-probe")
  execute_process(COMMAND "${CMAKE_COMMAND}" -E make_directory "${prefix}" RESULT_VARIABLE failed ERROR_QUIET OUTPUT_QUIET)
  if(NOT failed)
    execute_process(COMMAND "${CMAKE_COMMAND}" -E touch "${probe}" RESULT_VARIABLE failed ERROR_QUIET OUTPUT_QUIET)
  endif()
  if(failed)
    message(FATAL_ERROR "gloam cannot be installed into '${prefix}': the folder cannot be written; "
      "name another one with --prefix, or install as a user who may write there")
  endif()
  file(REMOVE "${probe}")
]] ALL_COMPONENTS)

# --- Libraries and headers.
install(TARGETS gloam_core EXPORT gloamCoreTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS gloam_frames gloam_pictures gloam_all EXPORT gloamTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS gloam_scene EXPORT gloamSceneTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS gloam_measure EXPORT gloamMeasureTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
file(GLOB public_headers LIST_DIRECTORIES true CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/host/*/include/gloam)
install(DIRECTORY ${public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development FILES_MATCHING PATTERN "*.h")

# --- find_package(gloam CONFIG [COMPONENTS core scene measure])
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gloam)
install(EXPORT gloamCoreTargets NAMESPACE gloam:: DESTINATION ${config_folder} COMPONENT development)
install(EXPORT gloamTargets NAMESPACE gloam:: DESTINATION ${config_folder} COMPONENT development)
install(EXPORT gloamSceneTargets NAMESPACE gloam:: DESTINATION ${config_folder} COMPONENT development)
install(EXPORT gloamMeasureTargets NAMESPACE gloam:: DESTINATION ${config_folder} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/gloamConfig.cmake.in
  ${PROJECT_BINARY_DIR}/generated/gloamConfig.cmake INSTALL_DESTINATION ${config_folder})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/gloamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/gloamConfig.cmake ${PROJECT_BINARY_DIR}/generated/gloamConfigVersion.cmake
  DESTINATION ${config_folder} COMPONENT development)

# --- pkg-config --static gloam-core, gloam, gloam-scene, gloam-measure. The prefix is where the file lies, wherever it is installed.
set(pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${pkgconfig_folder}
  OUTPUT_VARIABLE pkgconfig_to_prefix)
if(GLOAM_OPENMP)
  set(pkgconfig_openmp "${OpenMP_CXX_FLAGS}")
endif()
foreach(name gloam-core gloam gloam-scene gloam-measure)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/generated/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/generated/${name}.pc DESTINATION ${pkgconfig_folder} COMPONENT development)
endforeach()

# --- The command; its pages and completions come from its own --help.
install(TARGETS gloam RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
find_program(HELP2MAN help2man DOC "makes man pages of --help")
find_program(GZIP gzip)
set(manual ${PROJECT_BINARY_DIR}/generated/man)
set(completion ${PROJECT_BINARY_DIR}/generated/completion)
if(HELP2MAN AND GZIP)
  add_custom_command(
    OUTPUT ${manual}/gloam.1.gz
    COMMAND ${CMAKE_COMMAND} -DGLOAM=$<TARGET_FILE:gloam> -DHELP2MAN=${HELP2MAN} -DGZIP=${GZIP} -DVERSION=${PROJECT_VERSION} -DOUTPUT=${manual}
            -P ${PROJECT_SOURCE_DIR}/cmake/manual.cmake
    DEPENDS gloam ${PROJECT_SOURCE_DIR}/cmake/manual.cmake
    COMMENT "Writing the man pages" VERBATIM)
  add_custom_target(manual ALL DEPENDS ${manual}/gloam.1.gz)
  install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime FILES_MATCHING PATTERN "*.1.gz")
else()
  message(STATUS "no help2man or gzip: man pages are left out; apt install help2man gzip")
endif()
add_custom_command(
  OUTPUT ${completion}/gloam ${completion}/_gloam
  COMMAND $<TARGET_FILE:gloam> completion bash > ${completion}/gloam
  COMMAND $<TARGET_FILE:gloam> completion zsh > ${completion}/_gloam
  DEPENDS gloam COMMENT "Writing what shells complete" VERBATIM)
file(MAKE_DIRECTORY ${completion})
add_custom_target(completion ALL DEPENDS ${completion}/gloam ${completion}/_gloam)
install(FILES ${completion}/gloam DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
install(FILES ${completion}/_gloam DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT zsh)

include(${PROJECT_SOURCE_DIR}/cmake/blender.cmake)
# --- The Python module: below /usr and /usr/local where the interpreter looks for modules (Debian's has folders of its own there),
# elsewhere in a folder for PYTHONPATH.
if(GLOAM_PYTHON)
  execute_process(COMMAND ${Python_EXECUTABLE} -c "
import sysconfig
known = sysconfig.get_scheme_names()
for scheme, prefix in (('deb_system', '/usr'), ('posix_local', '/usr/local'), ('posix_prefix', '/opt')):
    scheme = scheme if scheme in known else 'posix_prefix'
    variables = {'base': prefix, 'platbase': prefix, 'installed_base': prefix}
    if scheme == 'posix_local':  # adds /local by itself
        variables = {'base': '/usr', 'platbase': '/usr', 'installed_base': '/usr'}
    print(sysconfig.get_path('platlib', scheme, variables)[len(prefix) + 1:])"
    OUTPUT_VARIABLE python_folders OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" python_folders "${python_folders}")
  list(GET python_folders 0 python_of_usr)
  list(GET python_folders 1 python_of_local)
  list(GET python_folders 2 python_elsewhere)
  install(CODE "
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
      set(python_folder ${python_of_usr})
    elseif(CMAKE_INSTALL_PREFIX STREQUAL \"/usr/local\")
      set(python_folder ${python_of_local})
    else()
      set(python_folder ${python_elsewhere})
    endif()
    file(INSTALL ${python_paths} \"$<TARGET_FILE:gloam_python>\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${python_folder}/gloam\")
  " COMPONENT python)
endif()

# --- What is installed, and nothing else: the target of script/build.
add_custom_target(product)
foreach(part gloam gloam_core gloam_frames gloam_pictures gloam_scene gloam_measure gloam_python python_package manual completion blender_addon)
  if(TARGET ${part})
    add_dependencies(product ${part})
  endif()
endforeach()

include(${PROJECT_SOURCE_DIR}/cmake/package.cmake)
