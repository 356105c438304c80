# Files of the framework are compiled six at a time: a clean build reads their headers and makes their templates once instead of six
# times, and a file that is touched there costs five others. Components and couplers are compiled one by one. Names of anonymous
# namespaces are those of one file all the same, so each is used once in such a folder; builds without show that files compile alone.
# A name that the standard library has as well (quoted) needs its namespace where a file before includes the header of that one.
option(SPREKK_UNITY "Compile files of the framework several at a time" ON)
# In these folders every file registers itself under the same name.
set(compiled_alone "^framework/(acceleration|frame_output)$")

# sprekk_library(name folder libraries…): a static library of all sources below `folder`, without those of modules.
# Folders `plane` and `space` are for one dimension.
function(sprekk_library name folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_module/|/space/")
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC ${ARGN})
    sprekk_reuses(${name} ${folder} headers)
    if(folder MATCHES "${light_folders}")
      target_compile_options(${name} PRIVATE ${light_options})
    endif()
    if(SPREKK_UNITY AND folder MATCHES "^framework/" AND NOT folder MATCHES "${compiled_alone}")
      set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    endif()
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${ARGN})
  endif()
endfunction()

# sprekk_in_space(name folder libraries…): the sources of sprekk_library(name folder …) compiled with three dimensions, as
# <name>_space. Libraries that know the dimension are named with their ending _space.
function(sprekk_in_space name folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_module/|/plane/")
  add_library(${name}_space STATIC EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(${name}_space PUBLIC ${ARGN})
  target_compile_definitions(${name}_space PUBLIC SPREKK_DIMENSION=3)
  set_target_properties(${name}_space PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
endfunction()

# sprekk_module(name folder user libraries…): sprekk_<name>.so of all sources below `folder` (framework/module/module.hpp),
# made whenever the library `user`, which opens it, is made. It knows headers of this tree alone: it links none of its libraries.
# Outside libraries that no other part of the program names are loaded together with it, instead of at every start.
function(sprekk_module name folder user)
  set(target sprekk_${name}_module)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  add_library(${target} MODULE ${sources})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME sprekk_${name} CXX_VISIBILITY_PRESET hidden
                                             VISIBILITY_INLINES_HIDDEN ON LIBRARY_OUTPUT_DIRECTORY ${SPREKK_MODULES}
                                             BUILD_RPATH "" INSTALL_RPATH "")
  target_compile_definitions(${target} PRIVATE SPREKK_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PRIVATE ${ARGN})
  target_link_options(${target} PRIVATE -Wl,--no-undefined)
  add_dependencies(${user} ${target})
  install(TARGETS ${target} LIBRARY DESTINATION lib/sprekk)
endfunction()

# sprekk_plugins(name folder libraries…): an object library, whose self-registering sources all reach the program.
function(sprekk_plugins name folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(sources)
    add_library(${name}_objects OBJECT ${sources})
    target_link_libraries(${name}_objects PUBLIC ${ARGN})
    sprekk_reuses(${name}_objects ${folder} headers)
    add_library(${name} INTERFACE)
    target_sources(${name} INTERFACE $<TARGET_OBJECTS:${name}_objects>)
    target_link_libraries(${name} INTERFACE ${ARGN})
  else()
    add_library(${name} INTERFACE)
  endif()
endfunction()

# sprekk_program(name folders…): the command line with all components and couplers, and with those in further folders, which
# are structured like this tree.
function(sprekk_program name)
  add_executable(${name} ${CMAKE_SOURCE_DIR}/tools/sprekk/main.cpp)
  target_link_libraries(${name} PRIVATE sprekk_command_line sprekk_components sprekk_couplers)
  sprekk_reuses(${name} components headers)
  target_include_directories(${name} PRIVATE ${CMAKE_BINARY_DIR}/generated)
  # Plug-ins use what the program has: all that public headers declare is in it, and is seen from outside.
  set_target_properties(${name} PROPERTIES ENABLE_EXPORTS ON)
  set(whole sprekk_config sprekk_plugin sprekk_dense sprekk_mesh sprekk_meshing sprekk_discretization sprekk_parallel sprekk_linear sprekk_field
            sprekk_assembly sprekk_output sprekk_schedule sprekk_scene)
  list(JOIN whole "," whole)
  set_target_properties(${name} PROPERTIES LINK_LIBRARY_OVERRIDE "WHOLE_ARCHIVE,${whole}")
  foreach(folder ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    target_sources(${name} PRIVATE ${sources})
    target_include_directories(${name} PRIVATE ${folder})
  endforeach()
endfunction()

# sprekk_tests(folder libraries…): one test program of all sources in `folder`, run as its single tests by ctest.
function(sprekk_tests folder)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" name test_${folder})
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} GTest::gtest_main GTest::gmock)
  target_compile_definitions(${name} PRIVATE SPREKK_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_compile_options(${name} PRIVATE ${test_options})
  sprekk_reuses(${name} ${folder} test_headers)
  gtest_discover_tests(${name} TEST_PREFIX "${folder}: " DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
