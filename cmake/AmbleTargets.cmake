# amble_library(<folder> SOURCES … [PUBLIC …] [PRIVATE …] [NOT_INSTALLED]): one static library per folder of src/, target amble_<folder>.
# NOT_INSTALLED: it is part of the program alone, and no component for users.
# amble_quickly_compiled(<target>): not optimised under sanitizers, as it computes little and compiling takes longer than its tests.
# amble_release_options(SOURCES … OPTIONS …): what some sources of a folder are compiled with in release builds, beside the rest.
# amble_registers(<folder>): the folder's library adds something to a registry of another.
# amble_compile_apart(SOURCE …): sources not to be compiled together with others of their folder.
# amble_kernels(SOURCE …): sources that include themselves once per instruction set.
# amble_test(<folder> SOURCES … [LINK …]): one GoogleTest program per folder of tests/.

set(AMBLE_UNITY_SOURCES 12 CACHE STRING "Sources of a folder to compile as one (1: each by itself)")

add_library(amble_options INTERFACE)
target_compile_options(amble_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wnon-virtual-dtor -ffp-contract=off)
# Compiled together, a local of one source may have the name of a private constant of another; `tools/lint --alone` reads each source by itself.
if(AMBLE_UNITY_SOURCES GREATER 1)
  target_compile_options(amble_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
else()
  target_compile_options(amble_options INTERFACE -Wshadow)
endif()
if(AMBLE_WARNINGS_AS_ERRORS)
  target_compile_options(amble_options INTERFACE -Werror)
endif()
if(AMBLE_SANITIZE)
  target_compile_options(amble_options INTERFACE -fsanitize=${AMBLE_SANITIZE} -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=all)
  target_link_options(amble_options INTERFACE -fsanitize=${AMBLE_SANITIZE})
endif()

# GCC collects its garbage from 128 MB on, in a tenth of its time. Without it a unit needs 0.6 to 1.2 GB, a quarter more.
target_compile_options(amble_options INTERFACE "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=500000>")

# Headers that nearly every source reads, compiled once for all libraries and once for all tests. What a source needs it includes all the
# same: `tools/lint --alone` reads it without these.
option(AMBLE_PRECOMPILED_HEADERS "Compile common headers once" ON)
if(AMBLE_PRECOMPILED_HEADERS)
  # GCC 12 forgets that precompiled headers are the system's, and warns of std::string's inside (its bug 105329).
  target_compile_options(amble_options INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>")
  # What ccache asks for.
  target_compile_options(amble_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                                                 "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  function(amble_headers name)
    add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/nothing.cpp)
    target_link_libraries(${name} PRIVATE amble_options fmt::fmt nlohmann_json::nlohmann_json)
    target_compile_options(${name} PRIVATE ${ARGN})
    target_precompile_headers(${name} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
                              <optional> <span> <string> <string_view> <utility> <vector> <fmt/format.h> <nlohmann/json.hpp>)
  endfunction()
  amble_headers(amble_common_headers)
endif()
function(amble_quick_headers)
  amble_headers(amble_quick_headers ${ARGN})
endfunction()

# Most of the rest of compiling is headers again: the sources of a folder are compiled together, up to so many in one unit, because a
# change of one of them then compiles all of these anew.
# amble_unity(<target> [<times>]): so many times as many, for what compiles quickly.
function(amble_unity target)
  if(AMBLE_UNITY_SOURCES GREATER 1)
    set(sources ${AMBLE_UNITY_SOURCES})
    if(ARGC GREATER 1)
      math(EXPR sources "${sources} * ${ARGV1}")
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${sources})
  endif()
endfunction()

# Sources that include themselves once per instruction set, or have private names in common with another.
function(amble_compile_apart)
  set_property(SOURCE ${ARGN} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Kernels that include themselves once per instruction set. Sanitizers (and counts for gcov) make them minutes of compiling: there AVX2 and the baseline
# represent the rest, and where a function has more than 600 of AddressSanitizer's checks Clang calls them instead of writing each out: a
# third of the time to compile. Calls everywhere would make the solver's loop, and with it tests that simulate, six times slower.
function(amble_kernels)
  amble_compile_apart(${ARGN})
  if(AMBLE_WASM)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS -O2)
  endif()
  # Highway marks NEON's functions as having instructions for cryptography, and GCC 12 forgets that in constructors that nobody wrote:
  # they cannot call those functions unless all may have them. None uses them, so any aarch64 runs this.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS -march=armv8-a+crypto)
    set_property(SOURCE ${ARGN} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
  endif()
  if(AMBLE_SANITIZE OR AMBLE_COVERAGE)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_DEFINITIONS AMBLE_FEW_INSTRUCTION_SETS)
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS -mllvm -asan-instrumentation-with-call-threshold=600)
    endif()
  endif()
