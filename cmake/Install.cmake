# `cmake --install`: program, libraries, headers, robots and configs, a CMake package and a pkg-config file.
include(CMakePackageConfigHelpers)
get_property(amble_libraries GLOBAL PROPERTY AMBLE_LIBRARIES)

if(AMBLE_PROGRAM)
  install(TARGETS amble RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(TARGETS ${amble_libraries} EXPORT ambleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
include(cmake/PublicHeaders.cmake)
amble_install_headers()
install(DIRECTORY robots configs DESTINATION ${CMAKE_INSTALL_DATADIR}/amble)

install(EXPORT ambleTargets NAMESPACE amble:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/amble)
include(cmake/Components.cmake)
amble_write_components(${CMAKE_CURRENT_BINARY_DIR}/ambleComponents.cmake)
configure_package_config_file(cmake/ambleConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/ambleConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/amble PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/ambleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ambleConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/ambleConfigVersion.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/ambleComponents.cmake
              cmake/FindMuJoCo.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/amble)

# Static libraries: users before what they use.
list(REVERSE amble_libraries)
list(TRANSFORM amble_libraries PREPEND "-l" OUTPUT_VARIABLE amble_link_flags)
get_property(amble_registers GLOBAL PROPERTY AMBLE_REGISTERS)
list(JOIN amble_link_flags " " amble_link_flags)
list(JOIN amble_registers " " amble_registers)
# What the options leave out is not asked for (MuJoCo has no file of pkg-config).
if(AMBLE_PROGRAM)
  string(APPEND amble_private_packages " ode")
  string(APPEND amble_private_libraries " -lmujoco -lode")
endif()
if(AMBLE_OPENBLAS)
  string(APPEND amble_private_packages " openblas")
  string(APPEND amble_private_libraries " -lopenblas")
endif()
file(RELATIVE_PATH amble_prefix_from_libdir /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/amble.pc.in ${CMAKE_CURRENT_BINARY_DIR}/amble.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/amble.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
