# sprekk_plugin(name sources…): <name>.so, a plug-in for the program of this package (`sprekk --plugin`, or `plugins:` in a scene).
# It uses the functions of the program that loads it; what it needs besides is linked by target_link_libraries.
set(sprekk_PACKAGE_FOLDER ${CMAKE_CURRENT_LIST_DIR})
function(sprekk_plugin name)
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build" FORCE)
  endif()
  add_library(${name} MODULE ${ARGN} ${sprekk_PACKAGE_FOLDER}/define_plugin.cpp)
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_include_directories(${name} SYSTEM PRIVATE ${sprekk_INCLUDE_DIRS})
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen)
  if(NOT sprekk_DIMENSION EQUAL 2)
    target_compile_definitions(${name} PRIVATE SPREKK_DIMENSION=${sprekk_DIMENSION})
  endif()
endfunction()

# sprekk_plugin_test(name command…): a test that runs `sprekk command…` with the plug-in `name`, in the folder of the sources.
function(sprekk_plugin_test name)
  string(REPLACE ";" " " title "${ARGN}")
  add_test(NAME "sprekk ${title}" COMMAND ${sprekk_PROGRAM} ${ARGN} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_tests_properties("sprekk ${title}" PROPERTIES ENVIRONMENT "SPREKK_PLUGINS=$<TARGET_FILE:${name}>")
endfunction()