endfunction()

function(amble_library folder)
  cmake_parse_arguments(ARG "NOT_INSTALLED" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target amble_${folder})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(amble::${folder} ALIAS ${target})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:amble_options> ${ARG_PRIVATE})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${folder})
  if(NOT ARG_NOT_INSTALLED)
    set_property(GLOBAL APPEND PROPERTY AMBLE_LIBRARIES ${target})
  endif()
  if(AMBLE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM amble_common_headers)
  endif()
  amble_unity(${target})
endfunction()

# The library of a folder adds something to a registry by itself: whatever links it takes the object that defines
# amble_registers_<folder>, which does that.
function(amble_registers folder)
  if(AMBLE_WASM) # where -u takes an object and then drops what nobody calls
    target_link_options(amble_${folder} INTERFACE LINKER:--export=amble_registers_${folder})
    return()
  endif()
  target_link_options(amble_${folder} INTERFACE LINKER:-u,amble_registers_${folder})
  set_property(GLOBAL APPEND PROPERTY AMBLE_REGISTERS -Wl,-u,amble_registers_${folder})
endfunction()

# GCC 12 takes the options of optimisation from a precompiled header and forgets those of the command line, so these sources have none.
function(amble_release_options)
  cmake_parse_arguments(ARG "" "" "SOURCES;OPTIONS" ${ARGN})
  set_property(SOURCE ${ARG_SOURCES} APPEND PROPERTY COMPILE_OPTIONS "$<$<CONFIG:Release>:${ARG_OPTIONS}>")
  set_property(SOURCE ${ARG_SOURCES} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
  amble_compile_apart(${ARG_SOURCES})
endfunction()

# Most of the time it takes to compile the tests goes into GoogleTest's headers, and into optimising what runs once.
function(amble_test_headers)
  add_library(amble_test_headers OBJECT ${PROJECT_SOURCE_DIR}/cmake/nothing.cpp)
  target_link_libraries(amble_test_headers PRIVATE amble_options GTest::gmock GTest::gtest fmt::fmt nlohmann_json::nlohmann_json)
  target_compile_options(amble_test_headers PRIVATE -O0)
  target_precompile_headers(amble_test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h> <algorithm> <array> <cmath> <cstdint> <filesystem>
                            <functional> <map> <memory> <optional> <span> <string> <string_view> <utility> <vector>
                            <fmt/format.h> <nlohmann/json.hpp>)
endfunction()

# What computes little is optimised little: a sixth of the time to compile all. Under sanitizers not at all, and there the tests' headers are
# the ones precompiled so. GCC takes these options from the precompiled headers, so each has its own.
function(amble_quickly_compiled target)
  if(AMBLE_WASM) # pages carry it
    target_compile_options(${target} PRIVATE -Oz)
    return()
  endif()
  set(headers amble_test_headers)
  set(option -O0)
  if(NOT AMBLE_SANITIZE)
    set(headers amble_quick_headers)
    set(option $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Og>)
  endif()
  target_compile_options(${target} PRIVATE ${option})
  if(AMBLE_PRECOMPILED_HEADERS)
    if(NOT TARGET ${headers})
      cmake_language(CALL ${headers} ${option})
    endif()
    set_property(TARGET ${target} PROPERTY PRECOMPILE_HEADERS_REUSE_FROM ${headers})
    add_dependencies(${target} ${headers})
  endif()
endfunction()

# The tests of a folder as one program. TOGETHER: CTest runs it once, because its tests take less time than starting a process for each;
# else CTest knows and schedules each test.
function(amble_test folder)
  cmake_parse_arguments(ARG "TOGETHER" "TIMEOUT" "SOURCES;LINK" ${ARGN})
  set(target ${folder}_tests)
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE amble_options ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${target} PRIVATE AMBLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(AMBLE_SANITIZE)
    target_compile_definitions(${target} PRIVATE AMBLE_SANITIZED)
  endif()
  target_compile_options(${target} PRIVATE -O0)
  amble_unity(${target} 2)
  if(AMBLE_PRECOMPILED_HEADERS)
    if(NOT TARGET amble_test_headers)
      amble_test_headers()
    endif()
    target_precompile_headers(${target} REUSE_FROM amble_test_headers)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set(properties TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.supp)
  if(ARG_TOGETHER)
    add_test(NAME ${target} COMMAND ${target} --gtest_brief=1)
    set_tests_properties(${target} PROPERTIES ${properties})
  else()
    gtest_discover_tests(${target} DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
  endif()
endfunction()
