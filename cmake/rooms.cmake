# Rooms: the folders of host/, one object library each (docs/architecture.md).
#
# A room's files include "room/file.h" of the rooms that it uses, and of those that these use; each room has an include root of its own,
# so that any other include is an error: no such file. CMake refuses rooms that use each other in a circle.
set(room_roots ${PROJECT_BINARY_DIR}/rooms)

# Headers precompiled once for all rooms that are optimised alike: half of a target's own compile time would go into its own ones.
#   gloam_headers(NAME option ...)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/empty.cpp CONTENT "")
function(gloam_headers name)
  add_library(headers_${name} OBJECT ${PROJECT_BINARY_DIR}/generated/empty.cpp)
  target_link_libraries(headers_${name} PRIVATE fmt::fmt glm::glm nlohmann_json::nlohmann_json OpenMP::OpenMP_CXX Threads::Threads)
  target_compile_options(headers_${name} PRIVATE ${ARGN})
  target_precompile_headers(headers_${name} PRIVATE ${common_headers})
endfunction()
set(optimised_little $<$<CONFIG:Release>:-O1>)
gloam_headers(computing)
gloam_headers(waiting ${optimised_little})

#   gloam_waits(TARGET)
# For programs and libraries outside of rooms that wait for rooms: little optimised, with those headers.
function(gloam_waits target)
  target_link_libraries(${target} PRIVATE OpenMP::OpenMP_CXX Threads::Threads)
  target_compile_options(${target} PRIVATE ${optimised_little} -fPIC)  # as the headers are; programs would get -fPIE
  target_precompile_headers(${target} REUSE_FROM headers_waiting)
endfunction()

#   gloam_units(TARGET count)
# Compiles the target's `count` files in units of up to 32, as equal as can be: templates and headers are then compiled once for many.
function(gloam_units target count)
  math(EXPR units "(${count} + 31) / 32")
  math(EXPR batch "(${count} + ${units} - 1) / ${units}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${GLOAM_UNITY} UNITY_BUILD_BATCH_SIZE ${batch})
endfunction()

#   gloam_room(NAME [FOLDER folder] [USES room ...] [READS folder ...] [LINKS library ...] [DEFINES name ...] [GENERATED file ...]
#              [APART file ...] [COMPUTES] [SEPARATE])
# FOLDER: where its files lie, if not in host/NAME; programs there, *_bench.cpp, are not of the room. READS: further include roots.
# LINKS: libraries of which its headers, or its files, include something. GENERATED: sources that CMake makes; like those of APART they
# stay units of their own, and others are compiled several at once. COMPUTES: it goes through pixels, rays or samples itself. The
# others wait for those, the device or the disk: to optimise them fully takes a third longer and gains nothing. SEPARATE: no file is
# compiled together with another.
function(gloam_room name)
  cmake_parse_arguments(room "COMPUTES;SEPARATE" "FOLDER" "USES;LINKS;DEFINES;GENERATED;APART;READS" ${ARGN})
  set(folder ${PROJECT_SOURCE_DIR}/host/${name})
  if(room_FOLDER)
    set(folder ${PROJECT_SOURCE_DIR}/${room_FOLDER})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  if(room_FOLDER)
    list(FILTER sources EXCLUDE REGEX "_bench.cpp$")
  endif()
  add_library(room_${name} OBJECT ${sources} ${room_GENERATED})
  file(MAKE_DIRECTORY ${room_roots}/${name})
  file(CREATE_LINK ${folder} ${room_roots}/${name}/${name} SYMBOLIC)
  target_include_directories(room_${name} PUBLIC ${room_roots}/${name})
  if(EXISTS ${folder}/include)
    target_include_directories(room_${name} PUBLIC ${folder}/include)
  endif()
  target_include_directories(room_${name} PRIVATE ${room_READS})
  list(TRANSFORM room_USES PREPEND room_)
  target_link_libraries(room_${name} PUBLIC ${room_USES} ${room_LINKS})
  target_compile_definitions(room_${name} PUBLIC ${room_DEFINES})
  if(room_COMPUTES)
    target_precompile_headers(room_${name} REUSE_FROM headers_computing)
  else()
    target_compile_options(room_${name} PRIVATE ${optimised_little})
    target_precompile_headers(room_${name} REUSE_FROM headers_waiting)
  endif()
  list(TRANSFORM room_APART PREPEND ${folder}/)
  if(room_APART)
    file(GLOB room_APART CONFIGURE_DEPENDS ${room_APART})
    list(REMOVE_ITEM sources ${room_APART})
  endif()
  set_source_files_properties(${room_APART} ${room_GENERATED} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  list(LENGTH sources count)
  if(NOT room_SEPARATE)
    gloam_units(room_${name} ${count})
  endif()
endfunction()

#   gloam_library(NAME ROOMS room ... [SOURCES file ...] [USES library ...] [LINKS library ...])
# A library of rooms, as gloam::NAME without the prefix `gloam_`. USES: libraries of gloam. LINKS: what programs that link it need besides.
function(gloam_library name)
  cmake_parse_arguments(library "" "" "ROOMS;SOURCES;USES;LINKS" ${ARGN})
  set(objects "")
  set(folders "")
  foreach(room IN LISTS library_ROOMS)
    list(APPEND objects $<TARGET_OBJECTS:room_${room}>)
    list(APPEND folders $<BUILD_INTERFACE:$<TARGET_PROPERTY:room_${room},INTERFACE_INCLUDE_DIRECTORIES>>)
  endforeach()
  add_library(${name} STATIC ${objects} ${library_SOURCES})
  string(REPLACE gloam_ "" export ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${export})
  add_library(gloam::${export} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} PUBLIC ${folders} $<INSTALL_INTERFACE:include>)
  target_link_libraries(${name} PUBLIC ${library_USES} fmt::fmt glm::glm $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>
    PRIVATE ${library_LINKS})
endfunction()
