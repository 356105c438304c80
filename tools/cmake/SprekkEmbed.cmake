# The style and the script of reports become part of the program.
set(report_folder ${CMAKE_SOURCE_DIR}/framework/report)
file(READ ${report_folder}/page.css page_style)
file(READ ${report_folder}/page.js page_script)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${report_folder}/page.css ${report_folder}/page.js)
configure_file(${report_folder}/page_files.cpp.in ${CMAKE_BINARY_DIR}/generated/page_files.cpp @ONLY)
foreach(report sprekk_report sprekk_report_space)
  target_sources(${report} PRIVATE ${CMAKE_BINARY_DIR}/generated/page_files.cpp)
endforeach()
