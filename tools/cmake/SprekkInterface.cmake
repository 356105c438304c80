# framework/plugin/interface_tag.hpp: the version and a hash of the public headers, made anew whenever one of them changes.
file(GLOB_RECURSE public_headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/framework/*.hpp ${CMAKE_SOURCE_DIR}/components/*.hpp)
list(FILTER public_headers EXCLUDE REGEX "/framework/command_line/|_module/|/framework/(study|report|picture)/")
set(interface_tag ${CMAKE_BINARY_DIR}/generated/framework/plugin/interface_tag.hpp)
set(headers_file ${CMAKE_BINARY_DIR}/generated/public_headers.txt)
list(JOIN public_headers "\n" headers)
file(CONFIGURE OUTPUT ${headers_file} CONTENT "${headers}")
add_custom_command(OUTPUT ${interface_tag}
                   COMMAND ${CMAKE_COMMAND} -D version=${PROJECT_VERSION} -D headers=${headers_file} -D output=${interface_tag}
                           -P ${CMAKE_CURRENT_LIST_DIR}/interface_tag.cmake
                   DEPENDS ${public_headers} ${headers_file} VERBATIM)
foreach(plugin sprekk_plugin sprekk_plugin_space)
  target_sources(${plugin} PRIVATE ${interface_tag})
  target_include_directories(${plugin} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endforeach()
