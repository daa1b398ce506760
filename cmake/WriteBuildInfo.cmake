# Writes amble_build_info.inc at each build, only if it changed:
# cmake -DSOURCE_DIR=… -DOUTPUT=… -DVERSION=… -DCOMPILER=… -DFLAGS=… -DLIBRARIES=… -P this
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/SourceVersion.cmake)
amble_source_version(${SOURCE_DIR} ${VERSION} version commit)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "#define AMBLE_VERSION \"@version@\"
#define AMBLE_COMMIT \"@commit@\"
#define AMBLE_COMPILER \"@COMPILER@\"
#define AMBLE_FLAGS \"@FLAGS@\"
#define AMBLE_LIBRARIES \"@LIBRARIES@\"
")
