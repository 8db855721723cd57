# Debian packages by `cpack` (script/package): `gloam`, `libgloam-dev` and `python3-gloam`.
set(GLOAM_MAINTAINER "The gloam authors <gloam@users.noreply.github.com>" CACHE STRING "who answers for Debian packages made here")
set(packaging ${PROJECT_BINARY_DIR}/generated/debian)

# --- Only in packages: /usr/share/doc/PACKAGE, and zsh's completions in Debian's folder for packages.
if(NOT GZIP)
  message(STATUS "no gzip: cpack makes no packages")
  return()
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/package/changelog.in ${packaging}/changelog.Debian @ONLY)
execute_process(COMMAND ${GZIP} -9nkf changelog.Debian WORKING_DIRECTORY ${packaging} COMMAND_ERROR_IS_FATAL ANY)
set(packages gloam libgloam-dev)
set(components_of_packages debian_runtime debian_development)
if(GLOAM_PYTHON)
  list(APPEND packages python3-gloam)
  list(APPEND components_of_packages debian_python)
  install(TARGETS gloam_python LIBRARY DESTINATION ${python_of_usr}/gloam COMPONENT debian_python EXCLUDE_FROM_ALL)
  install(FILES ${python_paths} DESTINATION ${python_of_usr}/gloam COMPONENT debian_python EXCLUDE_FROM_ALL)
endif()
foreach(package component IN ZIP_LISTS packages components_of_packages)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/package/copyright ${packaging}/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
install(FILES ${completion}/_gloam DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
  COMPONENT debian_runtime EXCLUDE_FROM_ALL)

# --- All packages.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gloam)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_VENDOR "The gloam authors")
set(CPACK_PACKAGE_CONTACT "${GLOAM_MAINTAINER}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime debian_runtime development debian_development)
set(CPACK_COMPONENT_RUNTIME_GROUP command)
set(CPACK_COMPONENT_DEBIAN_RUNTIME_GROUP command)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP library)
set(CPACK_COMPONENT_DEBIAN_DEVELOPMENT_GROUP library)
if(GLOAM_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL debian_python)
  set(CPACK_COMPONENT_DEBIAN_PYTHON_GROUP python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

# --- gloam
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME gloam)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
# A device: any OpenCL driver. PoCL is one for every CPU.
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd, libhdf5-103-1, fonts-dejavu-core")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "ambient occlusion and reflections on captured G-buffers
gloam computes ambient occlusion and other image-space effects on frames
that renderers and engines have written as OpenEXR: depth, and normals and
cameras where there are any. It says how near its images come to ray-traced
truth, which it traces itself where the scene is at hand, and how long each
technique takes on this computer.

It runs on any OpenCL device, a CPU among them.")

# --- libgloam-dev
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libgloam-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libfmt-dev, libglm-dev, libopenexr-dev, libdeflate-dev, libopencv-dev, libopencv-contrib-dev, \
ocl-icd-opencl-dev, libpng-dev, libtiff-dev, libfreetype-dev, libembree-dev, libassimp-dev, libssl-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "gloam, pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "image-space effects on captured G-buffers - C++ library
gloam computes ambient occlusion and other image-space effects on frames
that renderers and engines have: depth, and normals and cameras where there
are any, from OpenEXR files or from arrays in memory, on any OpenCL device.

This package has its static libraries and headers, and what CMake and
pkg-config need to find them.")

# --- python3-gloam
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-gloam)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
# The module is compiled for one version of the interpreter, and for NumPy's arrays.
math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_minor}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd, libhdf5-103-1, fonts-dejavu-core")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "gloam")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/package/python3-gloam/postinst;${PROJECT_SOURCE_DIR}/cmake/package/python3-gloam/prerm")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "image-space effects on captured G-buffers - Python module
gloam computes ambient occlusion and other image-space effects on frames
that renderers and engines have: depth, and normals and cameras where there
are any, from NumPy arrays or OpenEXR files, on any OpenCL device.

This package has the module gloam for Python 3, with type stubs. It needs
neither the command nor the library.")

include(CPack)
cpack_add_component_group(command)
cpack_add_component_group(library)
if(GLOAM_PYTHON)
  cpack_add_component_group(python)
endif()
