# What framework/output/build_info.hpp reports, written into a header at every configuration. A commit asks for one.
find_package(Git QUIET)
set(SPREKK_GIT_COMMIT "")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short=12 HEAD WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
                  OUTPUT_VARIABLE SPREKK_GIT_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(moves_of_head ${CMAKE_SOURCE_DIR}/.git/logs/HEAD)
if(EXISTS ${moves_of_head})
  set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${moves_of_head})
endif()

set(entries)
foreach(library VTK HDF5 Eigen3 Trilinos yaml-cpp fmt nlohmann_json CLI11)
  if(DEFINED ${library}_VERSION)
    list(APPEND entries "{\"${library}\", \"${${library}_VERSION}\"}")
  endif()
endforeach()
list(JOIN entries ", " SPREKK_LIBRARY_VERSIONS)

configure_file(${CMAKE_SOURCE_DIR}/framework/output/build_info_values.hpp.in
               ${CMAKE_BINARY_DIR}/generated/framework/output/build_info_values.hpp @ONLY)
foreach(output sprekk_output sprekk_output_space)
  target_include_directories(${output} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endforeach()
