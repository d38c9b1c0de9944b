# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -D FOLDER=<absolute>/framework/templates -D OUTPUT=project_templates.cpp -P embed_templates.cmake
#
# Writes the projects <FOLDER>/<kind>/ as the C++ source that defines project_templates().
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
if(NOT files)
  message(FATAL_ERROR "there is no template in ${FOLDER}")
endif()
set(entries "")
foreach(file IN LISTS files)
  get_filename_component(kind ${file} DIRECTORY)
  get_filename_component(name ${file} NAME)
  file(READ ${FOLDER}/${file} text)
  string(APPEND entries "    {\"${kind}\", \"${name}\", R\"template(${text})template\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Written by embed_templates.cmake from framework/templates.
#include \"cli/project_templates.hpp\"

namespace periporo::cli {

std::span<const ProjectTemplate> project_templates()
{
    static constexpr ProjectTemplate templates[] = {
${entries}    };
    return templates;
}

} // namespace periporo::cli
")
