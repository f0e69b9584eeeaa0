# cmake --install: the library, the public headers, the program, and what find_package(Pintle) reads.
include(CMakePackageConfigHelpers)
set(PINTLE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Pintle)

install(TARGETS pintle pintle_ensembles EXPORT PintleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/pintle DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT PintleTargets NAMESPACE Pintle:: DESTINATION ${PINTLE_PACKAGE_DIR})
configure_package_config_file(cmake/PintleConfig.cmake.in ${PROJECT_BINARY_DIR}/PintleConfig.cmake
  INSTALL_DESTINATION ${PINTLE_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PintleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PintleConfig.cmake ${PROJECT_BINARY_DIR}/PintleConfigVersion.cmake
  DESTINATION ${PINTLE_PACKAGE_DIR})
install(FILES LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
