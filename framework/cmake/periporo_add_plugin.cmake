# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# periporo_add_plugin(NAME my_clay KIND material SOURCES my_clay.cpp [LIBRARIES CGAL::CGAL ...]
#                     [TEST my_clay_test.cpp ...])
#
# Builds one plugin as a shared library `periporo_<kind>_<name>.so` in `<build>/lib/periporo`, with the compiler
# settings that the program was built with. TEST builds a doctest program from these sources and the plugin's own;
# ctest knows it as `<kind>.<name>`. The plugins of the project itself are made by this same function.
include(GNUInstallDirs)

# The pack algebra of operator and laws is many small functions, which GCC stops inlining at its default limits. Its
# global elimination of common subexpressions keeps more packs alive than there are registers.
set(PERIPORO_PACK_OPTIONS
  $<$<CXX_COMPILER_ID:GNU>:-fno-gcse>
  $<$<CXX_COMPILER_ID:GNU>:--param=max-inline-insns-single=2000>
  $<$<CXX_COMPILER_ID:GNU>:--param=max-inline-insns-auto=400>
  $<$<CXX_COMPILER_ID:GNU>:--param=inline-unit-growth=400>
  $<$<CXX_COMPILER_ID:GNU>:--param=large-function-growth=2000>)

# GCC 12 sees uninitialised values in its own AVX-512 headers (GCC bug 105593), hence the exception.
function(_periporo_warn target)
  if(COMMAND periporo_project_warnings)
    periporo_project_warnings(${target})
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wno-maybe-uninitialized)
  endif()
endfunction()

# The test program of a plugin, made of the test's sources and of what the plugin was compiled to.
function(_periporo_add_plugin_test plugin name sources libraries)
  find_package(doctest 2.4 REQUIRED)
  add_executable(${plugin}_test ${sources} $<TARGET_OBJECTS:${plugin}>)
  target_link_libraries(${plugin}_test PRIVATE periporo::sdk doctest::doctest ${libraries})
  set_target_properties(${plugin}_test PROPERTIES CXX_EXTENSIONS OFF)
  # doctest puts its main() into one source of the program.
  list(GET sources 0 first)
  set_property(SOURCE ${first} APPEND PROPERTY COMPILE_DEFINITIONS DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN)
  _periporo_warn(${plugin}_test)
  add_test(NAME ${name} COMMAND ${plugin}_test)
endfunction()

function(periporo_add_plugin)
  cmake_parse_arguments(PLUGIN "" "NAME;KIND" "SOURCES;LIBRARIES;TEST" ${ARGN})
  if(NOT PLUGIN_NAME OR NOT PLUGIN_KIND OR NOT PLUGIN_SOURCES)
    message(FATAL_ERROR "periporo_add_plugin needs NAME, KIND and SOURCES")
  endif()
  if(PLUGIN_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "periporo_add_plugin does not know ${PLUGIN_UNPARSED_ARGUMENTS}")
  endif()
  set(kinds geometry material contact retention output)
  if(NOT PLUGIN_KIND IN_LIST kinds)
    message(FATAL_ERROR "periporo_add_plugin: KIND ${PLUGIN_KIND} is none of ${kinds}")
  endif()
  set(target periporo_${PLUGIN_KIND}_${PLUGIN_NAME})
  add_library(${target} MODULE ${PLUGIN_SOURCES})
  target_link_libraries(${target} PRIVATE periporo::sdk ${PLUGIN_LIBRARIES})
  set_target_properties(${target} PROPERTIES
    PREFIX ""
    CXX_EXTENSIONS OFF
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/periporo
    INSTALL_RPATH "$ORIGIN/.."
    INSTALL_RPATH_USE_LINK_PATH ON
    BUILD_WITH_INSTALL_RPATH ON) # another one would get an empty entry, which means the working folder
  if(PLUGIN_KIND STREQUAL material)
    target_compile_options(${target} PRIVATE ${PERIPORO_PACK_OPTIONS})
  endif()
  _periporo_warn(${target})
  set_property(GLOBAL APPEND PROPERTY PERIPORO_PLUGIN_TARGETS ${target})
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/periporo)
  if(PLUGIN_TEST)
    _periporo_add_plugin_test(${target} ${PLUGIN_KIND}.${PLUGIN_NAME} "${PLUGIN_TEST}" "${PLUGIN_LIBRARIES}")
  endif()
endfunction()
