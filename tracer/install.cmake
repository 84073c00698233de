# The library for other projects: find_package(boxwood), then link boxwood::tracer.
set(boxwood_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/boxwood)

# A downloaded dependency is part of this build alone, so there is nothing that others could link.
foreach(dependency TBB::tbb hwy::hwy glm::glm fmt::fmt nlohmann_json::nlohmann_json OpenEXR::OpenEXR
                   PkgConfig::stb PkgConfig::zlib PkgConfig::zstd)
  get_target_property(is_of_the_system ${dependency} IMPORTED)
  if(NOT is_of_the_system)
    message(STATUS "The library is not installed: ${dependency} was downloaded")
    return()
  endif()
endforeach()

install(TARGETS tracer EXPORT boxwoodTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tracer
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/boxwood FILES_MATCHING PATTERN "*.h")
install(EXPORT boxwoodTargets NAMESPACE boxwood:: DESTINATION ${boxwood_config_dir})

include(CMakePackageConfigHelpers)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/boxwoodConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/boxwoodConfig.cmake INSTALL_DESTINATION ${boxwood_config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/boxwoodConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/boxwoodConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/boxwoodConfigVersion.cmake DESTINATION ${boxwood_config_dir})
