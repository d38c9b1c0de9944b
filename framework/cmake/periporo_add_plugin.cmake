# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# periporo_add_plugin(NAME my_clay KIND material SOURCES my_clay.cpp [LIBRARIES CGAL::CGAL ...])
#
# Builds one plugin as a shared library `periporo_<kind>_<name>.so` in `<build>/lib/periporo`, with the compiler
# settings that the program was built with. The plugins of the project itself are made by this same function.
# The pack algebra of operator and laws is many small functions, which GCC stops inlining at its default limits.
set(PERIPORO_PACK_OPTIONS
  $<$<CXX_COMPILER_ID:GNU>:--param=max-inline-insns-single=2000>
  $<$<CXX_COMPILER_ID:GNU>:--param=max-inline-insns-auto=400>
  $<$<CXX_COMPILER_ID:GNU>:--param=inline-unit-growth=400>
  $<$<CXX_COMPILER_ID:GNU>:--param=large-function-growth=2000>)

function(periporo_add_plugin)
  cmake_parse_arguments(PLUGIN "" "NAME;KIND" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT PLUGIN_NAME OR NOT PLUGIN_KIND OR NOT PLUGIN_SOURCES)
    message(FATAL_ERROR "periporo_add_plugin needs NAME, KIND and SOURCES")
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
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/periporo)
  if(PLUGIN_KIND STREQUAL material)
    target_compile_options(${target} PRIVATE ${PERIPORO_PACK_OPTIONS})
  endif()
  if(COMMAND periporo_project_warnings)
    periporo_project_warnings(${target})
  endif()
  set_property(GLOBAL APPEND PROPERTY PERIPORO_PLUGIN_TARGETS ${target})
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/periporo)
endfunction()
