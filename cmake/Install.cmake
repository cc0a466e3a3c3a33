# `cmake --install DIR --prefix X`: the program, the libraries with their headers, the data that both read, and a
# package file for find_package(tera).
include(CMakePackageConfigHelpers)

set(TERA_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tera)
set(TERA_DATA_DIR ${CMAKE_INSTALL_DATADIR}/tera)

install(TARGETS tera_options EXPORT teraTargets COMPONENT development)
set_target_properties(tera_options PROPERTIES EXPORT_NAME options)
file(STRINGS cmake/internal_headers.txt internal REGEX "^[^#]")
set(without_internal)
foreach(header IN LISTS internal)
  list(APPEND without_internal PATTERN ${header} EXCLUDE)
endforeach()
foreach(module core physics soil render sensors dataset sim)
  install(DIRECTORY src/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tera COMPONENT development
    FILES_MATCHING PATTERN "*.h" ${without_internal})
endforeach()

install(DIRECTORY shaders config examples DESTINATION ${TERA_DATA_DIR} COMPONENT program)
install(DIRECTORY assets DESTINATION ${TERA_DATA_DIR} COMPONENT program FILES_MATCHING PATTERN "*.glb")
install(FILES LICENSE DESTINATION ${TERA_DATA_DIR} COMPONENT program)

install(EXPORT teraTargets NAMESPACE tera:: DESTINATION ${TERA_PACKAGE_DIR} COMPONENT development)
configure_package_config_file(cmake/teraConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/teraConfig.cmake
  INSTALL_DESTINATION ${TERA_PACKAGE_DIR} PATH_VARS TERA_DATA_DIR)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/teraConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/teraConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/teraConfigVersion.cmake DESTINATION ${TERA_PACKAGE_DIR} COMPONENT development)
