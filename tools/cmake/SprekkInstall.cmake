# cmake --install, and the Debian package that tools/package makes of it. What the program itself prints (manual page, completions,
# schemas) is made in the build folder whenever the program is.
set(made ${CMAKE_BINARY_DIR}/share)
set(shared_files)
function(sprekk_prints file folder)
  add_custom_command(OUTPUT ${made}/${file} COMMAND ${CMAKE_COMMAND} -E make_directory ${made}
                     COMMAND $<TARGET_FILE:sprekk> ${ARGN} > ${made}/${file} DEPENDS sprekk sprekk-space VERBATIM)
  set(shared_files ${shared_files} ${made}/${file} PARENT_SCOPE)
  install(FILES ${made}/${file} DESTINATION ${folder})
endfunction()
sprekk_prints(sprekk.1 share/man/man1 man)
sprekk_prints(sprekk share/bash-completion/completions completion bash)
sprekk_prints(_sprekk share/zsh/vendor-completions completion zsh)
sprekk_prints(scene.schema.json share/sprekk schema)
sprekk_prints(study.schema.json share/sprekk schema study)
add_custom_target(sprekk_shared_files ALL DEPENDS ${shared_files})

install(TARGETS sprekk sprekk-space RUNTIME DESTINATION bin)
install(DIRECTORY configs/ DESTINATION share/doc/sprekk/examples)
install(FILES LICENSE DESTINATION share/doc/sprekk RENAME copyright)
install(FILES README.md DESTINATION share/doc/sprekk)

# What plug-ins are built with: public headers, and a CMake package with sprekk_plugin(). The build folder has the same package, for
# plug-ins that are built against a tree which is not installed.
foreach(header ${public_headers})
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE place)
  cmake_path(GET place PARENT_PATH place)
  install(FILES ${header} DESTINATION include/sprekk/${place})
endforeach()
install(FILES ${interface_tag} DESTINATION include/sprekk/framework/plugin)
set(package_files ${CMAKE_CURRENT_LIST_DIR}/sprekk_plugin.cmake ${CMAKE_CURRENT_LIST_DIR}/define_plugin.cpp)
install(FILES ${package_files} DESTINATION lib/cmake/sprekk)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/sprekk-config-version.cmake COMPATIBILITY SameMinorVersion)
function(write_package_config file include program)
  configure_file(${CMAKE_SOURCE_DIR}/tools/cmake/sprekk-config.cmake.in ${file} @ONLY)
endfunction()
write_package_config(${CMAKE_BINARY_DIR}/install/sprekk-config.cmake "\${CMAKE_CURRENT_LIST_DIR}/../../../include/sprekk"
                     "\${CMAKE_CURRENT_LIST_DIR}/../../../bin/sprekk")
write_package_config(${CMAKE_BINARY_DIR}/sprekk-config.cmake "${CMAKE_SOURCE_DIR};${CMAKE_BINARY_DIR}/generated"
                     "${CMAKE_BINARY_DIR}/sprekk")
file(COPY ${package_files} DESTINATION ${CMAKE_BINARY_DIR})
install(FILES ${CMAKE_BINARY_DIR}/install/sprekk-config.cmake ${CMAKE_BINARY_DIR}/sprekk-config-version.cmake
        DESTINATION lib/cmake/sprekk)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sprekk)
set(CPACK_PACKAGE_VENDOR "the Sprekk authors")
set(CPACK_PACKAGE_CONTACT "The Sprekk authors <maintainers@sprekk.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "coupled simulations of fractured porous rock")
set(CPACK_PACKAGE_DESCRIPTION
    "Flow in rock and in fractures, deformation, friction, opening, and growth of fractures,
described by scenes in YAML: which physics act, how they are coupled and how a time
step is solved.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# mpirun starts several processes; without OpenBLAS factorizations take four times as long; graphviz draws `sprekk graph`.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libopenblas0-pthread, openmpi-bin, graphviz")
include(CPack)
