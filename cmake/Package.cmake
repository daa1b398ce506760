# `cpack`: a Debian package with program, libraries, headers, robots, configs and (with AMBLE_PYTHON) the Python module. `make package`
# builds all that it has. docs/PYTHON.md, "Packages".
include(cmake/SourceVersion.cmake)
amble_source_version(${PROJECT_SOURCE_DIR} ${PROJECT_VERSION} version commit)
# By Debian's order of versions: 0.2.0~dev.gabc1234 < 0.2.0 < 0.2.0+7.gabc1234.
string(REGEX REPLACE "-dev-g" "~dev.g" version ${version})
string(REGEX REPLACE "-([0-9]+)-g" "+\\1.g" version ${version})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME amble)
set(CPACK_PACKAGE_VERSION ${version})
set(CPACK_PACKAGE_VENDOR "The amble authors")
set(CPACK_PACKAGE_CONTACT "The amble authors <authors@amble.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION "NEAT and HyperNEAT on physics engines: program, C++ libraries with headers, Python module, robots and configs.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Asks dpkg-shlibdeps (of dpkg-dev) for the packages of shared libraries.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What the headers' users compile against.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, pkg-config, libode-dev, libopenblas-dev, libmujoco-dev, libtomlplusplus-dev, nlohmann-json3-dev, libfmt-dev, libhwy-dev, libxxhash-dev, zlib1g-dev")
if(AMBLE_PYTHON)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS
      "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
include(CPack)
