# Headers that most files include are compiled once. Three sets, each made by a target of its own, and reused by others with the same
# options: `sprekk_headers` has the standard library and Eigen, `sprekk_light_headers` the same for folders beside the numerics,
# `sprekk_scene_headers` also what every component includes.
# Sources include what they use all the same (tests/includes_test.py), and compile without.
option(SPREKK_PRECOMPILED_HEADERS "Compile headers that most files include once" ON)

set(standard_headers <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <numbers> <numeric>
                     <optional> <set> <span> <stdexcept> <string> <string_view> <utility> <vector>
                     <Eigen/Core> <Eigen/LU> <Eigen/SparseCore>)
set(light_headers ${standard_headers} <fmt/format.h>)
set(scene_headers ${standard_headers} ${CMAKE_SOURCE_DIR}/framework/invariants.hpp ${CMAKE_SOURCE_DIR}/framework/config/spec.hpp
                  ${CMAKE_SOURCE_DIR}/framework/assembly/assembly.hpp ${CMAKE_SOURCE_DIR}/framework/assembly/part.hpp
                  <fmt/format.h> ${CMAKE_SOURCE_DIR}/framework/scene/registry.hpp)

set(precompiled_options)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # For ccache, which compares what the preprocessor makes. And <string> that is precompiled gives more false alarms like those of
  # gcc.gnu.org bug 105651; builds without have the warnings.
  # The compiler rarely has to collect garbage: it would walk through all of these headers each time.
  set(precompiled_options -fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
                          "SHELL:--param ggc-min-expand=1000" "SHELL:--param ggc-min-heapsize=524288")
endif()

# What tests spend their time in is in the libraries; -O3 of their own code is a third of a build from nothing. The same holds for
# folders beside the numerics: reading scenes, writing results, pages and commands. g++ compiles functions with the options of the
# precompiled headers, so these have a set of their own.
set(test_options $<$<CONFIG:Release>:-O1>)
set(light_options $<$<CONFIG:Release>:-O1>)
set(light_folders "^framework/(command_line|compare|config|converge|output|picture|report|run|schemes|study)$")

# sprekk_precompiled(name headers… [LIBRARIES libraries…]): the target `name`, which compiles these headers; for those who know the
# dimension also <name>_space.
function(sprekk_precompiled name)
  sprekk_precompiled_of(2 ${name} ${ARGN})
  if(NOT name MATCHES "test_headers")
    sprekk_precompiled_of(3 ${name}_space ${ARGN})
  endif()
endfunction()

function(sprekk_precompiled_of dimension name)
  cmake_parse_arguments(PARSE_ARGV 2 with "" "" LIBRARIES)
  if(SPREKK_PRECOMPILED_HEADERS)
    # A target has a source.
    set(empty ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
    file(CONFIGURE OUTPUT ${empty} CONTENT "// precompiled headers alone\n")
    add_library(${name} OBJECT EXCLUDE_FROM_ALL ${empty})
    target_link_libraries(${name} PRIVATE ${with_LIBRARIES})
    target_precompile_headers(${name} PRIVATE ${with_UNPARSED_ARGUMENTS})
    target_compile_options(${name} PRIVATE ${precompiled_options})
    if(dimension EQUAL 3)
      target_compile_definitions(${name} PRIVATE SPREKK_DIMENSION=3)
    endif()
    if(name MATCHES "test_headers$")
      target_compile_options(${name} PRIVATE ${test_options})
    elseif(name MATCHES "light_headers")
      target_compile_options(${name} PRIVATE ${light_options})
    endif()
  endif()
endfunction()

# sprekk_reuses(target folder kind): `target`, of the sources in `folder`, takes precompiled headers of the `kind` headers or test_headers.
function(sprekk_reuses target folder kind)
  if(NOT SPREKK_PRECOMPILED_HEADERS)
    return()
  endif()
  target_compile_options(${target} PRIVATE ${precompiled_options})
  set(space "")
  if(target MATCHES "[-_]space(_objects)?$")
    set(space _space)
  endif()
  if(folder MATCHES "${light_folders}" AND kind STREQUAL "headers")
    target_precompile_headers(${target} REUSE_FROM sprekk_light_headers${space})
  # These include nearly all of what is below them.
  elseif(folder MATCHES "^(components|couplers|verification|framework/(scene|run|study))")
    target_precompile_headers(${target} REUSE_FROM sprekk_scene_${kind}${space})
  else()
    target_precompile_headers(${target} REUSE_FROM sprekk_${kind}${space})
  endif()
endfunction()
