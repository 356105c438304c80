# Files of the framework are compiled six at a time, those of one folder of components five: a clean build reads their headers and makes
# their templates once instead of six times, and a file that is touched there costs five others. Couplers are compiled one by one. Names of anonymous
# namespaces are those of one file all the same, so each is used once in such a folder; builds without show that files compile alone.
# A name that the standard library has as well (quoted) needs its namespace where a file before includes the header of that one.
option(SPREKK_UNITY "Compile files of the framework and of components several at a time" ON)
# In these folders every file registers itself under the same name.
set(compiled_alone "^framework/(acceleration|frame_output)$")

# What knows no dimension is compiled once; all else twice, for a plane as <name> and for space as <name>_space, from the same sources:
# folders `plane` and `space` are for one of them. What is for a plane alone so far is listed here, and nowhere else.
set(without_dimension "^framework/(formula|module|parallel|picture|dense|linear)$")
set(in_a_plane_alone "^(framework/(remeshing|triangulation)|components/fine_fracture/(boundary_element|fine_level|growth|quarter_point|tips)|\
components/matrix_flow/ntpfa)(/|[.]cpp$|$)")

# sprekk_sources(result folder dimension): the sources below `folder`, without those of modules and of the other dimension.
function(sprekk_sources result folder dimension)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(dimension EQUAL 2)
    list(FILTER sources EXCLUDE REGEX "_module/|/space/")
  else()
    list(FILTER sources EXCLUDE REGEX "_module/|/plane/|${in_a_plane_alone}")
  endif()
  list(TRANSFORM sources PREPEND ${CMAKE_SOURCE_DIR}/)
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

# sprekk_of_space(result libraries…): the same libraries, those that are compiled twice as those of space.
function(sprekk_of_space result)
  get_property(twins GLOBAL PROPERTY sprekk_twins)
  get_property(plane GLOBAL PROPERTY sprekk_in_a_plane)
  set(libraries)
  foreach(library ${ARGN})
    string(REGEX MATCH "sprekk_[a-z_]+" name "${library}")
    if(name AND name IN_LIST plane)
      continue()
    elseif(name AND name IN_LIST twins)
      string(REPLACE ${name} ${name}_space library "${library}")
    endif()
    list(APPEND libraries "${library}")
  endforeach()
  set(${result} ${libraries} PARENT_SCOPE)
endfunction()

# sprekk_library(name folder libraries…): a static library of all sources below `folder`, without those of modules.
function(sprekk_library name folder)
  sprekk_library_of(2 ${name} ${folder} ${ARGN})
  if("${folder}" MATCHES "${in_a_plane_alone}")
    set_property(GLOBAL APPEND PROPERTY sprekk_in_a_plane ${name})
  elseif(NOT folder MATCHES "${without_dimension}")
    sprekk_of_space(libraries ${ARGN})
    sprekk_library_of(3 ${name}_space ${folder} ${libraries})
    set_property(GLOBAL APPEND PROPERTY sprekk_twins ${name})
  endif()
endfunction()

function(sprekk_library_of dimension name folder)
  sprekk_sources(sources ${folder} ${dimension})
  if(NOT sources)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${ARGN})
    return()
  endif()
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC ${ARGN})
  if(dimension EQUAL 3)
    target_compile_definitions(${name} PUBLIC SPREKK_DIMENSION=3)
  endif()
  sprekk_reuses(${name} ${folder} headers)
  if(folder MATCHES "${light_folders}")
    target_compile_options(${name} PRIVATE ${light_options})
  endif()
  if(SPREKK_UNITY AND folder MATCHES "^framework/" AND NOT folder MATCHES "${compiled_alone}")
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
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
  if(TARGET ${user}_space)
    add_dependencies(${user}_space ${target})
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION lib/sprekk)
endfunction()

# sprekk_plugins(name folder libraries…): an object library, whose self-registering sources all reach the program.
function(sprekk_plugins name folder)
  sprekk_of_space(libraries ${ARGN})
  sprekk_plugins_of(2 ${name} ${folder} ${ARGN})
  sprekk_plugins_of(3 ${name}_space ${folder} ${libraries})
  set_property(GLOBAL APPEND PROPERTY sprekk_twins ${name})
endfunction()

function(sprekk_plugins_of dimension name folder)
  sprekk_sources(sources ${folder} ${dimension})
  add_library(${name}_objects OBJECT ${sources})
  target_link_libraries(${name}_objects PUBLIC ${ARGN})
  sprekk_reuses(${name}_objects ${folder} headers)
  if(SPREKK_UNITY AND folder STREQUAL components)
    sprekk_unity_by_folder(${name}_objects ${sources})
  endif()
  add_library(${name} INTERFACE)
  target_sources(${name} INTERFACE $<TARGET_OBJECTS:${name}_objects>)
  target_link_libraries(${name} INTERFACE ${ARGN})
endfunction()

# sprekk_unity_by_folder(target sources…): up to five files of one folder are compiled at a time.
function(sprekk_unity_by_folder target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  set(before "")
  foreach(source ${ARGN})
    cmake_path(GET source PARENT_PATH folder)
    if(NOT folder STREQUAL before)
      set(before ${folder})
      set(count 0)
    endif()
    math(EXPR batch "${count} / 5")
    math(EXPR count "${count} + 1")
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE group)
    string(REPLACE "/" "_" group ${group})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${batch})
  endforeach()
endfunction()

# sprekk_program(name folders…): the command line with all components and couplers, and with those in further folders, which
# are structured like this tree; in a plane as `name`, in space as `name`-space, to which it hands scenes in space.
function(sprekk_program name)
  sprekk_program_of(2 ${name} ${ARGN})
  sprekk_program_of(3 ${name}-space ${ARGN})
endfunction()

function(sprekk_program_of dimension name)
  add_executable(${name} ${CMAKE_SOURCE_DIR}/tools/sprekk/main.cpp)
  set(libraries sprekk_command_line sprekk_components sprekk_couplers)
  set(whole sprekk_formula sprekk_config sprekk_plugin sprekk_dense sprekk_mesh sprekk_meshing sprekk_discretization sprekk_parallel sprekk_linear sprekk_field
            sprekk_assembly sprekk_output sprekk_schedule sprekk_scene)
  if(dimension EQUAL 3)
    sprekk_of_space(libraries ${libraries})
    sprekk_of_space(whole ${whole})
  endif()
  target_link_libraries(${name} PRIVATE ${libraries})
  sprekk_reuses(${name} components headers)
  target_include_directories(${name} PRIVATE ${CMAKE_BINARY_DIR}/generated)
  # Plug-ins use what the program has: all that public headers declare is in it, and is seen from outside.
  set_target_properties(${name} PROPERTIES ENABLE_EXPORTS ON)
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
