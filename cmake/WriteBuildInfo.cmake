# Writes amble_build_info.inc at each build, only if it changed: cmake -DSOURCE_DIR=… -DOUTPUT=… -DVERSION=… -DCOMPILER=… -DFLAGS=… -P this
cmake_minimum_required(VERSION 3.25)
find_program(GIT git)
set(commit "unknown")
if(GIT AND EXISTS ${SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse HEAD OUTPUT_VARIABLE head RESULT_VARIABLE bad
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT bad)
    execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} status --porcelain OUTPUT_VARIABLE changes ERROR_QUIET)
    set(commit ${head})
    if(changes)
      string(APPEND commit "+")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "#define AMBLE_VERSION \"@VERSION@\"
#define AMBLE_COMMIT \"@commit@\"
#define AMBLE_COMPILER \"@COMPILER@\"
#define AMBLE_FLAGS \"@FLAGS@\"
")
