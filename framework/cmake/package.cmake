# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What `cmake --install` puts into a prefix, and the package that find_package(periporo) finds there. The prefix may be
# moved: program and plugins find the SDK's library, and the program its plugins, by their place relative to themselves.
# The build folder has the same layout, so that it serves as a prefix too.
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/periporo)
set(build_package ${CMAKE_BINARY_DIR}/lib/cmake/periporo)

file(RELATIVE_PATH libraries_from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
# The same run path in the build folder: CMake would fill up another one with an empty entry, for which the loader takes
# libraries from the working folder.
set(library_places "$ORIGIN/${libraries_from_program}" "$ORIGIN/../lib")
list(REMOVE_DUPLICATES library_places)
set_target_properties(periporo PROPERTIES
  INSTALL_RPATH "${library_places}" INSTALL_RPATH_USE_LINK_PATH ON BUILD_WITH_INSTALL_RPATH ON)
set_target_properties(periporo_sdk PROPERTIES
  INSTALL_RPATH "" INSTALL_RPATH_USE_LINK_PATH ON BUILD_WITH_INSTALL_RPATH ON)
set_property(SOURCE src/plugins/search_path.cpp APPEND PROPERTY
  COMPILE_DEFINITIONS PERIPORO_PLUGINS_FROM_PROGRAM="${libraries_from_program}/periporo")

set_target_properties(periporo_sdk PROPERTIES EXPORT_NAME sdk)
install(TARGETS periporo)
install(TARGETS periporo_sdk EXPORT periporo)
install(DIRECTORY include/periporo DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(EXPORT periporo NAMESPACE periporo:: FILE periporoTargets.cmake DESTINATION ${package})
export(EXPORT periporo NAMESPACE periporo:: FILE ${build_package}/periporoTargets.cmake)

configure_package_config_file(cmake/periporoConfig.cmake.in ${build_package}/periporoConfig.cmake
                              INSTALL_DESTINATION ${package})
# Below 1.0 a minor version may change the SDK.
write_basic_package_version_file(${build_package}/periporoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(cmake/periporo_add_plugin.cmake ${build_package}/periporo_add_plugin.cmake COPYONLY)
install(FILES ${build_package}/periporoConfig.cmake ${build_package}/periporoConfigVersion.cmake
              ${build_package}/periporo_add_plugin.cmake
        DESTINATION ${package})
