# The room libraries with their headers, and the CMake package that finds them.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(TETRAGLASS_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tetraglass)

set(libraries tetraglass_options)
foreach(library IN ITEMS base mesh sort preint scene project_cpu project_gl project_slices project)
  set_target_properties(tetraglass_${library} PROPERTIES EXPORT_NAME ${library})
  list(APPEND libraries tetraglass_${library})
endforeach()
set_target_properties(tetraglass_options PROPERTIES EXPORT_NAME options)
install(TARGETS ${libraries} EXPORT tetraglass COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tetraglass)
install(EXPORT tetraglass NAMESPACE tetraglass:: FILE tetraglassTargets.cmake
  DESTINATION ${TETRAGLASS_PACKAGE_DIR} COMPONENT development)

# What is compiled once per instruction set (-inl.h) is no public header.
install(DIRECTORY base mesh sort preint project DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tetraglass COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE)

configure_package_config_file(cmake/tetraglassConfig.cmake.in ${PROJECT_BINARY_DIR}/tetraglassConfig.cmake
  INSTALL_DESTINATION ${TETRAGLASS_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetraglassConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tetraglassConfig.cmake ${PROJECT_BINARY_DIR}/tetraglassConfigVersion.cmake
  cmake/ExternalLibraries.cmake DESTINATION ${TETRAGLASS_PACKAGE_DIR} COMPONENT development)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT development)
